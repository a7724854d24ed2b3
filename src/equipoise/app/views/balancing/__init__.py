"""Balancings as blocks, documents and figures."""
