"""Columns of foreign tables: maps and dialects."""
