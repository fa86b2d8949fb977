"""Solvers: reaching by nonlinear programming."""
