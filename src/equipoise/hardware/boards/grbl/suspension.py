"""A Grbl board that says Idle and takes no line: a cancel found it idle, and suspended it.

Bytes keep their order: what is asked after a line is behind it there, and the report of that would
be behind the answer here. So a board is suspended that says Idle twice while a line is unanswered.
"""

from equipoise.hardware.boards.grbl.report import MachineState
from equipoise.hardware.boards.grbl.talk import GrblTalk

NEVER = float("inf")
LONGER = 0.1  # s, chosen: a board takes a line within some ms; printing its settings takes 55


class Suspension:
    """What is known of it, report by report."""

    def __init__(self) -> None:
        self._first_idle = NEVER  # s, bench time: reported so with a line under way

    def there(self, talk: GrblTalk) -> bool:
        """Say whether the board is suspended."""
        waiting = talk.queue.pending is not None and talk.queried > talk.line_sent
        idle = talk.status is not None and talk.status.state is MachineState.IDLE
        self._first_idle = min(self._first_idle, talk.arrived) if waiting and idle else NEVER
        return talk.queried > self._first_idle + LONGER
