"""Figures of papers' simulations, by the papers' numbers."""
