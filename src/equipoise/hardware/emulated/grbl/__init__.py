"""An emulated Grbl board: the firmware, its machine, its motors."""
