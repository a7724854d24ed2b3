"""The scene in Foxglove's own terms, read by the schemas that the file bears."""

import json
import math
from dataclasses import replace
from importlib import resources

import numpy as np
import pytest

from equipoise.io.files.file_content import Content
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.mcap.mcap_salvage import salvaged
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording, Samples
from equipoise.model.units import UM
from tests.support.protobuf_by_schema import decoded

BED = read_preset("nanosat")
COM, SD = np.array([30.0, -40.0, 0.0]) * UM, np.array([2.0, 3.0, 6.0]) * UM


def masses_at(t, *displacements):
    row = np.array([[*displacements, 0.0, 0.0, 0.0][:3]])
    return Recording(mass_names=BED.mass_names, masses=Samples(np.array([t]), row))


def scenes(folder, *said, bed=BED):
    """Return each scene that a record shows: its time (s), and its entities by name."""
    path = folder / "run.mcap"
    with LiveRecording(path, Opening(10**18, "", bed)) as file:
        for each in said:
            if isinstance(each, Recording):
                file.rows(each)
            else:
                file.event(*each)
    found = salvaged(Content.of(path.read_bytes(), "log"), "run")
    (channel,) = (c for c in found.channels.values() if c.topic == "/scene")
    schema = found.schemas[channel.schema_id]
    assert schema.name == "foxglove.SceneUpdate"
    updates = [
        (m.log_time / 1e9 - 1e9, decoded(schema.data, schema.name, m.data))
        for m in found.messages
        if m.channel_id == channel.id
    ]
    return [(t, {entity["id"]: entity for entity in update["entities"]}) for t, update in updates]


def place(primitive):
    return np.array([primitive["pose"]["position"].get(axis, 0.0) for axis in "xyz"])


def size(primitive):
    return np.array([primitive["size"].get(axis, 0.0) for axis in "xyz"])


def turned(primitive, vector):
    turn = primitive["pose"]["orientation"]
    w, *axis = (turn.get(name, 0.0) for name in "wxyz")
    across = 2 * np.cross(axis, vector)
    return vector + w * across + np.cross(axis, across)


def estimate(t, com=COM, sd=SD):
    return t, "step", "estimated", {"com_m": [*com], "sd_m": [*sd]}


def factor_of(entity):
    return float(entity["texts"][0]["text"].split(" x ")[1].split(",")[0].replace(" ", ""))


def test_masses_are_drawn_where_they_stand_and_are_drawn_again_when_they_move(tmp_path):
    """x goes out and back; the second row is where the first one was."""
    rows = [masses_at(t, at) for t, at in ((0.0, 0.0), (1.0, 0.0), (2.0, 4e-3), (3.0, 0.0))]
    found = scenes(tmp_path, *rows)
    assert [t for t, _ in found] == pytest.approx([0.0, 2.0, 3.0])
    mass = BED.masses[0]
    for (_, entities), at in zip(found, (0.0, 4e-3, 0.0), strict=True):
        np.testing.assert_allclose(
            place(entities["masses"]["cubes"][0]), mass.home + at * mass.axis, atol=1e-12
        )
    assert [text["text"] for text in found[0][1]["masses"]["texts"]] == list(BED.mass_names)


def test_the_centre_of_mass_and_its_sd_are_drawn_larger_by_the_stated_factor(
    tmp_path,
):
    (_, _), (_, entities) = scenes(tmp_path, masses_at(0.0), estimate(1.0))
    drawn, factor = entities["centre of mass"], factor_of(entities["centre of mass"])
    dot, ellipsoid = drawn["spheres"]
    np.testing.assert_allclose(place(dot), factor * COM)
    np.testing.assert_allclose(place(ellipsoid), factor * COM)
    np.testing.assert_allclose(size(ellipsoid), 2 * factor * SD)
    assert factor == 10.0 ** math.floor(math.log10(factor)) * int(str(factor)[0])
    radius = size(entities["platform"]["cylinders"][0])[0] / 2
    assert 0.3 < factor * (np.linalg.norm(COM) + SD.max()) / radius < 1.0


def test_the_centre_of_mass_goes_with_the_masses(tmp_path):
    """m d / M of the platform: an estimate holds for the masses as they stood then."""
    mass, d = BED.masses[0], 2e-3
    shift = mass.mass * d * mass.axis / BED.body.mass
    found = scenes(tmp_path, masses_at(0.0, d), estimate(1.0), masses_at(2.0, 0.0))
    before, after = (entities["centre of mass"] for _, entities in found[-2:])
    np.testing.assert_allclose(place(before["spheres"][0]) / factor_of(before), COM, rtol=1e-9)
    np.testing.assert_allclose(
        place(after["spheres"][0]) / factor_of(after), COM - shift, rtol=1e-9, atol=1e-15
    )


@pytest.mark.parametrize("sd", [[None, 1e-6, 1e-6], [0.0, 0.0, 0.0]])
def test_an_sd_that_is_not_known_has_no_ellipsoid(tmp_path, sd):
    _, (_, entities) = scenes(tmp_path, masses_at(0.0), estimate(1.0, COM, sd))
    assert len(entities["centre of mass"]["spheres"]) == 1
    assert "sd" not in entities["centre of mass"]["texts"][0]["text"]


def test_gravity_points_down_in_the_laboratory_and_the_rest_turns_with_the_body(tmp_path):
    """An arrow lies along x of its pose, a cylinder along z; the body axis that points up is x."""
    tipped = replace(BED, up=np.array([1.0, 0.0, 0.0]))
    ((_, entities),) = scenes(tmp_path, masses_at(0.0), bed=tipped)
    assert {name: entity["frame_id"] for name, entity in entities.items()} == {
        "platform": "body", "masses": "body", "centre of mass": "body", "gravity": "laboratory",
    }  # fmt: skip
    assert all(entity["frame_locked"] for entity in entities.values())
    assert all("lifetime" not in entity for entity in entities.values())
    (arrow,) = entities["gravity"]["arrows"]
    np.testing.assert_allclose(turned(arrow, [1.0, 0.0, 0.0]), [0.0, 0.0, -1.0], atol=1e-12)
    (disc,) = entities["platform"]["cylinders"]
    np.testing.assert_allclose(turned(disc, [0.0, 0.0, 1.0]), tipped.up, atol=1e-12)


def test_an_event_that_states_no_centre_of_mass_changes_nothing(tmp_path):
    nothing = (1.0, "step", "looked", {"com_m": [None, 1e-6, 1e-6], "sd_m": [1e-6] * 3})
    note = (2.0, "note", "a note", {})
    assert len(scenes(tmp_path, masses_at(0.0), nothing, note)) == 1


def test_the_layout_that_is_shipped_shows_topics_and_fields_that_there_are(tmp_path):
    """Every path of a plot is a number of a topic's schema; every panel stands in the layout."""
    text = (resources.files("equipoise.io.mcap") / "foxglove_layout.json").read_text()
    layout = json.loads(text)
    path = tmp_path / "run.mcap"
    with LiveRecording(path, Opening(10**18, "", BED)):
        pass
    found = salvaged(Content.of(path.read_bytes(), "log"), "run")
    topics = {c.topic: found.schemas[c.schema_id] for c in found.channels.values()}
    panels = layout["configById"]
    series = [each["value"] for panel in panels.values() for each in panel.get("paths", [])]
    assert len(series) == 6
    for value in series:
        topic, field = value.split(".")
        assert json.loads(topics[topic].data)["properties"][field] == {"type": "number"}
    assert topics[panels["RosOut!log"]["topicToRender"]].name == "foxglove.Log"
    (shown,) = panels["3D!bench"]["topics"]
    assert topics[shown].name == "foxglove.SceneUpdate"

    def placed(part):
        return [part] if isinstance(part, str) else placed(part["first"]) + placed(part["second"])

    assert sorted(placed(layout["layout"])) == sorted(panels)
