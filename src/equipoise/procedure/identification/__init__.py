"""Identify, assess and calibrate from recordings."""
