"""Exports of Motive, Vicon's programs and QTM, made by hand of a known turn."""

import numpy as np
import pytest

from equipoise.model.errors import InputError
from tests.io.columns.known_turns import TILT, TURN, YAW, T, cells, is_known_turn, read

FRAMES = np.arange(1, 9)
STILL = np.zeros((8, 3))


def test_the_known_turn_is_that_of_a_hand_calculation() -> None:
    """Yaw 30 deg, then 10 deg about the body's x: half angles, multiplied by hand."""
    cos_15, sin_15, cos_5, sin_5 = 0.965926, 0.258819, 0.996195, 0.0871557
    by_hand = [cos_15 * sin_5, sin_15 * sin_5, sin_15 * cos_5, cos_15 * cos_5]  # x, y, z, w
    np.testing.assert_allclose(TURN[0].as_quat(), by_hand, atol=1e-6)
    assert (YAW[0], TILT) == (30.0, 10.0)


# --- Motive ----------------------------------------------------------------------------------


def motive(*bodies: str) -> str:
    """Return an export of Motive; the first body stands still, the last has the known turn."""
    kinds = [*["Rotation"] * 4, *["Position"] * 3]
    head = [
        "Format Version,1.23,Rotation Type,Quaternion",
        ",,Rigid Body" + ",Rigid Body" * (7 * len(bodies) - 1),
        ",," + ",".join(f'"{body}"' for body in bodies for _ in kinds),
        ",," + ",".join(f"AB12{i}" for i, _ in enumerate(bodies) for _ in kinds),
        ",," + ",".join(kinds * len(bodies)),
        "Frame,Time (Seconds)" + ",X,Y,Z,W,X,Y,Z" * len(bodies),
    ]
    still = [np.tile([0.0, 0.0, 0.0, 1.0], (8, 1)), STILL] * (len(bodies) - 1)
    rows = cells(np.arange(8), T, *still, TURN.as_quat(), STILL)
    return "\n".join([*head, *map(",".join, rows)]) + "\n"


def test_of_several_bodies_one_is_named(tmp_path) -> None:
    """Motive's laboratory is Y up: R_Z = (x, -z, y) R_Y."""
    recording = read(tmp_path, motive("Base 1", "Platform"), body="Platform")
    z_from_y = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    only = read(tmp_path, motive("Platform"))
    np.testing.assert_array_equal(recording.attitude.values, only.attitude.values)
    w, x, y, z = recording.attitude.values[0]
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    np.testing.assert_allclose(turn, z_from_y @ TURN[0].as_matrix(), atol=1e-12)
    assert "Other bodies were ignored: Base 1." in recording.notes


BODIES = {
    "none is named": (None, ["2 bodies: Base 1, Platform", "--body NAME"]),
    "misspelt": ("Platfrom", ["no body 'Platfrom'", "'Platform'?"]),
}


@pytest.mark.parametrize(("body", "words"), BODIES.values(), ids=BODIES.keys())
def test_an_open_choice_of_body_is_refused_with_the_names(tmp_path, body, words) -> None:
    """No body is taken because it comes first."""
    with pytest.raises(InputError) as caught:
        read(tmp_path, motive("Base 1", "Platform"), body=body)
    assert all(word in str(caught.value) for word in words)


@pytest.mark.parametrize(
    "header", ["time_s,omega_x_rad_s,omega_y_rad_s,omega_z_rad_s", ",Time (Seconds),X,Y,Z,W"]
)
def test_a_body_is_refused_where_a_table_names_none(tmp_path, header) -> None:
    """An option that would mean nothing is not passed over."""
    rows = ["0,0,0,0,1,1"[: 2 * len(header.split(",")) - 1]] * 4
    with pytest.raises(InputError, match="no body with a name"):
        read(tmp_path, "\n".join([header, *rows]), body="Platform")


# --- Vicon -----------------------------------------------------------------------------------


def vicon(labels: str, units: str, *columns, kind="Objects", bodies=("Platform:Platform",)) -> str:
    """Return a block of an export of Vicon."""
    width = len(labels.split(","))
    head = [
        kind,
        "100",
        ",," + ("," * width).join(bodies) + "," * (width - 1),
        "Frame,Sub Frame" + f",{labels}" * len(bodies),
        "," + f",{units}" * len(bodies),
    ]
    rows = [[str(i), "0", *row] for i, row in zip(FRAMES, cells(*columns), strict=True)]
    return "\n".join([*head, *map(",".join, rows)]) + "\n"


SIX, UNITS = "RX,RY,RZ,TX,TY,TZ", "rad,rad,rad,mm,mm,mm"


def test_a_rotation_vector_of_tracker_is_read(tmp_path) -> None:
    """Frame 1 of 100 a second is at 0.01 s."""
    recording = read(tmp_path, vicon(SIX, UNITS, TURN.as_rotvec(), STILL))
    is_known_turn(recording)
    np.testing.assert_allclose(recording.attitude.t, FRAMES / 100, atol=1e-15)
    assert any("rotation vector" in note for note in recording.notes)


def test_a_segment_of_nexus_in_degrees_is_read_between_other_blocks(tmp_path) -> None:
    """Devices stand above, trajectories below; rows keep their lines."""
    block = vicon(SIX, UNITS.replace("rad", "deg"), TURN.as_rotvec(degrees=True), STILL,
                  kind="Segments", bodies=("Sat:Root",))  # fmt: skip
    above = "Devices\n1000\n,,Plate\nFrame,Sub Frame,Fx\n,,N\n1,0,0.5\n1,1,0.5\n\n"
    below = "\nTrajectories\n100\n,,a\nFrame,Sub Frame,X\n,,mm\n1,0,3\n"
    is_known_turn(read(tmp_path, above + block + below))
    with pytest.raises(InputError, match=r"line 15, column 'Sat:Root/RY \(deg\)'"):
        read(tmp_path, above + _spoilt(block, line=6, cell=3) + below)


def _spoilt(text: str, line: int, cell: int) -> str:
    """Return a table with one cell that is no number; both are counted from 0."""
    lines = text.splitlines()
    row = lines[line].split(",")
    row[cell] = "?"
    lines[line] = ",".join(row)
    return "\n".join(lines) + "\n"


def test_a_quaternion_of_tracker_is_read(tmp_path) -> None:
    """RX, RY, RZ, RW without units; an occluded frame is blank."""
    text = vicon("RX,RY,RZ,RW,TX,TY,TZ", ",,,,mm,mm,mm", TURN.as_quat(), STILL)
    lines = text.splitlines()
    lines[-1] = "8,0" + "," * 7
    recording = read(tmp_path, "\n".join(lines))
    is_known_turn(recording, slice(0, 7))


def test_of_several_subjects_one_is_named(tmp_path) -> None:
    """A prefix of some exports is no part of the name."""
    bodies = ("Global Angle Base:Base", "Global Angle Platform:Platform")
    text = vicon(SIX, UNITS, STILL, STILL, TURN.as_rotvec(), STILL, bodies=bodies)
    is_known_turn(read(tmp_path, text, body="Platform"))
    with pytest.raises(InputError, match=r"2 bodies: Base, Platform; wanted .*--body"):
        read(tmp_path, text)


@pytest.mark.parametrize("separator", [";", "\t"])
def test_other_separators_of_vicon_are_read(tmp_path, separator) -> None:
    """Spreadsheets write them."""
    text = vicon(SIX, UNITS, TURN.as_rotvec(), STILL)
    is_known_turn(read(tmp_path, text.replace(",", separator)))


VICON = {
    "no unit": (("rad", ""), ["column 'Platform/RX'", "rad"]),
    "no rotation": (("RX,RY,RZ", "AX,AY,AZ"), ["known dialect"]),
    "two of three": (("RZ", "AZ"), ["RX RY alone", "RX, RY and RZ"]),
    "no rows": (("\n1,0", "\n\n1,0"), ["ends in its header", "rows of numbers"]),
}


@pytest.mark.parametrize(("change", "words"), VICON.values(), ids=VICON.keys())
def test_a_vicon_table_that_says_too_little_is_refused(tmp_path, change, words) -> None:
    """What lacks is named."""
    with pytest.raises(InputError) as caught:
        read(tmp_path, vicon(SIX, UNITS, TURN.as_rotvec(), STILL).replace(*change))
    assert all(word in str(caught.value) for word in words)


# --- QTM -------------------------------------------------------------------------------------

TITLES = "X\tY\tZ\tRoll\tPitch\tYaw\tResidual\t" + "\t".join(f"Rot[{i}]" for i in range(9))


def qtm(*bodies: str, count=("Frame", "Time"), titles: bool = True) -> str:
    """Return an export of QTM; the first body stands still, the last has the known turn."""
    by_columns = TURN.as_matrix().transpose(0, 2, 1).reshape(8, 9)
    still = [np.zeros((8, 7)), np.tile(np.eye(3).ravel(), (8, 1))] * (len(bodies) - 1)
    counted = {"Frame": FRAMES, "Time": T}
    columns = [*(counted[each] for each in count), *still, np.ones((8, 7)), by_columns]
    head = ["NO_OF_FRAMES\t8", f"NO_OF_BODIES\t{len(bodies)}", "FREQUENCY\t100", "DESCRIPTION\t--",
            "\t".join(["BODY_NAMES", *bodies])]  # fmt: skip
    if titles:
        head.append("\t".join([*count, *(f"{body} {TITLES}" for body in bodies)]) + "\t")
    return "\n".join([*head, *("\t".join(row) + "\t" for row in cells(*columns))]) + "\n"


def test_the_matrix_of_qtm_stands_column_by_column() -> None:
    """A row of a published export: its roll, pitch and yaw make its matrix, read in columns.

    shiplab/dt_cv (GitHub), data/basin/raw/M510A-IRR-EKFPID-020019_6D.tsv, frame 1; five digits.
    """
    roll, pitch, yaw = np.radians([-0.65630, 0.09391, 0.05772])
    rot = [1.0, 0.00099, -0.00165, -0.00101, 0.99993, -0.01145, 0.00164, 0.01145, 0.99993]
    turn = np.reshape(rot, (3, 3)).T
    np.testing.assert_allclose(turn[2, 1], np.sin(roll), atol=2e-5)
    np.testing.assert_allclose(turn[0, 2], np.sin(pitch), atol=2e-5)
    np.testing.assert_allclose(turn[1, 0], np.sin(yaw), atol=2e-5)


@pytest.mark.parametrize("titles", [True, False])
def test_an_export_of_qtm_is_read(tmp_path, titles) -> None:
    """With a line of titles or without."""
    recording = read(tmp_path, qtm("Platform", titles=titles))
    is_known_turn(recording)
    np.testing.assert_allclose(recording.attitude.t, T, atol=1e-15)


@pytest.mark.parametrize(("count", "first"), [(("Frame",), 0.01), ((), 0.0)])
def test_qtm_without_times_is_timed_by_its_frequency(tmp_path, count, first) -> None:
    """Frames count from 1; rows, where there is no frame, from 0."""
    recording = read(tmp_path, qtm("Platform", count=count))
    is_known_turn(recording)
    np.testing.assert_allclose(recording.attitude.t, first + T, atol=1e-15)


def test_rows_of_zeros_are_lost_tracking(tmp_path) -> None:
    """QTM writes zeros for a body that it does not see."""
    lines = qtm("Platform").splitlines()
    for row in (7, 8):
        lines[row] = "\t".join(lines[row].split("\t")[:2] + ["0.0"] * 16) + "\t"
    recording = read(tmp_path, "\n".join(lines))
    is_known_turn(recording, [0, 3, 4, 5, 6, 7])
    assert any("2 rows of zeros alone, first at line 8" in note for note in recording.notes)


def test_of_several_bodies_of_qtm_one_is_named(tmp_path) -> None:
    """Names may have blanks."""
    is_known_turn(read(tmp_path, qtm("Base", "My platform"), body="My platform"))
    with pytest.raises(InputError, match=r"2 bodies: Base, My platform; wanted .*--body"):
        read(tmp_path, qtm("Base", "My platform"))


QTM = {
    "no frequency": (("FREQUENCY", "SPEED"), ["no FREQUENCY"]),
    "no rate": (("FREQUENCY\t100", "FREQUENCY\tfast"), ["line 3", "'fast'", "Hz"]),
    "a further column": (("Frame\t", "Frame\tIndex\t"), ["columns for 1 bodies", "Rot[8]"]),
    "no rotation": (("\t0.0", "\t5.0"), ["no rotation", "unit length"]),
}


@pytest.mark.parametrize(("change", "words"), QTM.values(), ids=QTM.keys())
def test_an_export_of_qtm_that_makes_no_sense_is_refused(tmp_path, change, words) -> None:
    """What is wrong is named."""
    with pytest.raises(InputError) as caught:
        read(tmp_path, qtm("Platform").replace(*change))
    assert all(word in str(caught.value) for word in words)
