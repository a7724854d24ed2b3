"""The sum of parts: by hand, against MuJoCo's geoms, by conservation, and its sd against draws."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from equipoise.estimation.mass_budget.budget import mass_budget
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.maths.linalg import element_sizes, pack_symmetric, unpack_symmetric
from equipoise.model.estimate import INERTIA
from equipoise.model.mass_budget import CENTRAL
from equipoise.model.mass_properties import is_possible, parallel_axis
from equipoise.model.outcome import OutcomeCode
from tests.estimation.mass_budget.part_builders import part, parts_list


def central(budget):
    return np.array([p.value for p in budget.central])


def values(budget):
    return np.array([p.value for p in budget.estimate.parameters])


def test_a_plate_and_a_battery_by_hand():
    """4 kg of 400 x 400 x 10 mm, 40 mm below P; 1.5 kg of 120 x 60 x 40 mm at (100, 0, -20) mm.

    J_xx = 4 (0.4^2 + 0.01^2) / 12 + 4 0.04^2 + 1.5 (0.06^2 + 0.04^2) / 12 + 1.5 0.02^2
    """
    found = mass_budget(parts_list(
        part("box", 4.0, (0.4, 0.4, 0.01), (0, 0, -0.04)),
        part("box", 1.5, (0.12, 0.06, 0.04), (0.1, 0, -0.02)),
    ))  # fmt: skip
    assert found.body.mass == pytest.approx(5.5)
    np.testing.assert_allclose(found.body.com, [0.15 / 5.5, 0, -0.19 / 5.5], rtol=1e-12)
    xx = 0.0533666667 + 0.0064 + 0.00065 + 0.0006
    yy = 0.0533666667 + 0.0064 + 0.002 + 0.0156
    zz = 0.1066666667 + 0.00225 + 0.015
    np.testing.assert_allclose(np.diag(found.body.inertia_P), [xx, yy, zz], rtol=1e-9)
    assert found.body.inertia_P[0, 2] == pytest.approx(1.5 * 0.1 * 0.02)  # minus the integral of xz
    assert all(p.sd == 0.0 for p in found.estimate.parameters)


@pytest.mark.parametrize(
    ("shape", "size", "moments"),
    [
        ("sphere", (0.2,), [0.4 * 0.01] * 3),
        ("cylinder", (0.2, 0.6), [0.0025 + 0.03, 0.0025 + 0.03, 0.005]),
        ("plate", (0.3, 0.4), [0.16 / 12, 0.09 / 12, 0.25 / 12]),
        ("tube", (0.2, 0.2 - 1e-9, 0.0 + 1e-9), [0.005, 0.005, 0.01]),  # a hoop: m r^2
        ("point", (), [0.0, 0.0, 0.0]),
    ],
)
def test_shapes_of_a_kilogram_by_their_text_book_moments(shape, size, moments):
    found = mass_budget(parts_list(part(shape, 1.0, size)))
    np.testing.assert_allclose(central(found), [*moments, 0, 0, 0], rtol=1e-7, atol=1e-15)


def test_a_tube_is_a_cylinder_less_another():
    """0.8 kg of a full cylinder of 200 mm, less its core of 100 mm (a quarter of it)."""
    tube = mass_budget(parts_list(part("tube", 0.6, (0.2, 0.1, 0.3))))
    full = mass_budget(parts_list(part("cylinder", 0.8, (0.2, 0.3))))
    core = mass_budget(parts_list(part("cylinder", 0.2, (0.1, 0.3))))
    np.testing.assert_allclose(central(tube), central(full) - central(core), rtol=1e-12)


def geom(kind, half, each):
    """A geom of MuJoCo with the mass, place and turn of a part."""
    q = exponential(each["turn"])
    numbers = {"size": half, "pos": each["centre"], "quat": q}
    texts = " ".join(f'{k}="{" ".join(map(repr, map(float, v)))}"' for k, v in numbers.items())
    return f'<geom type="{kind}" mass="{each["mass"]!r}" {texts}/>'


def test_sums_equal_those_of_mujoco():
    """A box, a cylinder and a sphere, turned: total mass, centre and inertia of its body."""
    rng = np.random.default_rng(1)
    placed = [
        {"mass": float(m), "centre": rng.normal(0, 0.2, 3), "turn": rng.normal(0, 1, 3)}
        for m in (3.0, 2.0, 1.0)
    ]
    sizes = [("box", (0.3, 0.2, 0.1)), ("cylinder", (0.2, 0.3)), ("sphere", (0.16,))]
    halves = [(0.15, 0.1, 0.05), (0.1, 0.15), (0.08,)]
    geoms = "".join(geom(s, h, e) for (s, _), h, e in zip(sizes, halves, placed, strict=True))
    text = f"<mujoco><worldbody><body><freejoint/>{geoms}</body></worldbody></mujoco>"
    body = mujoco.MjModel.from_xml_string(text)
    parts = [
        part(s, e["mass"], size, e["centre"], turn=to_matrix(exponential(e["turn"])))
        for (s, size), e in zip(sizes, placed, strict=True)
    ]
    found = mass_budget(parts_list(*parts))
    axes = to_matrix(body.body_iquat[1])
    np.testing.assert_allclose(found.body.mass, body.body_mass[1], rtol=1e-9)
    np.testing.assert_allclose(found.body.com, body.body_ipos[1], rtol=1e-6, atol=1e-9)
    inertia = axes @ np.diag(body.body_inertia[1]) @ axes.T
    np.testing.assert_allclose(found.body.inertia_C, inertia, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(central(found), pack_symmetric(inertia), rtol=1e-6, atol=1e-9)


def some_parts():
    """Three parts, every sd of which is at work."""
    doubt = {"centre_sd": 1e-3, "turn_sd": 0.02, "size_sd": 2e-3, "inertia_sd": 0.05}
    own = np.array([[2.0, 0.1, 0.2], [0.1, 3.0, -0.3], [0.2, -0.3, 4.0]]) * 1e-2
    return [
        part("box", 4.0, (0.4, 0.3, 0.1), (0.05, -0.02, -0.04), mass_sd=0.04,
             turn=to_matrix(exponential(np.array([0.3, -0.2, 0.5]))), **doubt),
        part("cylinder", 1.5, (0.12, 0.2), (0.1, 0.1, -0.02), mass_sd=0.03, **doubt),
        part("tensor", 2.0, (), (-0.1, 0.05, 0.06), mass_sd=0.02, inertia=own, **doubt),
    ]  # fmt: skip


def test_the_sum_about_C_and_the_sum_about_P_are_one_body():
    found = mass_budget(parts_list(*some_parts()))
    body = found.body
    moved = unpack_symmetric(central(found)) + parallel_axis(body.mass, body.com)
    np.testing.assert_allclose(moved, body.inertia_P, rtol=1e-12)
    assert is_possible(body)
    assert found.estimate.outcome.code == OutcomeCode.ESTIMATED


def test_a_common_shift_moves_the_centre_and_leaves_the_inertia_about_it():
    shift = np.array([0.1, -0.2, 0.3])
    here = mass_budget(parts_list(*some_parts()))
    there = mass_budget(
        parts_list(*[replace(each, centre=each.centre + shift) for each in some_parts()])
    )
    np.testing.assert_allclose(there.body.com - here.body.com, shift, rtol=1e-12)
    np.testing.assert_allclose(central(there), central(here), rtol=1e-10, atol=1e-12)


def test_two_halves_are_a_whole():
    whole = mass_budget(parts_list(part("box", 2.0, (0.4, 0.2, 0.1))))
    halves = [part("box", 1.0, (0.2, 0.2, 0.1), (x, 0, 0), name=f"half {x}") for x in (-0.1, 0.1)]
    np.testing.assert_allclose(values(mass_budget(parts_list(*halves))), values(whole), atol=1e-15)


def drawn(each, rng):
    """A part as it may be."""
    turn = each.turn @ to_matrix(exponential(each.turn_sd * rng.normal(size=3)))
    factor = 1 + each.inertia_sd * rng.normal()
    size = each.size + each.size_sd * rng.normal(size=len(each.size))
    mass = each.mass + each.mass_sd * rng.normal()
    made = replace(
        each, mass=mass, centre=each.centre + each.centre_sd * rng.normal(size=3), size=size
    )
    own = each.inertia if each.shape == "tensor" else unpack_symmetric(
        central(mass_budget(parts_list(replace(made, turn=np.eye(3), centre=np.zeros(3)))))
    )  # fmt: skip
    return replace(made, shape="tensor", size=np.zeros(0), inertia=factor * own, turn=turn)


def test_sds_are_those_of_drawn_parts():
    """600 draws: 16 sd within 12 %, and mass and inertia correlated as stated."""
    found = mass_budget(parts_list(*some_parts()))
    rng = np.random.default_rng(2)
    runs = [
        mass_budget(parts_list(*[drawn(each, rng) for each in some_parts()])) for _ in range(600)
    ]
    all_values = np.array([np.concatenate([values(run), central(run)]) for run in runs])
    stated = [p.sd for p in (*found.estimate.parameters, *found.central)]
    np.testing.assert_allclose(all_values.std(axis=0), stated, rtol=0.12)
    near = np.corrcoef(all_values[:, :10].T)
    sd = np.sqrt(np.diag(found.estimate.covariance))
    np.testing.assert_allclose(near, found.estimate.covariance / np.outer(sd, sd), atol=0.15)
    assert abs(near[0, 6]) > 0.1  # mass and J_zz: by the masses that both have


def test_shares_say_which_part_to_weigh_and_measure():
    """Of two equal points, one twice as doubtful in place: four fifths of the variance."""
    near = part("point", 1.0, (), (0.1, 0.0, 0.0), centre_sd=1e-3, name="near")
    vague = replace(near, name="vague", centre=-near.centre, centre_sd=2e-3)
    other = part("box", 1.0, (0.1, 0.1, 0.1), name="weighed badly", mass_sd=0.01)
    found = mass_budget(parts_list(near, vague, other))
    by_name = {share.name: share for share in found.shares}
    assert found.shares[0].name == "vague"
    assert by_name["vague"].of_com == pytest.approx(0.8, abs=1e-9)
    assert by_name["weighed badly"].of_mass == 1.0
    for group in ("of_mass", "of_com", "of_inertia"):
        assert sum(getattr(share, group) for share in found.shares) == pytest.approx(1.0)


def test_names_are_of_one_order():
    found = mass_budget(parts_list(*some_parts()))
    assert [p.name for p in found.estimate.parameters[4:]] == list(INERTIA)
    assert [p.name for p in found.central] == list(CENTRAL)
    sizes = element_sizes(found.body.inertia_P)
    assert all(p.sd < 0.2 * size for p, size in zip(found.central, sizes, strict=True))
