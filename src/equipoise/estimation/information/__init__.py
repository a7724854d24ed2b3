"""Fisher information, Cramer-Rao bounds and observability."""
