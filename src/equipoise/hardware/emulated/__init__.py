"""Counterparts of devices with the real protocols, for tests and rehearsals."""
