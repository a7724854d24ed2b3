"""A session of balancing by hand: rounds are added, a person's remarks stay."""

from equipoise.io.documents.manual_session import Round, Session, read_session, write_session

BEGUN = Session(
    testbed="deck", target_um=[0.0, 0.0, -100.0], tolerance_um=[2.0, 2.0, 3.0], max_rounds=4
)
FIRST = Round(recording="run1.csv", sha256="1f", from_s=1.5)
PLACED = ["3 x washer at deck:I6"]


def test_a_session_written_and_read_again_is_the_same(tmp_path) -> None:
    path = tmp_path / "s.toml"
    session = BEGUN.model_copy(update={"round": [FIRST]})
    write_session(session, path)
    assert read_session(path) == session


def test_a_session_keeps_the_remarks_in_its_file_when_it_goes_on(tmp_path) -> None:
    """A round gets what was placed, the next round comes after it, a remark stays beside both."""
    path = tmp_path / "s.toml"
    write_session(BEGUN.model_copy(update={"round": [FIRST]}), path)
    path.write_text("# on the new bearing\n" + path.read_text() + "# washers of 1 g\n")
    rounds = [FIRST.model_copy(update={"placed": PLACED}), Round(recording="run2.csv")]
    write_session(BEGUN.model_copy(update={"round": rounds}), path)
    assert read_session(path).round == rounds
    text = path.read_text()
    assert text.startswith("# on the new bearing\n")
    assert text.index("placed") < text.index("# washers of 1 g") < text.index("run2.csv")
