"""TOML with units in the keys."""
