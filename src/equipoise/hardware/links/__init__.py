"""A device with its clock, rows and health."""
