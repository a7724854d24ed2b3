"""Which body of a table is read, where it holds several."""

from collections.abc import Sequence

from equipoise.model.errors import InputError, nearest


def chosen_body(bodies: Sequence[str], body: str | None, source: str) -> str:
    """Return the name of the body to read; InputError where it is open, or not in the table."""
    named = [each for each in bodies if each]
    if body is None and len(bodies) == 1:
        return bodies[0]
    if body is None:
        found = f"{len(bodies)} bodies: {', '.join(bodies)}"
        raise InputError(f"{source}, header", found, "the name of the one to read: --body NAME")
    if not named:
        raise no_body(body, source)
    if body not in named:
        raise InputError(f"{source}, header", f"no body '{body}'", nearest(body, named))
    return body


def no_body(body: str, source: str) -> InputError:
    """Return the error for a body that is named where a table names none."""
    found = f"--body '{body}', but no body with a name in the table"
    return InputError(f"{source}, header", found, "no --body")


def others_left(bodies: Sequence[str], body: str) -> tuple[str, ...]:
    """Say which bodies are not read."""
    others = [each for each in bodies if each != body]
    return (f"Other bodies were ignored: {', '.join(others)}.",) if others else ()
