"""Grbl 1.1 and its kin: the driver, its conversation, what the firmware says."""
