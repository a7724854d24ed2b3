"""The terminal: console, tables, questions, notices, worker processes."""
