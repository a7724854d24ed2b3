"""Gains, rails and backlash of drives, axes of sensors."""
