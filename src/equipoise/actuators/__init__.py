"""What masses, wheels, gyros, coils and jets do to a platform, and the inverse maps."""
