"""held.json is written and read whole, and what is no such file is named with its place."""

import json
from dataclasses import asdict, replace

import pytest

from equipoise.io.documents.held_file import (
    FILE,
    PARAMETERS,
    SAG,
    TERMS,
    HeldFile,
    HeldSag,
    read_held,
    write_held,
)
from equipoise.model.errors import InputError

HELD = HeldFile(
    "bench", 1.7e9, 60.0, [0.0, 0.0, -1e-4], [3e-6] * 3, [1e-6, -2e-6, -1e-4],
    [0.04, 0.04, 0.03, 0.0, 1e-4, 0.0], [1e-8, 0.0, -1e-9], [0.0, 1e-6, 0.0],
    [[float(i == j) for i in range(PARAMETERS)] for j in range(PARAMETERS)], [0.0] * TERMS,
    {"x": 1e-3, "y": -2e-3},
)  # fmt: skip


def test_it_comes_back_to_the_last_digit(tmp_path):
    write_held(HELD, tmp_path)
    write_held(replace(HELD, left_s=1 / 3), tmp_path)
    assert read_held(tmp_path) == replace(HELD, left_s=1 / 3)


def test_what_is_known_of_a_sag_comes_back_too(tmp_path):
    sag = HeldSag([1e-6, 0.0, -2e-6, 1 / 3, 0.0], [[1 / 7] * (PARAMETERS + SAG)] * SAG)
    write_held(replace(HELD, sag=sag), tmp_path)
    assert read_held(tmp_path) == replace(HELD, sag=sag)


@pytest.mark.parametrize(
    ("change", "where"),
    [
        ({"left_s": -1.0}, "left_s"),
        ({"com_m": [0.0, 0.0]}, "com_m"),
        ({"covariance": [[0.0]]}, "covariance"),
        ({"displacement_m": {"x": "far"}}, "displacement_m: x"),
        ({"drift_m_s": [0.0, 0.0, 1e999]}, "drift_m_s: 2"),
        ({"sag": {"coefficients_m": [0.0] * 5, "covariance": [[0.0]]}}, "sag: covariance"),
        ({"more": 1}, "more"),
        ({"schema": "equipoise/held/9"}, "schema"),
    ],
)
def test_what_does_not_fit_is_named(tmp_path, change, where):
    text = json.dumps(asdict(HELD) | change).replace("Infinity", "1e999")
    (tmp_path / FILE).write_text(text)
    with pytest.raises(InputError) as refused:
        read_held(tmp_path)
    assert f"{FILE}: {where}" in str(refused.value)


def test_a_folder_without_it_says_so(tmp_path):
    with pytest.raises(InputError, match=r"the folder of a keep, with held\.json"):
        read_held(tmp_path)
