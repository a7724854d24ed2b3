"""The camera: geometry by hand, errors on drawn pictures, streams, settings, calibration."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

cv2 = pytest.importorskip("cv2", reason="the extra 'camera' is not installed")

from equipoise.hardware.camera import aruco  # noqa: E402
from equipoise.hardware.camera.board_errors import BoardErrors  # noqa: E402
from equipoise.hardware.camera.calibration import lens_from  # noqa: E402
from equipoise.hardware.camera.eye import (  # noqa: E402
    camera_to_laboratory,
    eye_of,
    lens_of,
    level_up,
    settings_of_lens,
)
from equipoise.hardware.camera.layouts import grid  # noqa: E402
from equipoise.hardware.camera.lens import Lens  # noqa: E402
from equipoise.hardware.camera.pose import Pose, chosen  # noqa: E402
from equipoise.hardware.camera.sight import Sight  # noqa: E402
from equipoise.hardware.emulated.camera import EmulatedCamera, renderer_of  # noqa: E402
from equipoise.hardware.emulated.print_texture import Sheet  # noqa: E402
from equipoise.hardware.emulated.rendering import Appearance, Renderer, project  # noqa: E402
from equipoise.hardware.links.frame_transform import placed  # noqa: E402
from equipoise.hardware.sensors.camera import Camera  # noqa: E402
from equipoise.hardware.transport.mjpeg_stream import Chunks, Parts  # noqa: E402
from equipoise.maths.attitude import (  # noqa: E402
    difference,
    exponential,
    from_euler321,
    from_matrix,
    to_matrix,
)
from equipoise.model.errors import InputError  # noqa: E402
from equipoise.model.hardware import Port, SensorUnit  # noqa: E402
from equipoise.model.reasons.picture_reasons import Unseen  # noqa: E402
from equipoise.model.recording import Recording, Samples  # noqa: E402
from equipoise.model.units import DEG  # noqa: E402
from tests.support import thorough  # noqa: E402
from verification import camera as check  # noqa: E402

SETTINGS = {
    "columns": 6.0,
    "rows": 5.0,
    "marker_mm": 40.0,
    "gap_mm": 10.0,
    "width_px": 1280.0,
    "height_px": 960.0,
    "fx_px": 1200.0,
    "fy_px": 1200.0,
    "cx_px": 639.5,
    "cy_px": 479.5,
    "k1": -0.1,
}
DOWN = np.diag([1.0, -1.0, -1.0])  # a board face up below a camera that points down


def unit(address="http://127.0.0.1:81/stream", alignment=None, **more):
    turn = np.eye(3) if alignment is None else alignment
    return SensorUnit("eye", "camera", Port(address), ("attitude",), turn, settings=SETTINGS | more)


def turned(x, y, z):
    return to_matrix(exponential(DEG * np.array([x, y, z], float)))


def stream(device, attitudes, rate=5.0):
    """Return what the emulated camera sends from the request on."""
    camera = EmulatedCamera(device)
    hello = camera.take(b"GET /stream HTTP/1.1\r\nHost: x\r\n\r\n", 0.0)
    t = np.arange(len(attitudes)) / rate
    return hello, camera.messages(Recording(Samples(t, np.array(attitudes))))


# --- Geometry --------------------------------------------------------------------------------


def test_a_lens_by_hand():
    """x = 0.2, y = 0.1: r^2 = 0.05, c = 1 - 0.1 x 0.05 + 0.4 x 0.0025 = 0.996.

    x' = 0.1992 + 2 x 0.01 x 0.02 + 0.02 x (0.05 + 0.08) = 0.2022,
    y' = 0.0996 + 0.01 x (0.05 + 0.02) + 2 x 0.02 x 0.02 = 0.1011.
    """
    lens = Lens(1000, 2000, 600, 400, 1280, 960, (-0.1, 0.4, 0.01, 0.02, 0.0))
    observed = project(np.array([[0.4, 0.2, 2.0]]), lens)
    np.testing.assert_allclose(observed, [[802.2, 602.2]], atol=1e-9)
    theirs = cv2.projectPoints(
        np.array([[0.4, 0.2, 2.0]]), np.zeros(3), np.zeros(3), lens.matrix, lens.coefficients
    )[0]
    np.testing.assert_allclose(theirs.reshape(1, 2), observed, atol=1e-9)


def test_which_way_is_up_by_hand():
    """Down: our y is the picture's up. Level, sight along y: the picture's up is our z."""
    np.testing.assert_allclose(camera_to_laboratory(np.array([0.0, 0, -1])), DOWN, atol=1e-12)
    level = camera_to_laboratory(np.array([0.0, -1, 0]))
    np.testing.assert_allclose(level, [[1, 0, 0], [0, 0, 1], [0, -1, 0]], atol=1e-12)
    for up in ([0.6, 0.0, -0.8], [1.0, 0.0, 0.0], [0.0, 0.6, -0.8]):
        turn = camera_to_laboratory(np.array(up))
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
        np.testing.assert_allclose(turn @ up, [0, 0, 1], atol=1e-12)
        assert np.linalg.det(turn) > 0


def test_up_is_found_from_a_level_board_whatever_its_heading():
    camera = camera_to_laboratory(np.array([0.28, 0.0, -0.96]))
    turns = np.array([camera.T @ turned(0, 0, heading) for heading in (0, 70, 200)])
    np.testing.assert_allclose(level_up(turns), [0.28, 0.0, -0.96], atol=1e-12)


# --- Attitudes from pictures -----------------------------------------------------------------


@pytest.mark.parametrize("angles", [(0, 0, 0), (12, 0, 0), (0, 12, 0), (0, 0, 75), (-8, 20, -130)])
def test_what_is_drawn_is_read_back_with_its_signs(angles):
    """A lean of 12 deg about X lifts the board's upper edge, +Y, towards the camera above it."""
    device = unit()
    q = from_euler321(*(DEG * np.array(angles, float)))
    hello, pictures = stream(device, [q])
    (reading,) = Camera(device).feed(hello + b"".join(pictures))
    off = difference(np.array(reading.values), q)
    assert np.linalg.norm(off) < 0.03 * DEG
    assert reading.stamp == 0.0
    if angles == (12, 0, 0):
        corners = project(
            np.array([[-0.1, 0.1, 0], [0.1, 0.1, 0], [-0.1, -0.1, 0], [0.1, -0.1, 0]])
            @ (DOWN @ to_matrix(q)).T
            + [0, 0, 0.7],
            eye_of(device.settings, "t").lens,
        )
        assert corners[1, 0] - corners[0, 0] > corners[3, 0] - corners[2, 0]


def test_alignment_and_the_cameras_lean_are_undone():
    """The board stands at right angles on the body, the camera 20 deg off: the body's attitude."""
    up = {"up_x": math.sin(0.3), "up_y": 0.0, "up_z": -math.cos(0.3)}
    device = unit(alignment=turned(0, 0, 90) @ turned(4, 0, 0), **up)
    q = from_euler321(0.05, -0.1, 0.4)
    hello, pictures = stream(device, [q])
    (reading,) = Camera(device).feed(hello + b"".join(pictures))
    body = placed(device, "attitude", np.array(reading.values))
    assert np.linalg.norm(difference(body, q)) < 0.03 * DEG


def test_errors_are_small_and_as_stated():
    """60 pictures, up to 30 deg of lean, sharp, blurred, smeared, noisy, covered.

    The median is wanted below 0.05 deg; found is some 0.006. Of e^T C^-1 e, 3 on average, the mean
    of 60 is 3 within 0.1 x 3 (one sd); bounds of 30 % leave room for a floor and for JPEG.
    """
    found = [check.observed(measurement, 12, 5) for measurement in check.MEASUREMENTS.values()]
    errors = np.concatenate([each.errors for each in found])
    nees = np.concatenate([each.nees for each in found])
    assert len(errors) >= 59
    assert np.median(errors) < check.MEDIAN
    assert errors.max() < 3 * check.MEDIAN
    assert check.NEES[0] < nees.mean() / 3 < check.NEES[1]


def test_less_ink_turns_nothing():
    """A print whose markers are 0.4 mm too small on each side: the attitude stays."""
    eye = eye_of(unit().settings, "t")
    fat = grid("4X4_50", (6, 5), 0.0408, 0.0092)  # what the settings say; the print has 40
    turn = DOWN @ turned(15, -10, 30)
    picture = renderer_of(eye, Appearance()).picture(turn, np.array([0.02, 0.01, 0.7]))
    pose = Sight(fat, eye.lens, "t").observe(picture)
    assert np.linalg.norm(difference(from_matrix(pose.turn), from_matrix(turn))) < 0.03 * DEG
    assert pose.rms < 0.1


def pose_at(turn, rms):
    known = BoardErrors(np.zeros(2), np.eye(2))
    return Pose(turn, np.eye(3), np.zeros((3, 3)), rms, known)


def test_of_two_attitudes_the_better_the_nearer_or_none():
    one, other = DOWN @ turned(10, 0, 0), DOWN @ turned(-10, 0, 0)
    near = [pose_at(one, 0.10), pose_at(other, 0.11)]
    assert chosen([pose_at(one, 0.10), pose_at(other, 0.20)], None).turn is one
    assert chosen(near, None).code is Unseen.AMBIGUOUS
    assert chosen(near, DOWN @ turned(-9, 0, 0)).turn is other
    assert chosen(near, DOWN @ turned(0, 40, 0)).code is Unseen.AMBIGUOUS
    assert chosen([], None).code is Unseen.NO_FIT


def test_a_small_distant_board_never_yields_the_mirrored_pose():
    """Two markers, 30 px high: leans to both sides fit; what is said is right or nothing."""
    lens = Lens(1200, 1200, 319.5, 239.5, 640, 480)
    eye = replace(check.EYE, board=grid("4X4_50", (2, 1), 0.040, 0.010), lens=lens)
    renderer, rng, said = (
        renderer_of(eye, Appearance(noise=4.0, blur=1.0), 3),
        np.random.default_rng(3),
        [],
    )
    for _ in range(40):
        side = rng.uniform(0, 2 * np.pi)
        turn = turned(15 * np.cos(side), 15 * np.sin(side), 0) @ DOWN
        pose = Sight(eye.board, lens, "t").observe(renderer.picture(turn, np.array([0, 0, 1.9])))
        said.append(
            np.linalg.norm(difference(from_matrix(pose.turn), from_matrix(turn))) / DEG
            if isinstance(pose, Pose)
            else pose.code
        )
    angles = [angle for angle in said if not isinstance(angle, Unseen)]
    assert said.count(Unseen.AMBIGUOUS) >= 5
    assert len(angles) >= 10
    assert max(angles) < 8


# --- Streams ---------------------------------------------------------------------------------


def readings_of(driver, data, step):
    return [r for k in range(0, len(data), step) for r in driver.feed(data[k : k + step])]


@pytest.fixture(scope="module")
def sent():
    """Return a stream of three pictures, the board leaning by 5, 10 and 15 deg."""
    hello, pictures = stream(unit(), [from_euler321(DEG * a, 0.0, 0.0) for a in (5, 10, 15)])
    return hello, list(pictures)


def test_it_sends_one_request_and_reads_the_stream_in_chunks_of_any_size(sent):
    driver = Camera(unit())
    driver.opened()
    assert driver.due(0.0) == b"GET /stream HTTP/1.1\r\nHost: 127.0.0.1:81\r\nAccept: */*\r\n\r\n"
    assert driver.due(0.1) == b""
    hello, pictures = sent
    for step in (997, 65536, 10**6):
        driver.opened()
        found = readings_of(driver, hello + b"".join(pictures), step)
        leans = [2 * math.degrees(math.asin(abs(reading.values[1]))) for reading in found]
        assert leans == pytest.approx([5, 10, 15], abs=0.05)
        assert [reading.stamp for reading in found] == [0.0, 0.2, 0.4]
        assert driver.counts.good == 3


def test_chunks_and_parts_without_a_length_are_understood(sent):
    """As ESP32-CAM sends them: HTTP/1.1 in chunks; the end of a part is the next boundary."""
    hello, pictures = sent
    plain = b"".join(pictures)
    chunked = hello.replace(b"HTTP/1.0", b"HTTP/1.1").replace(
        b"\r\n\r\n", b"\r\nTransfer-Encoding: chunked\r\n\r\n"
    ) + b"".join(
        b"%x\r\n%s\r\n" % (len(piece), piece)
        for piece in (plain[k : k + 5000] for k in range(0, len(plain), 5000))
    )
    assert len(readings_of(Camera(unit()), chunked, 1500)) == 3
    bare = hello + plain.replace(b"Content-Length", b"X-Length") + b"--picture\r\n"
    assert len(readings_of(Camera(unit()), bare, 65536)) == 3
    assert Chunks().cut(b"4\r\nWiki\r\n6;x=1\r\npedia \r\n0\r\n\r\n") == b"Wikipedia "  # RFC 9112


def test_what_is_broken_and_what_shows_no_board_is_counted(sent):
    hello, (first, second, third) = sent
    body = first.split(b"\r\n\r\n", 1)[1]
    cut = b"--picture\r\nContent-Length: 5000\r\n\r\n" + body[:5000] + b"\r\n"
    empty = aruco.encoded(np.full((960, 1280), 120, np.uint8), 90)
    other = aruco.encoded(np.full((480, 640), 120, np.uint8), 90)
    driver = Camera(unit())
    driver.feed(hello + cut + second)
    assert (driver.counts.good, driver.counts.corrupt) == (1, 1)
    for picture in (empty, other):
        driver.feed(b"--picture\r\nContent-Length: %d\r\n\r\n" % len(picture) + picture + b"\r\n")
    assert driver.counts.foreign == 2
    driver.feed(b"--picture\r\nContent-Length: 7\r\n\r\nnothing\r\n" + third)
    assert (driver.counts.good, driver.counts.corrupt) == (2, 2)


def test_a_server_that_refuses_gives_no_rows():
    driver = Camera(unit())
    assert driver.feed(b"HTTP/1.1 404 Not Found\r\nContent-Type: text/html\r\n\r\n<html>") == []
    camera = EmulatedCamera(unit())
    assert camera.take(b"POST / HTTP/1.1\r\n\r\n", 0.0).startswith(b"HTTP/1.0 400")
    q = np.array([[1.0, 0.0, 0.0, 0.0]])
    assert camera.messages(Recording(Samples(np.zeros(1), q))) == []


@given(st.binary(max_size=400), st.integers(0, 1999), st.integers(1, 300))
@settings(max_examples=thorough.count(150, 50))
def test_no_bytes_raise(garbage, at, step):
    """Before the answer's head, within it, and within a part."""
    hello = b"HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary=b\r\n\r\n"
    data = hello + b"--b\r\nContent-Length: 9\r\n\r\n\xff\xd8 jpeg\xff\xd9\r\n" * 3
    spoilt = data[: at % len(data)] + garbage + data[at % len(data) :]
    driver = Camera(unit())
    readings_of(driver, spoilt, step)
    assert driver.counts.good == 0
    assert Camera(unit("camera:0")).feed(garbage) == []


def test_a_part_that_never_ends_is_given_up():
    parts = Parts()
    parts.cut(b"HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary=b\r\n\r\n")
    assert parts.cut(b"--b\r\nContent-Length: 99999999999\r\n\r\nx") == []
    assert parts.lost == 1
    (part,) = parts.cut(b"\r\n--b\r\nContent-Length: 2\r\n\r\nhi\r\n")
    assert part.body == b"hi"


# --- Settings and calibration ----------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"colums": 6.0}, "columns"),
        ({"columns": 2.5}, "a whole number"),
        ({"columns": "six"}, "a number, at most 1e[+]09"),
        ({"rows": 10**400}, "a number, at most"),
        ({"cx_px": float("nan")}, "a number, at most"),
        ({"columns": 11.0}, "markers 0 to 49"),
        ({"columns": 0.0}, "at least one of each"),
        ({"columns": 1e9, "rows": 1e9}, "markers 0 to 49"),
        ({"marker_mm": 0.0}, "a length greater than zero"),
        ({"dictionary": "4X4_51"}, "4X4_50"),
        ({"fx_px": -1.0}, "numbers above 0"),
        ({"up_z": -0.5}, "length 1"),
    ],
)
def test_settings_are_refused_in_words(change, said):
    with pytest.raises(InputError, match=said):
        Camera(unit(**change))


def test_a_missing_key_is_named():
    with pytest.raises(InputError, match="fx_px"):
        eye_of({key: value for key, value in SETTINGS.items() if key != "fx_px"}, "t")


def charuco_sheet(charuco, scale):
    """Return the chessboard as a sheet whose axes are OpenCV's: origin upper left, Y down."""
    dpi = 300
    paper = aruco.charuco_print(charuco, dpi)
    factor = scale * 0.0254 / dpi
    small = cv2.resize(paper, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)
    exact = small.shape[1] / (paper.shape[1] * 0.0254 / dpi)
    corner = np.array([-charuco.square / 2, charuco.square / 2])
    return Sheet(30 + small.astype(np.float32) * (185 / 255), exact, corner)


@pytest.fixture(scope="module")
def views():
    """Return chessboard corners in 20 drawn pictures through a lens that bends, and the lens."""
    charuco = aruco.Charuco("4X4_50", 8, 6, 0.030, 0.022)
    lens = Lens(820.0, 815.0, 322.0, 236.0, 640, 480, (-0.2, 0.06, 0.001, -0.001, 0.0))
    renderer = Renderer(charuco_sheet(charuco, 820 / 0.3), lens, Appearance(noise=2.0))
    rng, pictures = np.random.default_rng(2), []
    for k in range(20):
        tilt, side = (20 + 15 * (k % 2)) * DEG, rng.uniform(0, 2 * np.pi)
        turn = to_matrix(exponential(tilt * np.array([np.cos(side), np.sin(side), 0]))) @ DOWN
        middle = turn @ np.array([0.12, -0.09, 0])
        place = np.array([0.06 * (k % 5 - 2) / 2, 0.05 * (k // 5 - 1.5) / 1.5, 0.36]) - middle
        pictures.append(renderer.picture(turn, place))
    return list(aruco.chess_views(charuco, pictures)), lens


def test_a_lens_is_found_again(views):
    observed, lens = views
    found = lens_from(observed, (640, 480))
    assert found.lens.rms < 0.3
    assert found.lens.fx == pytest.approx(lens.fx, abs=max(4 * found.focal_sd, 0.5))
    assert found.lens.fy == pytest.approx(lens.fy, abs=max(4 * found.focal_sd, 0.5))
    assert found.lens.cx == pytest.approx(lens.cx, abs=2.0)
    assert found.lens.distortion[0] == pytest.approx(-0.2, abs=0.02)
    again = lens_of(settings_of_lens(found.lens), "t")
    assert again == replace(found.lens, rms=None)


def test_pictures_that_do_not_determine_a_lens_are_refused(views):
    observed, _ = views
    with pytest.raises(InputError, match="the chessboard in 5 of 5 pictures"):
        lens_from(observed[:5], (640, 480))
    with pytest.raises(InputError, match="right and bottom"):
        lens_from(observed, (1280, 960))
    rng = np.random.default_rng(0)
    shaken = [
        replace(view, picture=view.picture + 3 * rng.normal(size=view.picture.shape))
        for view in observed
    ]
    with pytest.raises(InputError, match="px off on average"):
        lens_from(shaken, (640, 480))
    with pytest.raises(InputError, match="clearly tilted in 0 of 12 pictures"):
        lens_from([tilted_view(k, 1.0, rng) for k in range(12)], (640, 480))
    with pytest.raises(InputError, match="with an sd of"):
        lens_from([tilted_view(k, 9.0, rng) for k in range(12)], (640, 480))


def test_markers_without_corners_are_reported_with_what_to_try(views):
    """The chessboard was drawn by OpenCV's present pattern: sought in the other, it has no corner.

    With odd rows both patterns are one (cv::aruco::CharucoBoard).
    """
    observed, _ = views
    bare = [replace(v, board=np.empty((0, 3)), picture=np.empty((0, 2))) for v in observed]
    with pytest.raises(InputError, match="in 20 up to 24 markers found and no corner") as caught:
        lens_from(bare, (640, 480))
    assert "--legacy" in str(caught.value)
    none = [replace(view, markers=0) for view in bare]
    with pytest.raises(InputError, match="no marker in any"):
        lens_from(none, (640, 480))


@pytest.mark.parametrize(
    ("rows", "legacy", "corners"), [(6, True, 35), (6, False, 0), (5, True, 28)]
)
def test_a_chessboard_in_the_legacy_pattern_has_to_be_declared(rows, legacy, corners):
    """Drawn by OpenCV itself, in the pattern of releases before 4.6."""
    markers = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    board = cv2.aruco.CharucoBoard((8, rows), 0.030, 0.022, markers)
    board.setLegacyPattern(True)
    picture = cv2.GaussianBlur(board.generateImage((960, 720), marginSize=40), (0, 0), 1.0)
    charuco = aruco.Charuco("4X4_50", 8, rows, 0.030, 0.022, legacy)
    (view,) = aruco.chess_views(charuco, [picture])
    assert (len(view.picture), view.markers) == (corners, 4 * rows)
    printed = cv2.GaussianBlur(aruco.charuco_print(charuco, 100), (0, 0), 1.0)
    (own,) = aruco.chess_views(charuco, [printed])
    assert len(own.picture) == 7 * (rows - 1)


def tilted_view(k, tilt, rng):
    """Return a view in which the board leans by so much, deg; face on it would fit any lens."""
    board = np.array([[0.03 * i, 0.03 * j, 0] for i in range(-4, 5) for j in range(-3, 4)])
    place = np.array([0.03 * (k % 4 - 1.5), 0.03 * (k // 4 - 1), 0.33])
    turn = turned(tilt * np.cos(k), tilt * np.sin(k), 0) @ turned(0, 0, 5 * k)
    exact = project(board @ turn.T + place, Lens(820, 820, 319.5, 239.5, 640, 480))
    observed = np.all((exact > 0) & (exact < [640, 480]), axis=1)
    found = exact[observed] + 0.3 * rng.normal(size=(np.count_nonzero(observed), 2))
    return aruco.ChessView(board[observed], found, 24)
