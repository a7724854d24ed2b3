"""Figures of a balancing."""
