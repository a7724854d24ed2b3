"""What is shown while a bench is read."""
