"""Drivers of sensors, one file each."""
