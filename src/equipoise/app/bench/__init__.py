"""Benches as commands open them: real, emulated, recorded, shared."""
