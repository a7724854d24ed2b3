"""Papers' simulations run again."""
