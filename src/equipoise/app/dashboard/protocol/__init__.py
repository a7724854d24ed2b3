"""What server, runner and page say to each other."""
