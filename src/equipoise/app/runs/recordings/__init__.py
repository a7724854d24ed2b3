"""What is done with recordings: read, identified, assessed, observed."""
