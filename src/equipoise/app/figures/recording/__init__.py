"""Figures of a recording by itself."""
