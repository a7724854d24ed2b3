"""Tables that other programs write: which program it was, and the map of its columns."""
