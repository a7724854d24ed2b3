"""Balancing laws: one file each, a state and a sample to a state and a command."""
