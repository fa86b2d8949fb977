"""Solvers: reaching by IPOPT."""
