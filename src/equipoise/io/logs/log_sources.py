"""Which sources of another program's log are taken: as stated, else the best kind that there is.

A log's format lists its kinds, best first, for attitude, rate and acceleration. Two topics of the
best kind are refused: nobody but the person who recorded them knows which is the platform's.

Accelerations are taken beside a motion only, of the topic of the rate where it has them, and never
are a reason to refuse a log: of several topics of the best kind none is taken.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.formats.clock_units import PER_US
from equipoise.io.logs.log_table import LogChannel
from equipoise.model.arrays import Floats, Series1
from equipoise.model.errors import InputError, nearest

Best = Mapping[str, tuple[str, ...]]  # kinds of sources by channel, the best first
Taken = Mapping[str, "Source"]  # by channel
LISTED = 20  # topics, chosen: what fits a screen
NEITHER = "no row of attitude or rate"
BESIDE = "accelerometer"
LATEST_US = 2**62 // PER_US  # beyond, a count is no time (chosen)


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """A topic of a log, or one instance of it."""

    name: str
    kind: str  # the type of its messages; where a topic has but one type, its name
    count: int  # messages
    channels: Mapping[str, LogChannel] = field(default_factory=dict[str, LogChannel])
    instance: int = 0
    doubt: str = ""  # why it is not taken unless it is stated

    def gives(self, channel: str) -> bool:
        """Say whether there is a row of a channel that holds numbers."""
        rows = self.channels.get(channel)
        return rows is not None and bool(np.isfinite(rows.values).all(axis=1).any())

    @property
    def holds(self) -> bool:
        """Say whether there is a row of any channel."""
        return any(map(self.gives, self.channels))

    def __str__(self) -> str:
        """Return how it is listed."""
        kind = "" if self.kind == self.name else f"{self.kind}, "
        doubt = f": {self.doubt}" if self.doubt else ""
        return f"'{self.name}' ({kind}{self.count} row{'s' * (self.count != 1)}{doubt})"


def channel_of(name: str, us: Series1, values: Floats) -> LogChannel:
    """Return rows at times in whole microseconds (n,), without those of an impossible time.

    A quaternion of zeros was never filled in, and is left out.
    """
    timed = (us >= 0) & (us < LATEST_US)
    if name == "attitude":
        timed &= values.any(axis=1)
    return LogChannel(name, us[timed].astype(np.int64) * PER_US, values[timed])


def chosen(
    sources: Sequence[Source], file: str, options: ReadOptions, best: Best
) -> tuple[list[LogChannel], tuple[str, ...]]:
    """Return the channels that are taken, and notes on what was taken and what ignored.

    InputError if there is none, if several are as good, or if a stated topic or instance is not
    there.
    """
    known = [each for each in sources if any(each.kind in kinds for kinds in best.values())]
    for name in options.topics:
        _check_stated(name, sources, known, file)
    candidates = [s for s in known if _is_candidate(s, options)]
    motion = [channel for channel in best if channel != BESIDE]
    found = {channel: _best(channel, candidates, file, options, best) for channel in motion}
    taken = {channel: source for channel, source in found.items() if source is not None}
    if not taken:
        wanted = f"a log of a motion; read are {', '.join(_kinds(best))}"
        raise InputError(file, f"{NEITHER}; {_listed(sources)}", wanted)
    acceleration = _beside(candidates, taken.get("rate"), options, best.get(BESIDE, ()))
    taken |= {} if acceleration is None else {BESIDE: acceleration}
    _check_all_used(taken, file, options)
    _check_instance(taken, known, file, options)
    channels = [source.channels[channel] for channel, source in taken.items()]
    return channels, (*_notes(taken, known), *_left(taken, known))


def refuse_choice(options: ReadOptions, file: str, what: str) -> None:
    """Raise InputError if a topic or an instance is stated of what has none."""
    choices = {"topic": bool(options.topics), "instance": options.instance is not None}
    for option, stated in choices.items():
        if stated:
            raise InputError(file, f"--{option} for {what}", f"no --{option}: it has none")


def _is_candidate(source: Source, options: ReadOptions) -> bool:
    return source.name in options.topics if options.topics else not source.doubt


def _best(
    channel: str, candidates: Sequence[Source], file: str, options: ReadOptions, best: Best
) -> Source | None:
    for kind in best[channel]:
        found = [each for each in candidates if each.kind == kind and each.gives(channel)]
        names = sorted({each.name for each in found})
        if len(names) > 1:
            listed = [f"{s.name} ({s.count} rows)" for s in sorted(found, key=_by_name)]
            wanted = f"one, the platform's: --topic NAME, such as --topic {names[0]}"
            raise InputError(
                file, f"{len(names)} topics of {kind}: {', '.join(_cut(listed))}", wanted
            )
        if found:
            return _instance(found, file, options)
    return None


def _beside(
    candidates: Sequence[Source], rate: Source | None, options: ReadOptions, kinds: tuple[str, ...]
) -> Source | None:
    """Return the source of accelerations, if there is one that is the platform's."""
    giving = [each for each in candidates if each.kind in kinds and each.gives(BESIDE)]
    if rate in giving:
        return rate
    first = min((kinds.index(each.kind) for each in giving), default=0)
    alike = [each for each in giving if each.kind == kinds[first]]
    if len({each.name for each in alike}) != 1:
        return None
    stated = [each for each in alike if each.instance == options.instance]
    return min(stated or alike, key=lambda source: source.instance)


def _instance(found: Sequence[Source], file: str, options: ReadOptions) -> Source:
    """Return the instance that is stated, if there are several; else the lowest."""
    if options.instance is None or len(found) == 1:
        return min(found, key=lambda source: source.instance)
    for source in found:
        if source.instance == options.instance:
            return source
    where = f"{file}, topic '{found[0].name}'"
    raise InputError(where, f"no instance {options.instance}", f"one of {_numbers(found)}")


def _check_stated(name: str, sources: Sequence[Source], known: Sequence[Source], file: str) -> None:
    """Raise InputError if a stated topic is not there, or is there and holds nothing."""
    names = sorted({each.name for each in known if each.holds})
    wanted = nearest(name, names) if names else f"none: the log has {NEITHER}"
    here = [each for each in sources if each.name == name]
    if not here:
        raise InputError(f"{file}, --topic", f"no topic '{name}'; {_listed(known)}", wanted)
    if not any(each.holds for each in here):
        raise InputError(f"{file}, --topic", f"{NEITHER} in {here[0]}", wanted)


def _check_all_used(taken: Taken, file: str, options: ReadOptions) -> None:
    """Raise InputError if a stated topic gives nothing that another one does not."""
    used = {source.name for source in taken.values()}
    for name in options.topics:
        if name not in used:
            gives = " and ".join(f"{c} from '{source.name}'" for c, source in taken.items())
            found = f"nothing to take from topic '{name}' beside {gives}"
            raise InputError(f"{file}, --topic", found, "one topic for each of these")


def _check_instance(taken: Taken, known: Sequence[Source], file: str, options: ReadOptions) -> None:
    """Raise InputError if an instance is stated that no topic that is taken has."""
    stated = options.instance
    if stated is None or any(source.instance == stated for source in taken.values()):
        return
    has = {each.name: _numbers(_instances(each, known)) for each in known if each.holds}
    used = " and ".join(dict.fromkeys(f"'{source.name}'" for source in taken.values()))
    listed = _cut([f"{name}: {numbers}" for name, numbers in has.items()])
    wanted = "one of " + "; ".join(listed)
    raise InputError(f"{file}, --instance", f"no instance {stated} of {used}", wanted)


def _notes(taken: Taken, known: Sequence[Source]) -> list[str]:
    notes: list[str] = []
    for channel, source in taken.items():
        kind = "" if source.kind == source.name else f" ({source.kind})"
        several = _instances(source, known)
        which = f", instance {source.instance} of {_numbers(several)}" * (len(several) > 1)
        notes.append(f"{channel}: taken from topic '{source.name}'{kind}{which}.")
    return notes


def _left(taken: Taken, known: Sequence[Source]) -> list[str]:
    used = {source.name for source in taken.values()}
    left = [s for s in known if s.name not in used and (s.holds or s.doubt)]
    return [f"Topics ignored: {', '.join(_texts(left))}."] if left else []


def _instances(source: Source, known: Sequence[Source]) -> list[Source]:
    """Return a topic's instances that have rows."""
    return [each for each in known if each.name == source.name and each.holds]


def _numbers(sources: Sequence[Source]) -> str:
    return ", ".join(str(each.instance) for each in sorted(sources, key=lambda s: s.instance))


def _kinds(best: Best) -> list[str]:
    return list(dict.fromkeys(kind for kinds in best.values() for kind in kinds))


def _listed(sources: Sequence[Source]) -> str:
    return f"its topics: {', '.join(_texts(sources))}" if sources else "it has no topic"


def _texts(sources: Sequence[Source]) -> list[str]:
    return _cut(list(dict.fromkeys(map(str, sorted(sources, key=_by_name)))))


def _cut(shown: list[str]) -> list[str]:
    """Return no more of a list than a screen has place for."""
    more = [f"and {len(shown) - LISTED} more"] if len(shown) > LISTED else []
    return [*shown[:LISTED], *more]


def _by_name(source: Source) -> tuple[str, int]:
    return source.name, source.instance
