"""How well a bench's devices answer: what arrived, its defects, offset and drift of clocks."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum

from equipoise.hardware.links.arrival_statistics import Arrivals
from equipoise.hardware.links.clock_sync import DeviceClock, drift_of, offset_of
from equipoise.hardware.transport.requests import Unconfirmed
from equipoise.model.hardware import Gives
from equipoise.model.reading import Counts, Rowless
from equipoise.model.units import MS, PPM


class Defect(StrEnum):
    """What is wrong with a message or a row."""

    BROKEN = "broken"
    TWICE = "twice"
    LATE = "late"
    FROZEN = "frozen"
    MISSING = "missing"
    UNCONFIRMED = "unconfirmed"


@dataclass(frozen=True, slots=True, eq=False)
class Health:
    """One device so far; a board has no rows and no clock."""

    device: str  # its kind and name
    counts: Counts  # messages
    arrivals: Arrivals | None = None  # rows
    clocks: Mapping[Gives, DeviceClock] = field(default_factory=dict[Gives, DeviceClock])
    unconfirmed: tuple[Unconfirmed, ...] = ()  # requests that are overdue
    received: bytes = b""  # last
    rowless: Sequence[Rowless] = ()  # messages without a row, a reason each

    @property
    def wrong(self) -> dict[Defect, int]:
        """How many messages or rows were wrong, by what was wrong with them; none that is 0."""
        found = {Defect.BROKEN: self.counts.corrupt, Defect.UNCONFIRMED: len(self.unconfirmed)}
        if self.arrivals is not None:
            found |= {
                Defect.TWICE: self.arrivals.duplicate,
                Defect.LATE: self.arrivals.late,
                Defect.FROZEN: self.arrivals.frozen,
                Defect.MISSING: self.arrivals.missing,
            }
        return {what: count for what, count in found.items() if count}

    @property
    def sentence(self) -> str:
        """All of it, for people."""
        good = f"{self.counts.good} messages"
        if self.counts.foreign:
            good += f", {self.counts.foreign} of other kinds{self._rowless}"
        if self.arrivals is not None:
            good += f", {self.arrivals.kept} rows"
        wrong = ", ".join(f"{count} {what}" for what, count in self.wrong.items())
        more = [each.sentence for each in self.unconfirmed]
        if more:
            more.append(
                f"last received: {self.received!r}" if self.received else "nothing was received"
            )
        more += [self._clock(channel) for channel in self.clocks]
        return "; ".join((f"{self.device}: {good}", wrong or "nothing wrong", *more))

    @property
    def data(self) -> dict[str, object]:
        """The same as numbers, for a recording."""
        clocks = {
            channel: {"offset_s": offset_of(clock), "drift": drift_of(clock), "jumps": clock.jumps}
            for channel, clock in self.clocks.items()
        }
        kept = {} if self.arrivals is None else {"rows": self.arrivals.kept}
        messages = {"messages": self.counts.good, "others": self.counts.foreign}
        without = [
            {"code": each.reason.code.value, "count": each.count, **each.reason.numbers}
            for each in self.rowless
        ]
        rowless = {"without_row": without} if without else {}
        return {
            "device": self.device,
            **messages,
            **kept,
            **self.wrong,
            **rowless,
            "clocks": clocks,
        }

    @property
    def _rowless(self) -> str:
        text = "; ".join(f"{each.count}: {each.reason.sentence}" for each in self.rowless)
        return f" ({text})" if text else ""

    def _clock(self, channel: Gives) -> str:
        clock = self.clocks[channel]
        drift, offset = drift_of(clock) / PPM, offset_of(clock) / MS
        pace = f"{abs(drift):.0f} ppm {'slow' if drift > 0 else 'fast'}"
        jumps = f", {clock.jumps} jumps" if clock.jumps else ""
        return f"clock of {channel} set off by {offset:+.1f} ms, {pace}{jumps}"
