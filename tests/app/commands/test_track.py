"""`track`, `print-board` and `calibrate-camera`: from pictures and videos to files."""

import math
import threading
import time
import tomllib

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2", reason="the extra 'camera' is not installed")

from equipoise.hardware.camera.eye import eye_of  # noqa: E402
from equipoise.hardware.emulated.camera import EmulatedCamera, renderer_of  # noqa: E402
from equipoise.hardware.emulated.counterpart import TcpCounterpart  # noqa: E402
from equipoise.hardware.emulated.rendering import Appearance  # noqa: E402
from equipoise.io.documents.camera_file import read_camera_keys  # noqa: E402
from equipoise.io.recording.recording_file import read_recording  # noqa: E402
from equipoise.io.testbed.presets import preset_text, read_preset  # noqa: E402
from equipoise.io.testbed.testbed_file import read_testbed  # noqa: E402
from equipoise.maths.attitude import difference, from_euler321, to_matrix  # noqa: E402
from equipoise.model.recording import Recording, Samples  # noqa: E402
from equipoise.model.units import DEG  # noqa: E402

BED = read_preset("sputnix")
UNIT = next(unit for unit in BED.hardware.sensors if unit.driver == "camera")
EYE = eye_of(UNIT.settings, "preset")
RATE = 10.0


def swing(count):
    """Return a swing about x of 6 deg while the platform turns about the vertical."""
    t = np.arange(count) / RATE
    return from_euler321(6 * DEG * np.sin(3 * t), 0.0, 0.5 * t)


def drawn(attitudes):
    renderer = renderer_of(EYE, Appearance())
    turns = EYE.to_laboratory.T @ to_matrix(attitudes)
    return [renderer.picture(turn, np.array([0.0, 0.0, 0.7])) for turn in turns]


@pytest.fixture(scope="module")
def pictures():
    """Return twelve pictures, the board not in view in one of them."""
    found = drawn(swing(12))
    found[5] = np.full_like(found[5], 90)
    return found


def observed_rightly(path, missing=5, count=12):
    recording = read_recording(path)
    rows = [k for k in range(count) if k != missing]
    np.testing.assert_allclose(recording.attitude.t, np.array(rows) / RATE, atol=1e-6)
    off = difference(recording.attitude.values, swing(count)[rows])
    assert np.degrees(np.abs(off)).max() < 0.05


def test_a_video_becomes_a_recording(equipoise, tmp_path, pictures):
    writer = cv2.VideoWriter("run.avi", cv2.VideoWriter.fourcc(*"MJPG"), RATE, (1280, 960))
    for picture in pictures:
        writer.write(cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR))
    writer.release()
    done = equipoise("track", "run.avi", "--testbed", "sputnix", "--out", "run.csv")
    assert done.code == 0, done.err
    assert "found in 11 of 12 pictures" in done.out
    assert "~ 1 pictures: no marker found, 2 wanted" in done.out
    assert "deg per axis" in done.out
    assert "common to all pictures" in done.out
    observed_rightly(tmp_path / "run.csv")


def test_a_folder_with_a_board_and_a_lens(equipoise, tmp_path, pictures):
    folder = tmp_path / "pictures"
    folder.mkdir()
    for k, picture in enumerate(pictures):
        cv2.imwrite(str(folder / f"{k:03d}.png"), picture)
    printed = equipoise("print-board", "--out", "board.pdf", "--keys", "board.toml")
    assert printed.code == 0, printed.err
    assert "290 x 240 mm" in printed.out
    keys = ("width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2")
    lens = "\n".join(f"{key} = {UNIT.settings[key]}" for key in keys)
    (tmp_path / "lens.toml").write_text(lens.replace("1280.0", "1280").replace("960.0", "960"))
    words = ("track", folder, "--board", "board.toml", "--lens", "lens.toml", "--out", "run.csv")
    done = equipoise(*words, "--rate-hz", RATE)
    assert done.code == 0, done.err
    observed_rightly(tmp_path / "run.csv")
    without = equipoise(*words)
    assert without.code == 2
    assert "--rate-hz" in without.err


def test_a_board_of_measured_tags_and_an_aprilgrid_are_declared_in_a_file(equipoise, tmp_path):
    """Both keys' files say the board that is drawn; `print-board` writes the AprilGrid's."""
    done = equipoise(
        "print-board", "--out", "a.pdf", "--keys", "april.toml", "--columns", 4, "--rows", 3,
        "--marker-mm", 50, "--spacing", 0.3,
    )  # fmt: skip
    assert done.code == 0, done.err
    assert "245 x 180 mm" in done.out
    (tmp_path / "tags.toml").write_text(
        'layout = "tags"\nplace_sd_mm = 0.3\n'
        "[[tag]]\nid = 3\nx_mm = -80\ny_mm = 0\nmarker_mm = 50\nrotation_deg = 17.0\n"
        "[[tag]]\nid = 9\nx_mm = 70\ny_mm = 20.5\nmarker_mm = 60\n"
    )
    keys = ("width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2")
    lens = "\n".join(f"{key} = {UNIT.settings[key]}" for key in keys)
    (tmp_path / "lens.toml").write_text(lens.replace("1280.0", "1280").replace("960.0", "960"))
    for name in ("april", "tags"):
        settings = read_camera_keys(tmp_path / f"{name}.toml") | {k: UNIT.settings[k] for k in keys}
        renderer = renderer_of(eye_of(settings, "t"), Appearance())
        (tmp_path / name).mkdir()
        turns = EYE.to_laboratory.T @ to_matrix(swing(3))
        for k, turn in enumerate(turns):
            picture = renderer.picture(turn, np.array([0.0, 0.0, 0.7]))
            cv2.imwrite(str(tmp_path / name / f"{k}.png"), picture)
        words = ("--board", f"{name}.toml", "--lens", "lens.toml", "--rate-hz", RATE)
        done = equipoise("track", tmp_path / name, *words, "--out", f"{name}.csv")
        assert done.code == 0, done.err
        recording = read_recording(tmp_path / f"{name}.csv")
        off = difference(recording.attitude.values, swing(3))
        assert np.degrees(np.abs(off)).max() < 1.0


def test_tags_of_a_testbed_file_reach_the_camera(tmp_path):
    """As tables within the sensor's settings; written again they are the same."""
    text = preset_text("sputnix")
    begin = text.index("[hardware.sensor.settings]")
    keys = 'layout = "tags"\nwidth_px = 1280\nheight_px = 960\n' + "".join(
        f"{key} = 600.0\n" for key in ("fx_px", "fy_px", "cx_px", "cy_px")
    )
    tag = "[[hardware.sensor.settings.tag]]\nid = 4\nx_mm = 10.0\ny_mm = 0\nmarker_mm = 80.0\n"
    (tmp_path / "bed.toml").write_text(f"{text[:begin]}[hardware.sensor.settings]\n{keys}{tag}")
    (sensor,) = read_testbed(tmp_path / "bed.toml").hardware.sensors
    (marker,) = eye_of(sensor.settings, "t").board.markers
    assert (marker.number, marker.x, marker.side) == (4, 0.01, 0.08)


def test_a_level_board_determines_the_up_direction(equipoise, tmp_path):
    """The camera leans by 0.1 rad; the board lies level at three headings."""
    lean = to_matrix(from_euler321(0.1, 0.0, 0.0))
    turns = [lean @ EYE.to_laboratory.T @ to_matrix(from_euler321(0, 0, h)) for h in (0, 1, 2.5)]
    folder = tmp_path / "level"
    folder.mkdir()
    renderer = renderer_of(EYE, Appearance())
    for k, turn in enumerate(turns):
        cv2.imwrite(str(folder / f"{k}.png"), renderer.picture(turn, np.array([0.0, 0.0, 0.7])))
    done = equipoise("track", folder, "--testbed", "sputnix", "--level", "--rate-hz", 1)
    assert done.code == 0, done.err
    reported = [line for line in done.out.splitlines() if line.startswith("up_")]
    up = [tomllib.loads("\n".join(reported))[f"up_{axis}"] for axis in "xyz"]
    # Up of the upright camera is -z; a turn by 0.1 about x takes it to (0, sin 0.1, -cos 0.1).
    np.testing.assert_allclose(up, [0.0, math.sin(0.1), -math.cos(0.1)], atol=5e-4)


def test_a_camera_on_the_network_is_watched(equipoise, tmp_path):
    wire, camera, ended = TcpCounterpart("http", "/stream"), EmulatedCamera(UNIT), threading.Event()

    def serve():
        begin, sent = time.monotonic(), 0
        while not ended.is_set():
            if data := wire.receive():
                wire.send(camera.take(data, 0.0))
            if (time.monotonic() - begin) * RATE > sent:
                row = Samples(np.array([sent / RATE]), swing(sent + 1)[-1:])
                for message in camera.messages(Recording(row)):
                    wire.send(message)
                sent += 1
            time.sleep(0.005)

    thread = threading.Thread(target=serve)
    thread.start()
    try:
        words = ("--testbed", "sputnix", "--duration-s", 2, "--out", "run.csv")
        done = equipoise("track", wire.address, *words)
    finally:
        ended.set()
        thread.join()
        wire.close()
    assert done.code == 0, done.err
    recording = read_recording(tmp_path / "run.csv")
    assert len(recording.attitude) >= 5
    q = recording.attitude.values
    assert np.degrees(np.linalg.norm(difference(q[1:], q[:-1]), axis=1)).max() < 10


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nothing.avi", "--testbed", "sputnix", "--out", "a.csv"), "no such file"),
        (
            ("blank", "--testbed", "sputnix", "--rate-hz", 5, "--out", "a.csv"),
            "none of 1 pictures (1: no marker found, 2 wanted)",
        ),
        (("small", "--testbed", "sputnix", "--rate-hz", 5, "--out", "a.csv"), "1280 x 960 px"),
        (("text.avi", "--testbed", "sputnix", "--out", "a.csv"), "no video"),
        (("blank", "--testbed", "nanosat", "--out", "a.csv"), "no camera"),
        (("blank", "--rate-hz", 5, "--out", "a.csv"), "no key 'columns'"),
        (("blank", "--testbed", "sputnix"), "--level"),
    ],
)
def test_input_that_cannot_be_tracked_is_reported(equipoise, tmp_path, words, said):
    for name, shape in (("blank", (960, 1280)), ("small", (48, 64))):
        (tmp_path / name).mkdir()
        cv2.imwrite(str(tmp_path / name / "0.png"), np.full(shape, 90, np.uint8))
    (tmp_path / "text.avi").write_text("no video")
    done = equipoise("track", *words)
    assert done.code == 2
    assert said in done.err


def test_a_lens_is_calibrated_from_the_printed_chessboard(equipoise, tmp_path):
    """The chessboard as `print-board` writes it, drawn flat by a plain lens at many angles."""
    words = ("--columns", 7, "--rows", 5, "--square-mm", 20, "--marker-mm", 15)
    assert equipoise("print-board", "--out", "chess.png", *words).code == 0
    paper = cv2.imread("chess.png", cv2.IMREAD_GRAYSCALE)
    dot = 0.0254 / 600
    middle = np.array(paper.shape[::-1]) / 2
    flat = np.array([[dot, 0, -dot * middle[0]], [0, dot, -dot * middle[1]], [0, 0, 1]])
    lens = np.array([[700.0, 0, 320.0], [0, 705.0, 240.0], [0, 0, 1]])
    paper = cv2.GaussianBlur(paper, (0, 0), 3)
    for k in range(16):
        side, tilt = 2.4 * k, (15 + 20 * (k % 2)) * DEG
        turn = cv2.Rodrigues(tilt * np.array([np.cos(side), np.sin(side), 0]))[0]
        place = [0.025 * (k % 4 - 1.5), 0.02 * (k // 4 - 1.5), 0.19]
        sight = lens @ np.column_stack([turn[:, :2], place]) @ flat
        picture = cv2.warpPerspective(paper, sight, (640, 480), borderValue=128)
        cv2.imwrite(f"view{k:02d}.png", picture)
    views = sorted(tmp_path.glob("view*.png"))
    done = equipoise("calibrate-camera", *views, "--out", "lens.toml", *words)
    assert done.code == 0, done.err
    keys = tomllib.loads((tmp_path / "lens.toml").read_text())
    assert keys["fx_px"] == pytest.approx(700, rel=0.01)
    assert keys["fy_px"] == pytest.approx(705, rel=0.01)
    assert (keys["width_px"], keys["height_px"]) == (640, 480)
    assert "16 pictures used" in done.out
    few = equipoise("calibrate-camera", *views[:4], "--out", "lens.toml", *words)
    assert few.code == 2
    assert "at least 8" in few.err
