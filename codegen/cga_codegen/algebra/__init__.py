"""Geometric algebra, exactly: signatures, rules on blades, typed tables, multivectors over any scalar, proofs."""
