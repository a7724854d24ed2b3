"""The terminal: rendering, questions, notices, worker processes."""
