"""What can be done to a platform: forward and inverse maps side by side."""
