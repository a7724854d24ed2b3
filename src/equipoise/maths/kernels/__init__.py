"""Functions that are compiled: the door to the compiler, and the compiler as it is used here."""
