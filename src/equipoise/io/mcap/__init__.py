"""MCAP recordings: live capture, repair, foreign schemas."""
