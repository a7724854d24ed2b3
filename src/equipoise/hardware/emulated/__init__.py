"""Counterparts of devices that speak the real protocols, for tests and rehearsals."""
