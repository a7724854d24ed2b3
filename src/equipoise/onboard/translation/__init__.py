"""Scalar Python functions as C99: types, expressions, statements, and the unit that holds them."""
