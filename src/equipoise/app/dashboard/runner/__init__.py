"""The process that has the bench: runs procedures, answers requests."""
