"""Formulations of the momentum balance, linear in the parameters."""
