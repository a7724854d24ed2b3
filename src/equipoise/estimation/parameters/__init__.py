"""Parameters of a fit: retraction, observability, ratios."""
