"""Options of the feed-forward of gravity's torque: where to send it, and what it begins with."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from cyclopts import Parameter

from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.model.given_numbers import GivenNumbers

WANTED = "HOST:PORT, such as 127.0.0.1:8766"
PORTS = 65536


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Feeding:
    """Gravity's torque for a controller.

    Attributes
    ----------
    feed_forward
        HOST:PORT to send gravity's torque to in UDP datagrams, for a controller's feed-forward.
    estimate
        With --feed-forward: run or JSON document that it begins with. If omitted: the testbed.
    """

    feed_forward: str | None = None
    estimate: str | None = None


NOT_FED = Feeding()


@dataclass(frozen=True, slots=True)
class Receiver:
    """Where gravity's torque is sent, and what the estimate begins with."""

    host: str
    port: int
    given: "GivenNumbers"


def receiver_of(requested: Feeding) -> Receiver | None:
    """Return where to send, if that is requested.

    Raises InputError for an address that is none, and for an estimate that cannot be used.
    """
    if requested.feed_forward is None:
        if requested.estimate is not None:
            raise InputError("--estimate", "no --feed-forward", "--feed-forward with it")
        return None
    from equipoise.io.exchange.result_file import read_given
    from equipoise.model.given_numbers import NOTHING_GIVEN

    host, port = address_of(requested.feed_forward)
    given = NOTHING_GIVEN if requested.estimate is None else read_given(requested.estimate)
    return Receiver(host, port, given)


def address_of(text: str, where: str = "--feed-forward") -> tuple[str, int]:
    """Return host and port; ``where`` names the option in an error."""
    host, _, port = text.rpartition(":")
    if not host or not port.isdecimal() or not 0 < int(port) < PORTS:
        raise InputError(where, f"'{text}'", WANTED)
    return host, int(port)
