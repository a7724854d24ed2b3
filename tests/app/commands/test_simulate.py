"""`simulate` says when a platform met its stop, and so does `inspect` of its record."""

HIGH = """
name = "high"
[platform]
mass_kg = 10.0
inertia_kg_m2 = [[0.4, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, 0.5]]
tilt_limit_deg = 20.0
[sensor.attitude]
rate_hz = 10.0
noise_deg = 0.1
[truth]
com_um = [0.0, 0.0, HEIGHT]
attitude_deg = [10.0, 0.0, 0.0]
"""


def written(folder, height):
    path = folder / "high.toml"
    path.write_text(HIGH.replace("HEIGHT", str(height)), "utf-8")
    return path


def test_a_record_on_the_stop_is_said_to_be(equipoise, tmp_path):
    path, out = written(tmp_path, 100.0), tmp_path / "run.csv"
    done = equipoise("simulate", path, "--out", out, "--duration-s", 12)
    assert done.code == 0
    assert "rests at its tilt limit of 20 deg from" in done.out
    assert "no estimate models the contact force" in done.out
    read = equipoise("inspect", out, "--testbed", path)
    assert "! the platform rests at its tilt limit of 20 deg from" in read.out


def test_a_record_within_the_limit_says_nothing_of_it(equipoise, tmp_path):
    path, out = written(tmp_path, -100.0), tmp_path / "run.csv"
    done = equipoise("simulate", path, "--out", out, "--duration-s", 12)
    assert done.code == 0
    assert "stop" not in done.out


def test_a_start_beyond_the_stop_is_refused(equipoise, tmp_path):
    path = written(tmp_path, -100.0)
    path.write_text(path.read_text("utf-8").replace("[10.0, 0.0, 0.0]", "[25.0, 0.0, 0.0]"))
    done = equipoise("simulate", path, "--out", tmp_path / "run.csv")
    assert done.code == 2
    assert "truth.attitude_deg: found a tilt of 25 deg" in " ".join(done.err.split())
