"""The version of the package, as documents and recordings state it."""

__version__ = "0.1.0"
