"""How late masses follow a recorded command.

A servo that pulls as a spring and a damper follows a slow command late by the same time throughout
(2 / w when critically damped), and a log may be stamped early. With a lag tau

    d(t) = d_log(t - tau) = d_log(t) - tau d_log'(t) + ...

so a lag is felt as minus the speed, and the momentum of the travel changes with -tau d_log''. The
speed is that over [t - s, t + s] with s one sd of the lag: what it leaves out of a constant speed's
begin and end is of second order, tau^2, and cancels between them.

A command stands still exactly; a column that creeps while the mass stands is a measurement, and is
taken as it is. Masses with one ``lag_sd`` have drives of one kind and share one lag.

Cannot see that drives of one kind lag differently.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.stops import MassError, is_travelling
from equipoise.model.arrays import Bools, Floats, Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

LAG = "mass_lag"
CREEPS = 0.5  # share of the steps at rest, chosen: a command changes in none but a ramp's ends


class Way(NamedTuple):
    """What a mass was told, without what it does at rest."""

    mass: int
    sd: float  # s, of the lag
    gone: Series1  # (n,) m since the first row


def is_measured(d: Series1, travelling: Bools) -> bool:
    """Say whether a column changes while its mass stands."""
    still = np.diff(d)[~travelling]
    return len(still) > 0 and np.count_nonzero(still) > CREEPS * len(still)


def ways(track: Samples, masses: tuple[SlidingMass, ...]) -> list[Way]:
    """Return the ways of all masses that were told to travel."""
    found: list[Way] = []
    for i, mass in enumerate(masses):
        d = track.values[:, i]
        travelling = is_travelling(track.t, d, mass.speed)
        if mass.lag_sd > 0 and travelling.any() and not is_measured(d, travelling):
            steps = np.where(travelling, np.diff(d), 0.0)
            found.append(Way(i, mass.lag_sd, np.append(0.0, np.cumsum(steps))))
    return found


def lag_times(track: Samples, masses: tuple[SlidingMass, ...]) -> Series1:
    """Return the record's times, and those at which the speed of a sparse record bends."""
    t = track.t
    gaps = np.diff(t)
    times = [t]
    for sd in {way.sd for way in ways(track, masses)}:
        sparse = np.append(gaps > sd, False) | np.append(False, gaps > sd)
        times += [t[sparse] - sd, t[sparse] + sd]
    return np.unique(np.concatenate(times))


def slowness(t: Series1, way: Way, rows: Series1) -> Series1:
    """Return minus the speed of a way at ``t``, m/s."""
    ahead, behind = (np.interp(t + s, rows, way.gone) for s in (way.sd, -way.sd))
    return (behind - ahead) / (2 * way.sd)


def sags(track: Samples, masses: tuple[SlidingMass, ...]) -> Floats:
    """Return one sd of how far each mass hangs below its command, m; none where nothing travels."""
    told = [not is_measured(d, is_travelling(track.t, d, mass.speed))
            for d, mass in zip(track.values.T, masses, strict=True)]  # fmt: skip
    travels = len(ways(track, masses)) > 0
    return np.array([mass.sag_sd * (travels and yes) for mass, yes in zip(masses, told, strict=True)])


def lag_errors(t: Series1, track: Samples, masses: tuple[SlidingMass, ...]) -> list[MassError]:
    """Return one unknown lag for each kind of drive."""
    told = ways(track, masses)
    kinds = sorted({way.sd for way in told})
    return [
        MassError(f"{LAG}_{k + 1}", sd,
                  [(way.mass, slowness(t, way, track.t)) for way in told if way.sd == sd])
        for k, sd in enumerate(kinds)
    ]  # fmt: skip
