"""Numbers of Python as literals of C, exact to the last digit in double precision."""

import math


def real_literal(value: float) -> str:
    """Return a number as a literal of ``real_t``: R() keeps single precision single."""
    number = float(value)
    if math.isnan(number):
        return "R(NAN)"
    if math.isinf(number):
        return "R(INFINITY)" if number > 0 else "(-R(INFINITY))"
    text = repr(abs(number))
    return f"R({text})" if math.copysign(1.0, number) > 0 else f"(-R({text}))"


def literal(value: float) -> str:
    """Return a number as a literal of its own kind."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value) if isinstance(value, int) else real_literal(value)
