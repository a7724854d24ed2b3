"""Datagrams for other programs, and what decodes them."""
