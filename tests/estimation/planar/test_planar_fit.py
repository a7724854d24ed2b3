"""A flight over a table, identified: known truths within their sd, and what stays open."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.planar.friction_map import FrictionMap, hat_functions
from equipoise.estimation.method_contract import Options, estimated
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.planar import planar_estimate
from equipoise.estimation.planar.friction_field import friction_field
from equipoise.estimation.planar.planar_fit import settled
from equipoise.estimation.planar.planar_layout import FRICTION_MEAN, LEAN, SLOPE
from equipoise.estimation.planar.planar_problem import sensitivities
from equipoise.estimation.planar.planar_search import PlanarCase, grown
from equipoise.estimation.planar.planar_start import first_point, rubbing
from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, END, INERTIA, Estimate
from equipoise.model.outcome import OutcomeCode
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.table_reasons import TableReason
from equipoise.model.recording import window
from equipoise.model.testbed import SlidingMass
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.simulation.carried_out import record
from tests.oracle import mujoco_bench as oracle
from tests.oracle import planar_bench
from tests.oracle.planar_records import GYRO, flight

SURE = 4.0  # sd, that no sound estimate errs by in a handful of tests


def off(found: Estimate, names: tuple[str, ...], true) -> np.ndarray:
    """Return errors in stated sd."""
    sd = np.sqrt(np.diag(found.covariance_of(names)))
    return np.abs(found.values(names) - np.asarray(true)) / sd


def run(record_, testbed=None, **options) -> Estimate:
    return planar_estimate.run(record_.recording, testbed or record_.testbed, Options(**options))


@pytest.fixture(scope="module")
def made():
    return flight(5, 40.0)


@pytest.fixture(scope="module")
def found(made):
    return run(made)


def test_slope_body_and_friction_are_those_of_mujoco(made, found):
    """Free motion fixes the scale: the inertia comes out to a percent, from 10 % beforehand."""
    assert found.outcome.code in (OutcomeCode.ESTIMATED, OutcomeCode.PART_UNOBSERVABLE)
    assert found.outcome.usable
    platform = made.platform
    assert np.all(off(found, SLOPE, made.floor.slope) < SURE)
    assert np.all(off(found, COM, platform.com) < SURE)
    assert np.all(off(found, INERTIA, pack_symmetric(platform.inertia_P)) < SURE)
    path = made.run.position
    mean = np.mean([made.floor.friction(*place) for place in path[::100]])
    assert off(found, (FRICTION_MEAN,), [mean])[0] < SURE
    moment = found.parameters[found.index("inertia_P_xx")]
    assert moment.sd < 0.03 * moment.value
    assert found.residual is not None
    assert found.residual.reduced_chi_square == pytest.approx(1.0, abs=0.1)


def test_friction_is_unknown_where_the_record_never_went(made, found):
    """A corner far from the path has an infinite sd, and no place in the picture."""
    field = friction_field(made.recording, made.testbed, found)
    assert field is not None
    assert not field.determined.all()
    assert field.determined.any()
    true = np.array([made.floor.friction(*place) for place in field.path])
    assert np.abs(field.along_path - true).max() < 0.05  # N s/m, at the ends of the path
    nodes = [p for p in found.parameters if p.name.startswith("friction_x")]
    assert any(np.isinf(p.sd) and not p.observable for p in nodes)
    assert found.unobservable


def test_without_a_gyro_the_same_is_found(made):
    bare = replace(made.testbed, gyro=None)
    recording = replace(made.recording, rate=None)
    found = planar_estimate.run(recording, bare, Options())
    assert found.outcome.usable
    assert np.all(off(found, SLOPE, made.floor.slope) < SURE)
    assert np.all(off(found, COM, made.platform.com) < SURE)


def test_a_camera_whose_vertical_leans_is_separated_from_the_slope(made):
    """Measured attitudes turned by a small angle about the laboratory's x: gravity leans there."""
    lean = 4e-3  # rad
    turned = oracle.product(oracle.rotation(np.array([lean, 0.0, 0.0])),
                            made.recording.attitude.values)  # fmt: skip
    attitude = replace(made.recording.attitude, values=turned)
    camera = replace(made.testbed.attitude, plumb_sd=5e-3)
    recording = replace(made.recording, attitude=attitude)
    bed = replace(made.testbed, attitude=camera)
    found = planar_estimate.run(recording, bed, Options())
    assert np.all(off(found, SLOPE, made.floor.slope) < SURE)
    assert found.values(LEAN) == pytest.approx([0.0, lean], abs=5e-4)


def test_moved_masses_are_counted_and_com_is_also_given_as_they_stand():
    """MuJoCo with slides: com is that with masses at home, com_end that at the end."""
    made = flight(5, 10.0)
    rng = np.random.default_rng(7)
    moves = (oracle.Ramp(15.0, np.array([0.03, -0.02, 0.01])),)
    run_ = planar_bench.simulate(made.platform, made.floor, 40.0, moves)
    recording = planar_bench.planar_log(run_, rng)
    masses = tuple(
        SlidingMass(s.name, s.mass, s.home, s.axis, (-0.06, 0.06), 0.0, 0.0, 0.0, 0.01)
        for s in made.platform.slides
    )
    found = planar_estimate.run(recording, replace(made.testbed, masses=masses), Options())
    assert found.outcome.usable
    assert np.all(off(found, COM, made.platform.com) < SURE)
    assert np.all(off(found, END, run_.run.com[-1]) < SURE)
    assert np.abs(found.values(END) - found.values(COM)).max() > 1e-5


def test_what_is_held_stays_and_a_prior_of_the_body_counts(made):
    held = run(made, hold=("inertia_P_zz",))
    zz = held.parameters[held.index("inertia_P_zz")]
    assert zz.value == made.testbed.body.inertia_P[2, 2]
    assert zz.sd == 0.0
    free, prior = run(made), run(made, use_prior=True)
    for name in COM:
        known = [each.parameters[each.index(name)].sd for each in (prior, free)]
        assert known[0] < known[1]


def test_doubt_about_masses_widens_inertia_by_as_much(made, found):
    """J goes with the mass that swings: 2 % of both masses are 2 % of it."""
    doubtful = replace(made.testbed, mass_sd=0.02, table=replace(made.testbed.table,
                                                                 sled_mass_sd=0.02))  # fmt: skip
    wider = run(made, doubtful)
    k, j = wider.index("inertia_P_xx"), found.index("inertia_P_xx")
    more = np.sqrt(wider.parameters[k].sd ** 2 - found.parameters[j].sd ** 2)
    assert 0.01 < more / wider.parameters[k].value < 0.04


def test_the_gyros_bias_is_found(made, found):
    bias = found.values(("gyro_bias_x", "gyro_bias_y", "gyro_bias_z"))
    rows = oracle.every(made.run.run, GYRO.rate)
    true = np.mean(made.recording.rate.values - made.run.run.rate[rows], axis=0)
    assert bias == pytest.approx(true, abs=5e-5)


# --- The parts ------------------------------------------------------------------------------------


def test_the_linear_guess_is_near(made):
    case = PlanarCase(made.recording, made.testbed, (), (), False)
    problem = case.problem(3)
    point = first_point(problem, made.recording)
    com = point.values[problem.layout.of(*COM)]
    assert np.linalg.norm(com - made.platform.com) < 0.3 * np.linalg.norm(made.platform.com)
    slope = point.values[problem.layout.of(*SLOPE)]
    assert np.abs(slope - made.floor.slope).max() < 2e-5


def test_friction_along_a_straight_path_is_its_length_times_the_mean():
    """int c dp over a cell in which c grows from 1 to 3 along x: 2 m at a mean of 2."""
    grid = FrictionMap(-1.0, -1.0, 2.0, 2.0, np.array([[1.0, 1.0], [3.0, 3.0]]))
    t = np.linspace(0, 10, 101)
    path = np.column_stack([np.linspace(-1, 1, 101), np.zeros(101)])
    once, twice = rubbing(t, path, grid)
    assert (once @ grid.values.ravel())[-1] == pytest.approx([4.0, 0.0])
    # c = 2 + x: int over t of (2 (x + 1) + (x^2 - 1) / 2) with x = t / 5 - 1
    assert (twice @ grid.values.ravel())[-1, 0] == pytest.approx(20.0 - 10.0 / 3.0, rel=1e-4)


def test_sensitivities_foretell_what_a_step_leaves(made):
    case = PlanarCase(made.recording, made.testbed, (), (), False)
    fit = grown(case, UNLIMITED)
    problem, point = fit.problem, fit.point
    by = sensitivities(problem, point, fit.left)
    step = 1e-4 * problem.size * np.sin(1 + np.arange(problem.layout.size)) * ~problem.prior.held
    from equipoise.estimation.planar.planar_problem import left_of

    ahead = left_of(problem, replace(point, values=point.values + step)).flat
    linear = by @ step
    assert np.linalg.norm(ahead - fit.left.flat - linear) < 0.02 * np.linalg.norm(linear)


def test_hat_functions_of_a_single_node_are_one():
    grid = FrictionMap(0.0, 0.0, 1.0, 1.0, np.ones((1, 1)))
    assert np.all(hat_functions(grid, np.array([[3.0, -2.0]])) == 1.0)


# --- What is refused ------------------------------------------------------------------------------


def test_auto_takes_the_planar_fit_and_others_refuse_a_bearing_that_moves(made):
    *_, last = identify(made.recording, made.testbed, IdentifyOptions())
    assert last.estimate is not None
    assert last.estimate.method == "planar"
    refused = estimated(METHODS["trajectory"], made.recording, made.testbed, Options())
    assert [r.code for r in refused.outcome.reasons] == [TableReason.BEARING_MOVES]
    assert not refused.outcome.usable


def test_without_positions_or_a_table_it_is_a_platform_on_a_fixed_bearing(made):
    placeless = replace(made.recording, position=None)
    for recording, bed in (
        (placeless, made.testbed),
        (made.recording, replace(made.testbed, table=None)),
    ):
        assert not planar_estimate.moves_over_table(recording, bed)
    found = planar_estimate.run(placeless, made.testbed, Options())
    assert [r.code for r in found.outcome.reasons] == [TableReason.NO_POSITION]


def test_a_few_rows_are_too_few(made):
    short = window(made.recording, 0.0, 0.5)
    found = planar_estimate.run(short, made.testbed, Options())
    assert [r.code for r in found.outcome.reasons] == [Why.TOO_FEW_ROWS]


def test_a_push_in_the_middle_is_no_free_motion(made):
    """From 20 s on the sled goes 20 mm/s faster: the model does not explain that."""
    rows = made.recording.position
    pushed = rows.values + np.outer(np.maximum(rows.t - 20.0, 0.0), [0.02, 0.0])
    recording = replace(made.recording, position=replace(rows, values=pushed))
    found = planar_estimate.run(recording, made.testbed, Options())
    assert found.outcome.code in (OutcomeCode.MODEL_REJECTED, OutcomeCode.NOT_CONVERGED)
    assert not found.outcome.usable


def test_a_spent_budget_ends_the_search_and_is_reported(made):
    spent = Budget(lambda: lambda: True)
    found = planar_estimate.run(made.recording, made.testbed, Options(budget=spent))
    assert not found.outcome.usable or found.outcome.warns
    fit = grown(PlanarCase(made.recording, made.testbed, (), (), False), spent)
    assert settled(fit.problem, fit.point, spent).chi_square == fit.chi_square


def test_the_simulated_bench_has_what_its_testbed_says(made):
    """The package's own bench, identified from its testbed with a truth."""
    from equipoise.io.testbed.testbed_file import parse_testbed
    from tests.simulation.planar.test_planar_bench import BED

    bed = parse_testbed(BED, "bed")
    found = planar_estimate.run(record(bed, 40.0, (), 3), bed, Options())
    assert bed.truth is not None
    assert bed.truth.table is not None
    assert np.all(off(found, SLOPE, bed.truth.table.slope) < SURE)
    assert np.all(off(found, COM, bed.truth.com) < SURE)
