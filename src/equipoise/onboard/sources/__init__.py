"""The files of a generated program, as text."""
