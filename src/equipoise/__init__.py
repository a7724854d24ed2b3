"""Equipoise: mass properties and balance of a satellite mock-up on an air bearing."""

__version__ = "0.1.0"
