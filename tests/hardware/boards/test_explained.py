"""Conversations in words: what every board's bytes mean, both directions."""

import pytest

from equipoise.hardware.boards.grbl.explained import GrblExplained
from equipoise.hardware.boards.registry import BOARDS, EXPLAINED
from equipoise.hardware.boards.tmcl.explained import TmclExplained
from equipoise.hardware.boards.tmcl.words import Request, packed
from equipoise.model.units import MM
from tests.support.board_wire import Wire


def test_grbls_bytes_in_words():
    words = GrblExplained()
    assert words.sent(b"\x18?") == ["restart (0x18)", "where are you? (?)"]
    assert words.sent(b"$$\n\n") == [
        "list your settings ($$)",
        "are you taking lines? (an empty line)",
    ]
    assert words.sent(b"$J=G53 G21 G90 X-13.0000 F480.00\n") == [
        "jog to X-13.0000 mm at 480.00 mm/min"
    ]
    assert words.received(b"<Hold:0|MPos:1.000,2.000,3.000|FS:0") == []
    assert words.received(b",0>\r\nok\r\nerror:8\r\n") == [
        "I am in state Hold at 1.000, 2.000, 3.000 mm",
        "ok: the line is taken",
        "refused: this $ command is for a board that stands (error:8)",
    ]
    assert words.received(b"q!\r\n") == ["something that is not understood: 'q!'"]


def test_tmcls_bytes_in_words():
    words = TmclExplained()
    request = packed(Request(4, 0, 2, -3200))
    assert words.sent(request[:4]) == []
    assert words.sent(request[4:] + b"\0" + packed(Request(136, 1, 0))) == [
        "send motor 2 to -3200 microsteps",
        "which firmware are you?",
    ]
    assert words.received(bytes.fromhex("020164060000 02c736".replace(" ", ""))) == ["711"]


@pytest.mark.parametrize("kind", sorted(BOARDS))
def test_every_boards_conversation_has_words(kind):
    """From the start to the end of a way: nothing is called a line or a command by its number."""
    assert set(EXPLAINED) == set(BOARDS)
    wire, words = Wire(kind), EXPLAINED[kind]()
    listener = EXPLAINED[kind]()
    feed = wire.driver.feed
    said = []

    def listened(data, t):
        said.extend(listener.received(data))
        feed(data, t)

    wire.driver.feed = listened
    wire.at_home()
    wire.driver.go({"x": 2 * MM}, wire.t)
    wire.run(0.2)
    wire.driver.halt(wire.t)
    wire.run(1.0)
    sent = words.sent(wire.sent)
    assert len(set(sent)) > 5
    odd = [each for each in (*sent, *said) if each.startswith(("the line", "command"))]
    assert odd == []
    assert sum("not understood" in each for each in said) <= 1  # what a loader says
