"""Ultimate gain and period of a loop through masses, by calculation and by relay; the rule of 1942.

The loop is v = -K sigma, sigma = theta + L rate, on theta'' = -w0^2 theta + a v(t - T)
(``hanging``). L is the lead: without it no gain gives an ultimate cycle at all, for a platform
without damping swings up at every gain as soon as the masses are late (phase -w T beyond -180
degrees at once). The proportional test of Ziegler and Nichols is thus done with the gyro's rate in.

By calculation: masses that go to +-d at the speed R follow a relay as a trapezoid, which is a
relay late by d / R whose first harmonic is smaller by sinc(w d / R). The loop closes where

    atan(w L) = w T + asin(BAND),      T = delay + step / 2 + d / R
    K_u = (w^2 - w0^2) / (a sqrt(1 + (w L)^2) sin(x) / x),   x = w d / R,   T_u = 2 pi / w

By experiment (Astrom and Hagglund 1984): v = -d sgn(sigma) gives a cycle of amplitude A in sigma
whose first harmonic a gain K_u = 4 d / (pi A) would keep. It is counted after CYCLES_IN cycles, as
the mean of CYCLES_USED. Noise would switch it too soon, so it switches at BAND times the calculated
cycle beyond zero (hysteresis), which is another lag, asin(BAND).

The rule, Ziegler and Nichols 1942, for proportional and integral action: the derivative is in
sigma already, in series,

    v = -K (1 + 1 / (T_i s)) (1 + L s) theta,    K = 0.45 K_u,   T_i = T_u / 1.2

The calculation includes the first harmonic only. The two ways agree to 8 % in gain, and to a fifth
where the masses are so slow that the cycle comes near the swing itself.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy

BAND = 0.1  # chosen: twice the noise of a fair gyro, and 6 degrees of lag
CYCLES_IN, CYCLES_USED = 2, 3  # chosen: the cycle has settled to a per cent after two


class Loop(NamedTuple):
    """The parameters of one axis that the rule needs."""

    gain: float  # a, rad/s^2 per m
    frequency: float  # w0, rad/s
    lead: float  # L, s
    delay: float  # s, without the masses' travel
    slew: float  # m/s
    relay: float  # d, m


class Ultimate(NamedTuple):
    """The cycle at the edge of stability."""

    gain: float  # K_u, m of shift per rad
    period: float  # T_u, s


class Gains(NamedTuple):
    """A PID in parallel form, on tilt."""

    proportional: float  # m/rad
    integral: float  # m/(rad s)
    derivative: float  # m s/rad


def ultimate(loop: Loop) -> Ultimate:
    """Return the calculated ultimate cycle; a gain not above zero: lag beyond what L makes up."""
    lag, band = loop.delay + loop.relay / loop.slew, float(np.arcsin(BAND))

    def margin(w: float) -> float:
        return float(np.arctan(w * loop.lead)) - w * lag - band

    if margin(loop.frequency) <= 0:
        return Ultimate(0.0, np.inf)
    w = float(scipy.optimize.brentq(margin, loop.frequency, np.pi / 2 / lag))  # pyright: ignore
    smaller = float(np.sinc(w * loop.relay / loop.slew / np.pi))
    gain = (w**2 - loop.frequency**2) / (loop.gain * np.hypot(1, w * loop.lead) * smaller)
    return Ultimate(float(gain), 2 * np.pi / w)


def rule(cycle: Ultimate, lead: float) -> Gains:
    """Return K, T_i and the lead in series, written out in parallel."""
    gain, time = 0.45 * cycle.gain, cycle.period / 1.2
    return Gains(gain * (1 + lead / time), gain / time, gain * lead)


# --- The experiment --------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Relay:
    """Where a relay experiment stands."""

    output: float = 1.0  # -1 or 1, times d
    high: float = -np.inf  # rad, greatest sigma since it last rose
    low: float = np.inf
    rises: tuple[float, ...] = ()  # s, when sigma rose through the band
    swings: tuple[float, ...] = ()  # rad, half of peak to peak, cycle by cycle


def band_of(loop: Loop, cycle: Ultimate) -> float:
    """Return where the relay switches (rad) if this is the calculated cycle."""
    return BAND * 4 * loop.relay / (np.pi * cycle.gain)


def relay_step(relay: Relay, t: float, sigma: float, band: float) -> Relay:
    """Return the experiment after a sample of sigma (rad) at t (s)."""
    relay = replace(relay, high=max(relay.high, sigma), low=min(relay.low, sigma))
    if relay.output > 0 and sigma > band:
        swing = (relay.high - relay.low) / 2
        swings = (*relay.swings, swing) if relay.rises else ()
        return Relay(-1.0, sigma, sigma, (*relay.rises, t), swings)
    return replace(relay, output=1.0) if relay.output < 0 and sigma < -band else relay


def has_settled(relay: Relay) -> bool:
    """Say whether the relay has completed enough cycles."""
    return len(relay.swings) >= CYCLES_IN + CYCLES_USED


def measured(relay: Relay, amplitude: float) -> Ultimate:
    """Return the ultimate cycle measured with a relay of +-``amplitude`` (m)."""
    swing = float(np.mean(relay.swings[-CYCLES_USED:]))
    period = (relay.rises[-1] - relay.rises[-1 - CYCLES_USED]) / CYCLES_USED
    return Ultimate(4 * amplitude / (np.pi * swing), period)
