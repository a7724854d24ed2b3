"""What surrounds the simulated platform: a lamp that warms it, and its magnetic field."""
