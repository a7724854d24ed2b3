"""The effects of masses, wheels, gyros, coils and jets on a platform, and their inverse maps."""
