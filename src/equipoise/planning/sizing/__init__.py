"""What a mass system and its sensors can reach: the error budget."""
