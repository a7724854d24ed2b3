"""Feed-forward: gravity's torque for a controller of one's own."""

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from equipoise.app.arguments import feeding, inputs
from equipoise.app.live.feed_forward import DatagramStream, FeedForward
from equipoise.io.exchange.result_file import read_given
from equipoise.model.estimate import Estimate
from equipoise.model.given_numbers import NOTHING_GIVEN, GivenNumbers, given_by


@contextmanager
def feed_forward(
    testbed: inputs.AnyTestbed, to: str, *, estimate: Estimate | str | Path | None = None
) -> Generator[FeedForward]:
    """Lend a function of fresh rows that sends gravity's torque to a controller, by UDP.

    Call it with what ``bench.read`` returns, in turn; each call sends one datagram. It never waits
    for the receiver. The page "Feed-forward" has the datagram and a header in C.

    Parameters
    ----------
    testbed
        Testbed, its file, or a preset's name.
    to
        Where to send: HOST:PORT, such as 127.0.0.1:8766.
    estimate
        Estimate, or the run or JSON document that holds it. If omitted, the testbed is the
        beginning, and the rows have to show the centre of mass.

    Raises
    ------
    InputError
        For an address that is none, and for an estimate that is not usable.
    PortLost
        Where there is no such host.
    """
    bed, (host, port) = inputs.testbed_from(testbed), feeding.address_of(to, "to")
    given = given_of(estimate)
    with DatagramStream(host, port) as stream:
        yield FeedForward(bed, given, stream)


def given_of(estimate: Estimate | str | Path | None) -> GivenNumbers:
    """Return what an estimate gives, or that of a file; nothing where there is none."""
    if estimate is None:
        return NOTHING_GIVEN
    return given_by(estimate) if isinstance(estimate, Estimate) else read_given(estimate)
