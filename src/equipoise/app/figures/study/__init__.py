"""Figures of many runs and of designs."""
