"""Nouns: what the rooms above talk about."""
