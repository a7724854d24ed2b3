"""Flexible and sloshing modes of a platform: found in what a fit leaves, and fitted with it."""
