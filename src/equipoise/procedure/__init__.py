"""Identify and balance, as generators of Steps."""
