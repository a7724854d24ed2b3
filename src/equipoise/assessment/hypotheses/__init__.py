"""What the columns of an unknown table may mean, and which meaning the numbers support."""
