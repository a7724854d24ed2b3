"""How late masses follow a recorded command.

A servo that pulls as a spring and a damper follows a slow command late by the same time throughout
(2 / w when critically damped), and a log may be stamped early. With a lag tau

    d(t) = d_log(t - tau) = d_log(t) - tau d_log'(t) + ...

so the effect of a lag is minus the speed, and the momentum of the travel changes with -tau d_log''.
The speed is that over [t - s, t + s] with s one sd of the lag: its error at the begin and end of a
constant speed is of second order, tau^2, and cancels between them.

A command stands still exactly; a column that creeps while the mass stands is a measurement. That is
taken as it is, but where the motion shows that it was stamped late (``logged_late``). Masses with
one ``lag_sd`` have drives of one kind and share one lag.

Different lags of drives of one kind are not modelled.
"""

from collections.abc import Collection
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.stops import MassError, is_rounded, is_travelling
from equipoise.model.arrays import Bools, Floats, Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

LAG = "mass_lag"
STAMP_SD = 0.1  # s, chosen: of a log beside that of the sensors, where nobody stated a lag
CREEPS = 0.5  # share of the steps at rest, chosen: a command changes in none but a ramp's ends


class CommandColumns(NamedTuple):
    """Which columns of a record are commands."""

    standing: list[int]  # masses that were commanded to stay where they are
    travelling: list[int]
    late: list[int]  # measured, and stamped nobody knows how late


def is_command(d: Series1, travelling: Bools) -> bool:
    """Say whether a column holds commands: no change in every second step at rest, or more."""
    at_rest = np.diff(d)[~travelling]
    return bool(np.count_nonzero(at_rest) <= CREEPS * len(at_rest))


def rests(track: Samples, masses: tuple[SlidingMass, ...]) -> bool:
    """Say whether no mass travels."""
    columns = zip(track.values.T, masses, strict=True)
    return not any(is_travelling(track.t, d, mass.speed).any() for d, mass in columns)


def command_columns(track: Samples, masses: tuple[SlidingMass, ...]) -> CommandColumns:
    """Return the masses with a lag or a sag whose columns are commands, or are stamped late.

    A travel has times of its own. Where nothing travels, masses that give way to the motion are all
    that moves, and its scale depends on when.
    """
    found, at_rest = CommandColumns([], [], []), rests(track, masses)
    for i, (mass, d) in enumerate(zip(masses, track.values.T, strict=True)):
        if mass.lag_sd == 0 and mass.sag_sd == 0:
            continue
        travelling = is_travelling(track.t, d, mass.speed)
        if is_command(d, travelling):
            (found.travelling if travelling.any() else found.standing).append(i)
        elif at_rest or (mass.logged_late and travelling.any()):
            found.late.append(i)
    return found


def kinds_of(commands: CommandColumns, masses: tuple[SlidingMass, ...]) -> dict[float, list[int]]:
    """Return the masses that are late, by the sd of their lag (s), for every kind."""
    moving = sorted((*commands.travelling, *commands.late))
    return {
        sd: [i for i in moving if masses[i].lag_sd == sd]
        for sd in sorted({mass.lag_sd for mass in masses if mass.lag_sd > 0})
    }


def lag_times(track: Samples, reaches: Collection[float]) -> Series1:
    """Return the record's times, and those at which the speed over such reaches (s) bends."""
    t, gaps = track.t, np.diff(track.t)
    more: list[Series1] = []
    for reach in reaches:
        sparse = np.append(gaps > reach, False) | np.append(False, gaps > reach)
        more += [t[sparse] - reach, t[sparse] + reach]
    return np.unique(np.concatenate([t, *more])) if any(map(len, more)) else t


def slowness(t: Series1, track: Samples, mass: int, reach: float) -> Series1:
    """Return minus the speed of a mass over [t - reach, t + reach], m/s."""
    d = track.values[:, mass]
    ahead, behind = (np.interp(t + s, track.t, d) for s in (reach, -reach))
    return (behind - ahead) / (2 * reach)


def lag_errors(t: Series1, track: Samples, kinds: dict[float, list[int]]) -> list[MassError]:
    """Return one unknown lag for each kind of drive that travels, with its effect at times ``t``.

    Its name states the kind, whichever of them travel in this part of a record.
    """
    return [
        MassError(f"{LAG}_{k + 1}", sd, [(i, slowness(t, track, i, sd)) for i in kind])
        for k, (sd, kind) in enumerate(kinds.items())
        if kind
    ]


def sags(commands: CommandColumns, masses: tuple[SlidingMass, ...], at_rest: bool) -> Floats:
    """Return one sd of how far each mass hangs below what is logged, m.

    A command does not show it. Nor does, within its accuracy, a log in steps of masses that rest.
    """
    found = np.zeros(len(masses))
    for i in (*commands.standing, *commands.travelling):
        found[i] = 0.0 if masses[i].logged_late else masses[i].sag_sd
    if at_rest:
        found = np.maximum(found, [m.accuracy if is_rounded(m) else 0.0 for m in masses])
    return found


def logged_late(masses: tuple[SlidingMass, ...]) -> tuple[SlidingMass, ...]:
    """Return masses whose measured positions may be stamped late, too."""
    return tuple(replace(mass, lag_sd=mass.lag_sd or STAMP_SD, logged_late=True) for mass in masses)


def lagging(masses: tuple[SlidingMass, ...], lag: float) -> tuple[SlidingMass, ...]:
    """Return masses whose rows are timed by a lag (s) that was found."""
    return tuple(replace(mass, lag=lag) for mass in masses)
