"""What is seen of a platform."""
