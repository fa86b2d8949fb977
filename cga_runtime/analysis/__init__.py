"""Mobility, singularities and actuation schemes of closed chains."""
