"""Which terms, noise and events a recording supports."""
