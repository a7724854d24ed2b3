"""Testbed files: schema, records, text."""
