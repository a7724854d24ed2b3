"""Reach and error budget of a mass system and its sensors."""
