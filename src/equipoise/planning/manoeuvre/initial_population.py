"""Where a search for a manoeuvre begins: choices of a kind that gave much information before.

    start      tilted by some part of the limit in any direction, with some sway and spin
    masses     on level rails near home, those of each move near those of the last
               on sloping rails near the lowest end, not quite alike at each move
    waves      any

A platform that hangs low swings fast and stays within its limits, and each new stop of a mass errs
anew: several stops near the same place are known as their mean. A quarter of all choices lie
anywhere, for platforms that are not of this kind.
"""

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.maths.axes_across import axes_across
from equipoise.model.arrays import Floats
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import SlidingMass
from equipoise.planning.manoeuvre.manoeuvre_space import LEVEL, Space, range_of

TILTED = (0.1, 0.6)  # of the limit, chosen: more passes it where com is not where it is expected
SWAYED, SPUN = 0.6, 0.8  # of the greatest, chosen: the hand errs
ASIDE = 0.12  # of the rail, chosen: a level mass shifts com by some tilt of a low platform
AGAIN = 0.04  # of the way home, chosen: two steps of 50 mm in steps of 1 mm
UNLIKE = 0.03  # of the rail, chosen: from move to move
ANYWHERE = 4  # chosen: one of so many
EDGE = 0.01  # chosen: an evolution begins within its bounds


def first_choices(space: Space, count: int, rng: np.random.Generator) -> list[Floats]:
    """Return choices that a search may begin with."""
    return [
        rng.random(space.size) if k % ANYWHERE == 0 else likely(space, rng) for k in range(count)
    ]


def mildest(space: Space, body: MassProperties) -> list[Floats]:
    """Return choices that move a platform least: at rest, masses where they stand or low.

    Upright, or tilted as it hangs if it is as expected. A platform that hangs lower comes less far
    from the vertical; how early it should is open.
    """
    masses = ((0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 0.3))
    leans = (np.zeros(2), hanging(space, body))
    return [mild(space, lean, down, early) for lean in leans for down, early in masses]


def hanging(space: Space, body: MassProperties) -> Floats:
    """Return the lean (2,) at which a platform hangs, in parts of the tilt limit, 1 at most."""
    masses, up = space.testbed.masses, space.testbed.up
    d = np.array([space.standing.get(mass.name, 0.0) for mass in masses])
    moment = body.first_moment + d @ mass_maps(masses).first_moment
    level = np.array([moment @ axis for axis in axes_across(up)])
    aside = float(np.linalg.norm(level))
    tilt = float(np.arctan2(aside, -moment @ up))
    return min(tilt / space.tilt_limit, 1.0) * level / max(aside, 1e-300)


def mild(space: Space, lean: Floats, down: float, early: float) -> Floats:
    """Return such a choice: masses go a part of their way to the lowest end, at a share of time."""
    moves = space.moves if space.testbed.masses else 0
    shares = [
        (1 - down) * stand_share(space, kind[0]) + down * lowest(space, kind[0])
        for kind in space.kinds
    ]
    still = np.full(3, 0.5), np.full(2 * len(space.driven), 0.5)
    return np.concatenate(
        [0.5 + 0.5 * lean, still[0], np.full(moves, early), np.tile(shares, moves), still[1]]
    )


def stand_share(space: Space, mass: SlidingMass) -> float:
    """Return where a mass stands on its rail, from 0 to 1."""
    (low, high), now = range_of(space, mass), space.standing.get(mass.name, 0.0)
    return (now - low) / (high - low)


def likely(space: Space, rng: np.random.Generator) -> Floats:
    """Return a choice of the kind that gave much information before."""
    angle, tilt = rng.uniform(0.0, 2 * np.pi), rng.uniform(*TILTED)
    lean = tilt * np.array([np.cos(angle), np.sin(angle)])
    push = rng.uniform(-1.0, 1.0, 3) * [SWAYED, SWAYED, SPUN]
    moves = space.moves if space.testbed.masses else 0
    shares = [shares_of(space, kind[0], moves, rng) for kind in space.kinds]
    numbers = np.concatenate([
        0.5 + 0.5 * lean,
        0.5 + 0.5 * push,
        rng.random(moves),
        np.ravel(np.transpose(shares)),
        rng.random(2 * len(space.driven)),
    ])  # fmt: skip
    return np.clip(numbers, EDGE, 1 - EDGE)


def shares_of(space: Space, mass: SlidingMass, moves: int, rng: np.random.Generator) -> Floats:
    """Return where on its rail a mass goes at each move, from 0 to 1."""
    home, down = home_share(space, mass), lowest(space, mass)
    aside = ASIDE * rng.standard_normal() if down == home else 0.0
    return down + AGAIN * (home - down) + aside + UNLIKE * rng.standard_normal(moves)


def home_share(space: Space, mass: SlidingMass) -> float:
    """Return where home is on a rail, from 0 to 1."""
    low, high = range_of(space, mass)
    return float(np.clip(-low / (high - low), 0.0, 1.0))


def lowest(space: Space, mass: SlidingMass) -> float:
    """Return the end of a rail that is lowest, from 0 to 1; home where the rail is level."""
    slope = float(mass.axis @ space.testbed.up)
    return home_share(space, mass) if abs(slope) < LEVEL else float(slope < 0)
