"""Comparisons and reproductions as blocks, documents and figures."""
