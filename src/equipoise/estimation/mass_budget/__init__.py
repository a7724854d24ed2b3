"""Mass properties from a list of parts and from swings about known axes."""
