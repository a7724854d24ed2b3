"""Estimators of mass properties and what they rest on; no file, port or clock."""
