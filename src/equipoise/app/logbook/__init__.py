"""Run folders, and the index of them."""
