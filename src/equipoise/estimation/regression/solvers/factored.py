"""Recursive least squares with P in factors, for arithmetic of single precision.

    P = U D U^T,      U unit upper triangular, D diagonal
    f = U^T h,  v = D f,  alpha_j = R + sum_i<=j f_i v_i
    D_j *= alpha_j-1 / alpha_j,    U_ij += K_i (-f_j / alpha_j-1),    K_i += v_j U_ij
    x += K / alpha_n (b - h x)

It is the recursion of ``recursive`` without forgetting, equation by equation (Bierman,
Factorization Methods for Discrete Sequential Estimation, 1977, chapter V). D stays positive
whatever is rounded; P itself, in single precision, does not. Unknowns that restart stand
first: their rows of U and D are then all there is of them. U above its diagonal is stored column by
column.
"""

from equipoise.model.arrays import Floats


def place(i: int, j: int) -> int:
    """Return where U_ij is, i < j."""
    return j * (j - 1) // 2 + i


def restart_first(x: Floats, D: Floats, U: Floats, count: int, variance: float) -> None:
    """Begin the first unknowns anew, uncorrelated with the rest."""
    for i in range(count):
        x[i], D[i] = 0.0, variance
        for j in range(i + 1, x.shape[0]):
            U[place(i, j)] = 0.0


def learn_factored(
    x: Floats, D: Floats, U: Floats, h: Floats, b: float, variance: float, gain: Floats
) -> None:
    """Take one equation h x = b; ``gain`` is room for that, and h holds f afterwards."""
    n, left = x.shape[0], b
    for i in range(n):
        left -= h[i] * x[i]
    for k in range(n):
        j = n - 1 - k
        for i in range(j):
            h[j] += U[place(i, j)] * h[i]
    alpha = variance
    for j in range(n):
        v, before = D[j] * h[j], alpha
        alpha += h[j] * v
        D[j] = D[j] * (before / alpha)
        for i in range(j):
            u = U[place(i, j)]
            U[place(i, j)] = u - gain[i] * (h[j] / before)
            gain[i] += v * u
        gain[j] = v
    for i in range(n):
        x[i] += gain[i] * (left / alpha)


def variance_of(D: Floats, U: Floats, i: int) -> float:
    """Return P_ii."""
    total = D[i]
    for j in range(i + 1, D.shape[0]):
        u = U[place(i, j)]
        total += u * u * D[j]
    return total
