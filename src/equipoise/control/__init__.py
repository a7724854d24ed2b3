"""Balancing laws as pure functions of state and sample; no device is known here."""
