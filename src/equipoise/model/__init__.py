"""Records and protocols that all rooms share."""
