"""Choosing the manoeuvre whose record carries most information."""
