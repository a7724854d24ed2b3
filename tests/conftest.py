"""Settings of every test."""

from hypothesis import settings

# Time is the benchmark's to judge; the first example of a test may have to compile its kernel.
settings.register_profile("house", deadline=None)
settings.load_profile("house")
