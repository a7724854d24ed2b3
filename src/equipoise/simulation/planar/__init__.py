"""A bench made of equations whose bearing floats over a flat table."""
