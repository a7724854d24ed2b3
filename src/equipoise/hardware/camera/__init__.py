"""A camera that looks at a board of markers: its lens, the board, and the attitude that it sees."""
