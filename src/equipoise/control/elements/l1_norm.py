"""The L1 norm of a disturbance's filtered remainder, for the condition of L1 adaptive control.

    ||(sE - A)^-1 b (1 - C(s))||_L1 L < 1,      C = w_c / (s + w_c),  1 - C = s / (s + w_c)

The L1 norm of a transfer function is the integral of the size of its impulse response; of several
outputs the largest counts. With g = exp(A t) b that of (sE - A)^-1 b, that of the product is

    y = g - w_c f,      f' = -w_c f + g,  f(0) = 0

which is exp(M t) (b, 0) with M = [A, 0; E, -w_c E], y the upper part less w_c times the lower. It
is summed by the trapezium rule on a grid that is STEPS times finer than the fastest mode, until the
slowest has decayed. A must be stable. By hand, A = -k, b = 1: y changes sign once and

    norm = 2 (exp(-k t) - exp(-w_c t)) / (w_c - k),   t = ln(w_c / k) / (w_c - k)

(Cao and Hovakimyan 2006; Hovakimyan and Cao 2010, theorem 2.1.1.)
"""

import numpy as np
import scipy

from equipoise.model.arrays import Floats, Square

STEPS = 200  # chosen: in the time of the fastest mode; the norm is then right to 1e-5
DECAYED = 16.0  # chosen: times of the slowest mode, after which 1e-7 is left


def l1_norm(matrix: Square, b: Floats, bandwidth: float) -> float:
    """Return ||(sE - A)^-1 b (1 - C)||_L1 for C of that bandwidth (rad/s)."""
    n = len(b)
    eye = np.eye(n)
    whole = np.block([[matrix, np.zeros((n, n))], [eye, -bandwidth * eye]])
    modes = np.linalg.eigvals(whole)
    step = 1 / (STEPS * float(np.abs(modes).max()))
    count = int(DECAYED / float(-modes.real.max()) / step)
    forward = np.array(scipy.linalg.expm(whole * step), dtype=np.float64)
    z = np.concatenate([b, np.zeros(n)])
    sizes = np.zeros((count, n))
    for row in sizes:
        row[:] = np.abs(z[:n] - bandwidth * z[n:])
        z = forward @ z
    return float((np.sum(sizes, axis=0) - 0.5 * sizes[0]).max() * step)
