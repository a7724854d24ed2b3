"""Estimation methods: one file each with its card, and their registry."""
