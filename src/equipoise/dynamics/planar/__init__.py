"""A platform whose bearing floats on a flat table: five degrees of freedom, momentum form."""
