"""The version of the package, as documents and recordings state it."""

__version__ = "0.2.0"
