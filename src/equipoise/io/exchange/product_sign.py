"""Whether printed products of inertia are elements of the tensor, or integrals of the other sign.

    tensor:     J_xy = -integral of x y dm          integrals:  I_xy = +integral of x y dm

Programs differ, and one program by its settings. Three things show the sign, where the text has
them; each is compared under both assumptions, s = +1 (tensor) and -1 (integrals):

    blocks about two points      s (I_xy,origin - I_xy,C)  =  -m x y
    principal moments            eigenvalues of the tensor with products s I_xy
    feasibility                  some body can have that tensor

Where a body has one product only, principal moments do not show its sign.
"""

from collections.abc import Callable

import numpy as np

from equipoise.io.exchange.mass_text import Block, MassText, Notation
from equipoise.model.arrays import Floats, Matrix3
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import (
    MassProperties,
    from_centre,
    parallel_axis,
    smallest_second_moment,
)
from equipoise.model.stated_body import elements, tensor_of

SIGNS: dict[Notation, float] = {"tensor": 1.0, "integrals": -1.0}
DIGITS = 1e-3  # relative, chosen: what the fewest printed digits leave
CLEAR = 10.0  # chosen: how much worse the other sign has to fit
NONE = 1e-6  # of the mean moment, chosen: products that matter to nobody


def body_of(
    stated: MassText, source: str, notation: Notation | None = None
) -> tuple[MassProperties, str]:
    """Return the body about the text's origin, and what shows the sign of its products.

    ``notation`` is what the user says. InputError where signs contradict each other or where
    nothing shows them, and where blocks about two points are of different bodies.
    """
    _check_points(stated, source)
    shown = _shown_signs(stated)
    said: Notation | None = notation or next(
        (each.notation for each in stated.blocks if each.notation), None
    )
    kinds: set[Notation] = set(shown.values())
    if said:
        kinds.add(said)
    if len(kinds) > 1:
        found = "; ".join(f"{what}: {kind}" for what, kind in shown.items())
        raise InputError(source, f"products said to be {said}, but {found}", "--products as it is")
    if not kinds and _has_products(stated):
        wanted = "--products tensor (J_xy = -integral of x y dm) or --products integrals"
        raise InputError(source, "products of inertia whose sign nothing in it shows", wanted)
    kind: Notation = kinds.pop() if kinds else "tensor"
    inertia_C = _central(stated, SIGNS[kind])
    if smallest_second_moment(inertia_C) <= 0:
        raise InputError(source, "a physically inconsistent inertia", "the units as printed")
    reason = ", ".join(shown) or ("as stated" if said else "no products")
    return from_centre(stated.mass, stated.centre, inertia_C), f"products: {kind} ({reason})"


def signed(block: Block, sign: float) -> Matrix3:
    """Return the tensor of a block whose products have a sign."""
    return tensor_of(block.six * np.array([1, 1, 1, sign, sign, sign]))


def _central(stated: MassText, sign: float) -> Matrix3:
    """Return the inertia about the centre of mass: printed, or moved from the origin."""
    central = _block(stated, "C")
    if central is not None:
        return signed(central, sign)
    return MassProperties(stated.mass, stated.centre, signed(stated.blocks[0], sign)).inertia_C


def _block(stated: MassText, point: str) -> Block | None:
    return next((block for block in stated.blocks if block.point == point), None)


def _has_products(stated: MassText) -> bool:
    """Say whether any product is worth a sign."""
    six = np.array([block.six for block in stated.blocks])
    return bool(np.abs(six[:, 3:]).max() > NONE * six[:, :3].mean())


def _shown_signs(stated: MassText) -> dict[str, Notation]:
    """Return what the numbers themselves show, by what shows it."""
    checks = {
        "blocks about two points": _misfits_of_points(stated),
        "principal moments": _misfits_of_moments(stated),
        "feasibility": _misfits_of_feasibility(stated),
    }
    shown = dict[str, Notation]()
    for what, misfits in checks.items():
        kind = None if misfits is None else _better(misfits)
        if kind is not None:
            shown[what] = kind
    return shown


def _better(misfits: dict[Notation, float]) -> Notation | None:
    """Return the sign that fits, if the other clearly does not."""
    ranked: list[Notation] = sorted(misfits, key=misfits.__getitem__)
    low, high = ranked
    fits = misfits[low] < DIGITS
    return low if fits and misfits[high] > CLEAR * max(misfits[low], DIGITS / CLEAR) else None


def _misfits_of_points(stated: MassText) -> dict[Notation, float] | None:
    about_C, about_O = _block(stated, "C"), _block(stated, "origin")
    if about_C is None or about_O is None:
        return None
    due = elements(parallel_axis(stated.mass, stated.centre))[3:]
    printed = (about_O.six - about_C.six)[3:]
    return _of_both(lambda sign: _relative(sign * printed - due, due))


def _misfits_of_moments(stated: MassText) -> dict[Notation, float] | None:
    about_C = _block(stated, "C")
    if about_C is None or len(stated.principal) != 3:
        return None
    printed = np.sort(list(stated.principal.values()))

    def misfit(sign: float) -> float:
        moments = np.linalg.eigvalsh(signed(about_C, sign)).astype(np.float64, copy=False)
        return _relative(moments - printed, about_C.six[3:])

    return _of_both(misfit)


def _misfits_of_feasibility(stated: MassText) -> dict[Notation, float]:
    return _of_both(lambda sign: 0.0 if smallest_second_moment(_central(stated, sign)) > 0 else 1.0)


def _of_both(misfit: Callable[[float], float]) -> dict[Notation, float]:
    """Return the misfit under either assumption."""
    return {kind: misfit(sign) for kind, sign in SIGNS.items()}


def _relative(left: Floats, due: Floats) -> float:
    return float(np.abs(left).max() / max(float(np.abs(due).max()), np.finfo(float).tiny))


def _check_points(stated: MassText, source: str) -> None:
    """Raise InputError where moments about two points, which have no sign, are of two bodies."""
    about_C, about_O = _block(stated, "C"), _block(stated, "origin")
    if about_C is None or about_O is None:
        return
    due = elements(parallel_axis(stated.mass, stated.centre))[:3]
    if _relative((about_O.six - about_C.six)[:3] - due, about_O.six[:3]) > DIGITS:
        found = "inertias about two points that no single body has"
        raise InputError(source, found, "mass, centre of mass and both blocks of the same body")
