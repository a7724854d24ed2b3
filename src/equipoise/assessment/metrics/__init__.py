"""Measures of balance: one metric, one file."""
