"""Drivers of motor boards, one file each."""
