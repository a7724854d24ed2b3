"""A bench made of equations."""
