"""Compiled kernels of the output-error fit."""
