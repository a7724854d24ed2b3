"""The terminal: rendering, questions, notices, progress."""
