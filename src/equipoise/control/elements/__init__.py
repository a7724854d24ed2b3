"""Elements of laws: feedback, tuning, sweeps, stability."""
