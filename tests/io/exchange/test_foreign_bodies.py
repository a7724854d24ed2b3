"""Ten texts in the manner of CAD programs, all of one body, and what they may lack."""

from pathlib import Path

import numpy as np
import pytest

from equipoise.io.exchange.body_file import read_foreign_body
from equipoise.io.exchange.mass_text import parse_mass_text
from equipoise.io.exchange.product_sign import body_of
from equipoise.model.errors import InputError

CAD = Path(__file__).parent / "cad"
TEXTS = sorted(CAD.glob("*.txt"))
# The body of all texts, by hand: J_P = J_C + m (|r|^2 E - r r^T) with r = (12, -20.3, 41.7) mm.
MASS = 14.24
COM = np.array([0.012, -0.0203, 0.0417])
INERTIA_C = np.array([[0.34, 0.012, -0.007], [0.012, 0.41, 0.0031], [-0.007, 0.0031, 0.28]])
INERTIA_P_XX = 0.34 + 14.24 * (0.0203**2 + 0.0417**2)
INERTIA_P_XY = 0.012 + 14.24 * 0.012 * 0.0203
UNSTATED = "freecad.txt"  # six numbers about one point, no principal moments


def notation_of(path: Path) -> str | None:
    return "tensor" if path.name == UNSTATED else None


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.stem)
def test_each_program_states_the_same_body(path):
    body, _ = read_foreign_body(path, notation_of(path))
    assert body.mass == pytest.approx(MASS, rel=1e-9)
    np.testing.assert_allclose(body.com, COM, rtol=1e-9)
    np.testing.assert_allclose(body.inertia_C, INERTIA_C, atol=1e-7)
    assert body.inertia_P[0, 0] == pytest.approx(INERTIA_P_XX, abs=1e-7)
    assert body.inertia_P[0, 1] == pytest.approx(INERTIA_P_XY, abs=1e-7)


def test_there_are_ten_of_them():
    assert len(TEXTS) == 10


@pytest.mark.parametrize("path", [p for p in TEXTS if p.name != UNSTATED], ids=lambda p: p.stem)
def test_the_wrong_sign_is_refused_where_the_numbers_show_it(path):
    _, shown = read_foreign_body(path)
    wrong = "integrals" if "tensor" in shown else "tensor"
    with pytest.raises(InputError, match=f"said to be {wrong}"):
        read_foreign_body(path, wrong)


def test_a_sign_that_nothing_shows_is_a_question():
    with pytest.raises(InputError, match=r"--products tensor .* or --products integrals"):
        read_foreign_body(CAD / UNSTATED)
    one, _ = read_foreign_body(CAD / UNSTATED, "tensor")
    other, _ = read_foreign_body(CAD / UNSTATED, "integrals")
    assert one.inertia_C[0, 1] == pytest.approx(-other.inertia_C[0, 1])


def test_one_product_alone_is_shown_by_two_points_and_not_by_principal_moments():
    # The eigenvalues of a tensor with one product do not depend on its sign.
    head = "Mass: 2 kg\nCenter of mass\nX: 10 mm\nY: 20 mm\nZ: 0 mm\n"
    central = (
        "Inertia at center of mass (kg mm^2)\nIxx: 20000.0\nIyy: 30000.0\nIzz: 40000.0\n"
        "Ixy: 500.0\nIxz: 0.0\nIyz: 0.0\n"
    )
    low, high = 25000 - np.hypot(5000, 500), 25000 + np.hypot(5000, 500)
    moments = f"Principal moments of inertia (kg mm^2)\nI1: {low}\nI2: {high}\nI3: 40000.0\n"
    with pytest.raises(InputError, match="whose sign nothing in it shows"):
        body_of(parse_mass_text(head + central + moments, "a text"), "a text")
    # 2 kg at (10, 20, 0) mm: the integral of x y dm grows by 400 kg mm2.
    about_origin = (
        "Inertia at origin (kg mm^2)\nIxx: 20800.0\nIyy: 30200.0\nIzz: 41000.0\n"
        "Ixy: {}\nIxz: 0.0\nIyz: 0.0\n"
    )
    for product, sign in ((900.0, -1), (100.0, 1)):
        text = head + central + about_origin.format(product)
        body, _ = body_of(parse_mass_text(text, "a text"), "a text")
        assert body.inertia_C[0, 1] == pytest.approx(sign * 500e-6)


def test_blocks_of_two_bodies_are_refused():
    text = (CAD / "fusion.txt").read_text(encoding="utf-8")
    with pytest.raises(InputError, match="inertias about two points that no single body has"):
        body_of(parse_mass_text(text.replace("14240.000 g", "15240.000 g"), "a text"), "a text")


@pytest.mark.parametrize(
    ("lacking", "named"),
    [("Mass", "no mass"), ("Center of Mass", "no centre of mass"), ("Ixx", "no block of six")],
)
def test_what_a_text_lacks_is_named(lacking, named):
    lines = (CAD / "fusion.txt").read_text(encoding="utf-8").splitlines()
    text = "\n".join(line for line in lines if not line.strip().startswith(lacking))
    with pytest.raises(InputError, match=named):
        parse_mass_text(text, "a text")
