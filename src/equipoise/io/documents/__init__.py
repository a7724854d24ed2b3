"""Files that are no recordings: plans, sessions, runs, logbook."""
