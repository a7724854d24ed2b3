"""Columns of foreign tables, and the maps that say what they hold."""
