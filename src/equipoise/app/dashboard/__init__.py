"""The dashboard: a live view of a bench in a browser."""
