"""Bytes: ports, lines, reconnection."""
