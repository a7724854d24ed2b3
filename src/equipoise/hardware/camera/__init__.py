"""A camera that observes a board of markers: lens, board, attitude."""
