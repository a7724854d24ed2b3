"""What laws are made of: feedback, tuning, sweeps, stability."""
