"""Solvers of linear formulations."""
