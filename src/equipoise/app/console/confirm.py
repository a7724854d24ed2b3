"""Questions that a person answers before something moves."""

from equipoise.app.console.terminal import stderr


def agreed(question: str) -> bool:
    """Ask a person; anything but yes is no, and so is nobody there."""
    stderr().print(f"{question} [y/n] ", end="", markup=False)
    try:
        return input().strip().lower() in ("y", "yes")
    except EOFError:
        return False
