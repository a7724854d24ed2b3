"""Basilisk, 42 and Simscape: lines for a script or a table that the user already has."""

from equipoise.io.exchange.remarks import INTEGRAL, lines_of
from equipoise.model.arrays import Floats
from equipoise.model.stated_body import StatedBody

BODY_42 = "Body 0"


def remarked(stated: StatedBody, mark: str) -> list[str]:
    """Return the remarks, each line behind a comment's mark."""
    return [f"{mark} {line}" for line in lines_of(stated)]


def listed(values: Floats) -> str:
    """Return numbers with commas between."""
    return ", ".join(repr(float(value)) for value in values)


def basilisk(stated: StatedBody) -> str:
    """Return a Python function that sets the hub of a ``spacecraft.Spacecraft``.

    Basilisk's reference point B is P here: ``r_BcB_B`` leads from it to the centre of mass.
    """
    rows = "".join(f"        [{listed(row)}],\n" for row in stated.body.inertia_C)
    return "\n".join((
        *remarked(stated, "#"), "", "", "def set_hub(spacecraft):",
        '    """Give a Basilisk spacecraft these mass properties; its point B is P."""',
        f"    spacecraft.hub.mHub = {stated.body.mass!r}  # kg",
        f"    spacecraft.hub.r_BcB_B = [[x] for x in ({listed(stated.body.com)})]  # m",
        "    spacecraft.hub.IHubPntBc_B = [  # kg m2, about the centre of mass",
        f"{rows}    ]", "",
    ))  # fmt: skip


def nasa_42(stated: StatedBody) -> str:
    """Return the lines of a body in a spacecraft file of 42, whose products are integrals."""
    six = stated.about_C
    header = lines_of(stated, INTEGRAL)
    values = (
        (repr(stated.body.mass), "Mass"),
        (spaced(six[:3]), "Moments of Inertia (kg-m^2)"),
        (spaced(-six[3:]), "Products of Inertia (xy,xz,yz)"),
        (spaced(stated.body.com), "Location of mass center, m"),
    )
    body = [f"{value:<60} ! {meaning}" for value, meaning in values]
    head = f"{f'  {BODY_42}  ':=^72}"
    return "\n".join((*(f"! {line}" for line in header), head, *body, ""))


def spaced(values: Floats) -> str:
    """Return numbers with blanks between."""
    return "  ".join(repr(float(value)) for value in values)


def simulink(stated: StatedBody) -> str:
    """Return a MATLAB script with the parameters of Simscape Multibody's block Inertia.

    The block takes the centre of mass from its frame, which is P here, moments and products about
    the centre of mass, products as elements of the tensor in the order yz, zx, xy.
    """
    xx, yy, zz, xy, xz, yz = (float(x) for x in stated.about_C)
    rows = "; ".join(listed(row) for row in stated.covariance_about_C)
    return "\n".join((
        *remarked(stated, "%"),
        f"equipoise.Mass = {stated.body.mass!r}; % kg",
        f"equipoise.CenterOfMass = [{listed(stated.body.com)}]; % m, from P",
        f"equipoise.MomentsOfInertia = [{xx!r}, {yy!r}, {zz!r}]; % kg m^2, about C",
        f"equipoise.ProductsOfInertia = [{yz!r}, {xz!r}, {xy!r}]; % kg m^2: yz, zx, xy",
        "% Order of the covariance: mass, J_C xx yy zz xy xz yz, com x y z.",
        f"equipoise.Covariance = [{rows.replace('inf', 'Inf')}];",
        "",
    ))  # fmt: skip
