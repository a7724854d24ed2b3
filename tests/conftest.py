"""Settings of every test."""

import signal

from hypothesis import settings

# Time is the benchmark's to judge; the first example of a test may have to compile its kernel.
settings.register_profile("house", deadline=None)
settings.load_profile("house")

# A shell that runs the tests in the background lets Ctrl-C be ignored, by all that they start too.
signal.signal(signal.SIGINT, signal.default_int_handler)
