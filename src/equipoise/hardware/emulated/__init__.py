"""The far side of each wire: devices that speak the real protocols, for tests and for trying."""
