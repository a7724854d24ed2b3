"""Columns to recordings, in every format."""
