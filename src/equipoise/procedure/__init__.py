"""Identify, assess, calibrate and balance, as generators of Steps."""
