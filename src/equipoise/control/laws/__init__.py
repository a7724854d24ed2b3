"""Balancing laws: one file each, and their registry."""
