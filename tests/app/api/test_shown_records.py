"""Records show themselves in few lines, as tables, as documents, in pandas and xarray, drawn."""

import json
import sys
from html.parser import HTMLParser

import numpy as np
import pytest
from matplotlib.figure import Figure

from equipoise.app.figures.estimate.inertia_ellipsoid import semi_axes
from equipoise.app.presentation import presenter
from equipoise.app.runs.comparison import Compared
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties
from equipoise.model.presentation import Plotted, Shown
from equipoise.model.recording import Recording, Samples
from tests.support.synthetic_runs import comparison, made_up

MOST_LINES = 12
WIDEST = 1000  # letters of a line; the longest holds one sentence
KINDS = ("Recording", "Testbed", "MassProperties", "Estimate", "identify", "assess", "observe",
         "design", "balance", "plan", "compare", "methods", "laws",
         "identify several", "inertia", "ledger", "keep")  # fmt: skip
DRAWN = ("Recording", "MassProperties", "Estimate", "identify", "assess", "design", "balance",
         "identify several", "inertia", "ledger")  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_a_record_prints_in_a_few_lines(kind, returned):
    lines = repr(returned.results[kind]).splitlines()
    assert 1 <= len(lines) <= MOST_LINES
    assert max(map(len, lines)) <= WIDEST


def test_every_kind_of_record_that_is_shown_is_listed(returned):
    shown = {type(returned.results[kind]).__name__ for kind in KINDS}
    assert shown == set(presenter.KINDS)


class Tags(HTMLParser):
    """Counts tables; a tag that is not closed stays open."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tables = 0

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        self.tables += tag == "table"

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.mark.parametrize("kind", KINDS)
def test_a_record_is_tables_in_a_notebook(kind, returned):
    tags = Tags()
    tags.feed(returned.results[kind]._repr_html_())
    assert tags.open == []
    assert tags.tables >= 1


def test_a_result_of_a_cell_brings_its_style_and_touches_nothing_else(returned):
    cell = returned.results["Estimate"]._repr_html_()
    style = cell.split("<style>")[1].split("</style>")[0].split("*/")[1]
    selectors = [rule.split("{")[0] for rule in style.split("}") if rule.strip()]
    assert len(selectors) > 10
    assert all(s.strip().startswith(".equipoise") for each in selectors for s in each.split(","))
    assert [word for word in ("url(", "@import", "http", "<script") if word in cell] == []
    assert 'class="verdict' in cell


def test_a_figure_is_the_result_of_a_cell(returned):
    """No figure here belongs to pyplot, so IPython would print its name alone."""
    figure = returned.results["Estimate"].plot()
    assert figure._repr_png_().startswith(b"\x89PNG")


@pytest.mark.parametrize("kind", KINDS)
def test_a_document_is_json_with_its_schema(kind, returned):
    document = returned.results[kind].to_dict()
    assert document["schema"].startswith("equipoise/")
    json.dumps(document, allow_nan=False)


@pytest.mark.parametrize("kind", KINDS)
def test_a_table_has_columns_of_one_length(kind, returned):
    record = returned.results[kind]
    table = presenter.table(record)
    assert len({len(column) for column in table.values()}) == 1


@pytest.mark.parametrize("kind", KINDS)
def test_pandas_takes_the_table(kind, returned):
    pytest.importorskip("pandas", reason="pandas is not pinned yet: make pins")
    record = returned.results[kind]
    frame = record.to_pandas()
    table = presenter.table(record)
    assert [frame.index.name, *frame.columns] == list(table)
    assert len(frame) == len(table[frame.index.name])


@pytest.mark.parametrize("kind", KINDS)
def test_xarray_takes_the_arrays(kind, returned):
    pytest.importorskip("xarray", reason="xarray is not pinned yet: make pins")
    record = returned.results[kind]
    arrays = presenter.arrays(record)
    dataset = record.to_xarray()
    for name, variable in arrays.variables.items():
        assert dataset[name].dims == variable.dims
        assert dataset[name].attrs.get("units", "") == variable.unit


@pytest.mark.parametrize("kind", KINDS)
def test_arrays_fit_their_dimensions(kind, returned):
    record = returned.results[kind]
    arrays = presenter.arrays(record)
    sizes = {name: len(of.values) for name, of in arrays.coordinates.items()}
    for variable in arrays.variables.values():
        assert np.shape(variable.values) == tuple(sizes[dim] for dim in variable.dims)


@pytest.mark.parametrize(("method", "library"), [("to_pandas", "pandas"), ("to_xarray", "xarray")])
def test_a_missing_library_names_its_extra(method, library, returned, monkeypatch):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(InputError, match=rf"{library} is not installed.*equipoise\[analysis\]"):
        getattr(returned.results["Recording"], method)()


@pytest.mark.parametrize("kind", DRAWN)
def test_a_record_is_drawn(kind, returned):
    record = returned.results[kind]
    assert isinstance(record, Plotted)
    figure = record.plot()
    assert isinstance(figure, Figure)
    assert figure.get_axes()


def test_a_comparison_is_drawn_once_a_method_states_something():
    """Made-up runs of one method; those of a method that states nothing show nothing."""
    bed = read_preset("sputnix")
    runs = [made_up(seed=seed) for seed in range(3)]
    assert Compared(bed, {}, comparison(runs), None).plot().get_axes()
    refused = [made_up(ending="refused", sentence="No gyro.")]
    with pytest.raises(InputError, match="no data that a figure could show"):
        Compared(bed, {}, comparison(refused), None).plot()


def test_what_has_no_figure_has_no_plot(returned):
    for kind in set(KINDS) - {*DRAWN, "compare"}:
        assert isinstance(returned.results[kind], Shown)
        assert not hasattr(returned.results[kind], "plot")


def test_a_recording_without_rows_shows_itself_and_is_not_drawn():
    empty = Recording(source="none.csv")
    assert repr(empty) == "Recording of none.csv: no sensor rows"
    assert empty.to_dict()["channels"] == {}
    with pytest.raises(InputError, match="a record with rows"):
        empty.plot()


def test_channels_of_different_times_share_a_table():
    """Gyro rows at 0 and 1 s, a mass row at 0.5 s: three rows, and nan where there is none."""
    gyro = Samples(np.array([0.0, 1.0]), np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]))
    mass = Samples(np.array([0.5]), np.array([[0.01]]))
    recording = Recording(rate=gyro, mass_names=("x1",), masses=mass)
    columns = presenter.table(recording)
    np.testing.assert_array_equal(columns["time_s"], [0.0, 0.5, 1.0])
    np.testing.assert_array_equal(columns["rate_x_rad_s"], [1.0, np.nan, 4.0])
    np.testing.assert_array_equal(columns["masses_x1_m"], [np.nan, 0.01, np.nan])


def test_a_devices_column_has_the_unit_of_its_kind():
    rows = Samples(np.array([0.0, 1.0]), np.ones((2, 2)))
    recording = Recording(device_names=("wheel:x", "dipole:y"), devices=rows)
    columns = presenter.table(recording)
    assert list(columns) == ["time_s", "wheel:x_rad_s", "dipole:y_A_m2"]


def test_the_ellipsoid_of_a_ball_is_that_ball():
    """A ball of 2 kg and 0.3 m: J = 2/5 m a^2 about its centre, here 0.072 kg m^2."""
    ball = MassProperties(2.0, np.zeros(3), 0.4 * 2.0 * 0.3**2 * np.eye(3))
    lengths, _ = semi_axes(ball)
    np.testing.assert_allclose(lengths, 0.3, rtol=1e-12)


def test_the_ellipsoid_lies_along_its_principal_axes():
    """Semi-axes 1, 2 and 3 m along x, y and z, 5 kg: J_xx = m (b^2 + c^2) / 5 = 13 kg m^2."""
    body = MassProperties(5.0, np.zeros(3), np.diag([4.0 + 9.0, 1.0 + 9.0, 1.0 + 4.0]))
    lengths, directions = semi_axes(body)
    np.testing.assert_allclose(lengths, [1.0, 2.0, 3.0], rtol=1e-12)
    np.testing.assert_allclose(np.abs(directions), np.eye(3), atol=1e-12)
