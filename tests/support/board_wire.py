"""A board's driver and its emulated counterpart, turn by turn, and the true place of each mass."""

from dataclasses import replace

from equipoise.app.bench.emulation import ahead_of
from equipoise.hardware.boards.registry import BOARDS
from equipoise.hardware.emulated.registry import emulated_board
from equipoise.hardware.links.mass_interpolation import on_the_way
from equipoise.io.testbed.presets import read_preset

BED = read_preset("nanosat")  # 8 mm/s, zero at -17 mm, 800 steps per mm
TURN = 0.01  # s
LETTERS = {"grbl": "XYZ", "tmcl": "012"}  # what each kind of board calls its first three axes


def board_of(kind, **changes):
    """Return the preset's board as one of another kind."""
    (board,) = BED.hardware.boards
    named = zip(board.axes, LETTERS[kind], strict=True)
    axes = tuple(replace(axis, letter=letter) for axis, letter in named)
    return replace(board, driver=kind, axes=axes, **changes)


class Wire:
    """Carries bytes there and back."""

    def __init__(self, kind, board=None, turn=TURN):
        self.board = board_of(kind) if board is None else board
        self.driver = BOARDS[kind](self.board, BED.masses)
        self.remote = emulated_board(self.board, BED.masses)
        self.t, self.turn, self.sent, self.legs = 0.0, turn, b"", []
        self.cut = False  # what the board says does not arrive
        self.reported = []  # s, positions, which have to go: every state of another time
        self.driver.opened(0.0)

    def run(self, seconds, listen=True, until=""):
        """Let time pass, or until a phase; ``listen=False`` is a computer that has died."""
        end = self.t + seconds
        while self.t < end - 1e-9 and self.driver.state.phase != until:
            self.t = round(self.t + self.turn, 9)
            said, legs = self.remote.run(self.t)
            self.legs += legs
            if listen:
                self._talk(said)
        return self.driver.state

    def pause(self, seconds):
        """Let the host do nothing for a while; what the board says meanwhile waits for it."""
        self.t = round(self.t + seconds, 9)
        said, legs = self.remote.run(self.t)
        self.legs += legs
        self._talk(said)

    def _talk(self, said):
        if not self.cut:
            self.driver.feed(said, self.t)
        reported = self.driver.due(self.t)
        self.sent += reported
        answer = self.remote.take(reported, self.t) if reported else b""
        if not self.cut:
            self.driver.feed(answer, self.t)
        state = self.driver.state
        if state.position and (not self.reported or self.reported[-1][0] != state.reported):
            wants = on_the_way(state, self.board.axes)
            self.reported.append((state.reported, dict(state.position), wants))

    def at_home(self):
        assert self.run(5.0, until="ready").phase == "ready"
        self.driver.home(self.t)
        assert self.run(60.0, until="ready").sure
        self.run(0.2)
        return self

    def true(self, name, t=None):
        """Return where a mass really is, m."""
        t = self.t if t is None else t
        at, before = 0.0, None
        for leg in ahead_of([], [leg for leg in self.legs if leg.mass == name]):
            if leg.t > t:
                break
            at = 0.0 if before is None else along(before, at, leg.t)
            before = leg
        return at if before is None else along(before, at, t)


def along(leg, begin, t):
    if t >= leg.end:
        return leg.displacement
    return begin + (t - leg.t) / (leg.end - leg.t) * (leg.displacement - begin)
