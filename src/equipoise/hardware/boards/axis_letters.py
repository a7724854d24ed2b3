"""The names that a board has for its axes."""

from equipoise.model.errors import InputError
from equipoise.model.hardware import MotorBoard


def check_letters(board: MotorBoard, known: str, what: str) -> None:
    """Raise InputError where an axis has a name that this kind of board does not know."""
    for axis in board.axes:
        if axis.letter not in known:
            wanted = f"{what}: one of {' '.join(known)}"
            raise InputError(f"board {board.name}: axis", f"letter '{axis.letter}'", wanted)
