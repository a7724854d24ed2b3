"""Whether the torque that wanders is white, and how strong it is where it is strongest.

A survey takes the unexplained torque for white noise of density ``walk``. A motor that nobody
stated, or a draught, pushes the same way for a while. Its density at the frequencies of the motion
is then greater than that of the same jumps taken for white, and intervals come out too short.

Jumps u_k with the prior sd s, of which smoothing leaves estimates u^, have over blocks of n cuts

    E (sum u^)^2 <= n s^2       in white noise: what the rows do not show is missing from u^

so that the ratio of the two, where it is beyond chance, is how much denser the noise is at the
frequency of one block. The density of the densest block is taken for all.

Cannot see what lasts longer than an eighth of the record, nor what a constant torque would be.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.record_model import RecordModel, process_noise, refitted
from equipoise.maths.chi_square import chi_square_limit
from equipoise.model.arrays import Floats

BLOCKS = 8  # chosen: with fewer a mean square says nothing
CHANCE = 0.1  # chosen: taken for denser than it is, noise only widens intervals


def block_ratios(u: Floats, n: int) -> Floats:
    """Return the mean square of sums over n rows of unit jumps (k, axes), over n."""
    count = len(u) // n
    sums = u[: count * n].reshape(count, n, u.shape[1]).sum(axis=1)
    return np.mean(sums**2, axis=0) / n


def densest(u: Floats, blocks: int = BLOCKS) -> Floats:
    """Return, for each axis of unit jumps (k, axes), by how much the densest blocks exceed white.

    Blocks are so long that there are ``blocks`` of them, at least.
    """
    lengths = [2**k for k in range(1, 20) if len(u) // 2**k >= blocks]
    found: Floats = np.ones_like(u[0])
    for n in lengths:
        ratio, count = block_ratios(u, n), len(u) // n
        limit = chi_square_limit(count, CHANCE) / count
        denser: Floats = np.where(ratio > limit, ratio, 1.0)
        found = np.maximum(found, denser)
    return found


def coloured(model: RecordModel) -> RecordModel:
    """Return the model with process noise as dense as it is at its densest frequency."""
    if not model.wanders:
        return model
    noise, sd = process_noise(model.fitted)
    ratio = densest(model.fitted.jumps[noise, :3] / sd)
    if np.all(ratio == 1.0):
        return model
    return refitted(replace(model, walk=model.walk * np.sqrt(ratio)))
