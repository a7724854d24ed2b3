"""Trinamic modules with TMCL: the driver, its conversation, datagrams and settings."""
