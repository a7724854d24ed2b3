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

import numpy as np

from equipoise.actuators.stops import MassError, is_travelling
from equipoise.model.arrays import Floats, Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

LAG = "mass_lag"
CREEPS = 0.5  # share of the steps at rest, chosen: a command changes in none but a ramp's ends


def is_command(t: Series1, d: Series1, mass: SlidingMass) -> bool:
    """Say whether a column tells what a mass was told: in one step at rest of two, no change."""
    at_rest = np.diff(d)[~is_travelling(t, d, mass.speed)]
    return np.count_nonzero(at_rest) <= CREEPS * len(at_rest)


def told(track: Samples, masses: tuple[SlidingMass, ...]) -> list[int]:
    """Return the masses whose columns are commands to travel."""
    t, values = track.t, track.values
    return [
        i
        for i, (d, mass) in enumerate(zip(values.T, masses, strict=True))
        if is_command(t, d, mass) and is_travelling(t, d, mass.speed).any()
    ]


def kinds_of(track: Samples, masses: tuple[SlidingMass, ...]) -> dict[float, list[int]]:
    """Return the masses that follow a command late, by the sd of their lag (s)."""
    late = [i for i in told(track, masses) if masses[i].lag_sd > 0]
    return {
        sd: [i for i in late if masses[i].lag_sd == sd]
        for sd in sorted({masses[i].lag_sd for i in late})
    }


def lag_times(track: Samples, masses: tuple[SlidingMass, ...]) -> Series1:
    """Return the record's times, and those at which the speed of a sparse record bends."""
    t, gaps, times = track.t, np.diff(track.t), [track.t]
    for sd in kinds_of(track, masses):
        sparse = np.append(gaps > sd, False) | np.append(False, gaps > sd)
        times += [t[sparse] - sd, t[sparse] + sd]
    return np.unique(np.concatenate(times))


def slowness(t: Series1, track: Samples, mass: int, reach: float) -> Series1:
    """Return minus the speed of a mass over [t - reach, t + reach], m/s."""
    d = track.values[:, mass]
    ahead, behind = (np.interp(t + s, track.t, d) for s in (reach, -reach))
    return (behind - ahead) / (2 * reach)


def lag_errors(t: Series1, track: Samples, masses: tuple[SlidingMass, ...]) -> list[MassError]:
    """Return one unknown lag for each kind of drive, felt at the times ``t``."""
    return [
        MassError(f"{LAG}_{k + 1}", sd, [(i, slowness(t, track, i, sd)) for i in kind])
        for k, (sd, kind) in enumerate(kinds_of(track, masses).items())
    ]


def sags(track: Samples, masses: tuple[SlidingMass, ...]) -> Floats:
    """Return one sd of how far each mass hangs below its command, m; none where nothing travels.

    Then home is where the masses hang.
    """
    travels, t = len(told(track, masses)) > 0, track.t
    return np.array([
        mass.sag_sd * (travels and is_command(t, d, mass))
        for d, mass in zip(track.values.T, masses, strict=True)
    ])  # fmt: skip
