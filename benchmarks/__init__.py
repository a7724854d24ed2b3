"""The trajectory fit against other tools, side by side; ``make bench`` runs it."""
