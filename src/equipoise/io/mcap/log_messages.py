"""A bench's rows and events as messages, one place for the file and for the live view.

Topics, all times in ns on the clock of the log (UTC of a real bench):

    /attitude   foxglove.FrameTransform, laboratory to body: Foxglove and Lichtblick show it in 3D
    /scene      foxglove.SceneUpdate: what stands in these frames (``foxglove_scene``)
    /log        foxglove.Log: the sentence of each event, for people
    /events     JSON {"kind", "sentence", "data"}: the same events, for programs
    /rate /masses /momentum /torque /devices /field /temperature /lamp /accelerometer /sun
    /position /torque_by_cause
                JSON, one number for each name, the unit at its end: {"x_rad_s": 0.01, ...}
    /gravity_torque
                JSON: what a controller is told to feed forward (``io.stream.gravity_message``)

Every message in JSON begins with its time, {"timestamp": {"sec", "nsec"}}, as those of Foxglove do.
JSON prints a double with the digits that give the same double again, so values come back exactly.
Schemas of the first three: the public Foxglove schemas. The names of a topic's columns are in its
channel's metadata, so that they survive in whatever order a program writes JSON.
"""

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from equipoise.io.columns.device_columns import si_column
from equipoise.io.columns.native_columns import ACCELEROMETER, LAMP, SUN, TEMPERATURE
from equipoise.io.formats.clock_units import PER_S, nanoseconds
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.foxglove_scene import BODY, LABORATORY, Scene
from equipoise.io.stream import gravity_message
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, NAMED, Recording, Samples, column_names
from equipoise.model.testbed import Testbed

ATTITUDE_TOPIC, SCENE_TOPIC, LOG_TOPIC, EVENT_TOPIC = "/attitude", "/scene", "/log", "/events"
STAMP = "timestamp"  # key of a message's time
CHANNEL_KEY, NAMES_KEY = "equipoise.channel", "equipoise.names"  # of a channel's metadata
Send = Callable[[bytes, int], None]  # takes a message and its time, ns
# Opens a topic: its name, encoding, schema (with name, encoding and data), metadata.
Opener = Callable[[str, str, Any, Mapping[str, str]], Send]
START = "start"  # kind of the event with which the platform is free
STREAMS = {gravity_message.KIND: gravity_message.PARTS}  # kinds that come many times a second
LEVELS = {"interlock": "Error", "fault": "Warning"}  # how loud a kind of event is; else Info
XYZ_UNITS = {"rate": "rad_s", "momentum": "N_m_s", "torque": "N_m", "field": "T"}
AS_IN_TABLES = {
    "temperature": TEMPERATURE, "lamp": LAMP, "accelerometer": ACCELEROMETER, "sun": SUN,
    "position": ("x_m", "y_m"),
}  # fmt: skip


def topic_of(channel: str) -> str:
    """Return the topic of a recording's channel."""
    return f"/{channel}"


def value_names(channel: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a topic calls its numbers; ``names`` are those of the channel's columns."""
    if channel == "masses":
        return tuple(f"{name}_m" for name in names)
    if channel == "devices":
        return tuple(map(si_column, names))
    if channel == "torque_by_cause":
        return tuple(f"{name}_N_m" for name in names)
    if channel in AS_IN_TABLES:
        return AS_IN_TABLES[channel]
    return tuple(f"{axis}_{XYZ_UNITS[channel]}" for axis in "xyz")


@dataclass(frozen=True, slots=True)
class JsonSchema:
    """The schema of a topic in JSON."""

    name: str
    data: bytes
    encoding: str = "jsonschema"


class Topics:
    """The topics of a file or a live view; those that a bench is known to have from the start."""

    def __init__(
        self, opener: Opener, zero_ns: int, where: str, platform: Testbed | None = None
    ) -> None:
        """Take the clock's reading at bench time zero, and what to call this in an error."""
        self._opener, self._zero_ns, self._where = opener, zero_ns, where
        self._messages = log_library("foxglove.messages", where)
        self._open: dict[str, Send] = {}
        self._names: dict[str, tuple[str, ...]] = {}
        self._scene = None if platform is None else Scene(platform, self._messages)
        self._opened_early(platform)

    def rows(self, recording: Recording) -> None:
        """Send the rows of every channel."""
        for channel in CHANNELS:
            samples: Samples | None = getattr(recording, channel)
            if samples is None or not len(samples):
                continue
            if channel == "attitude":
                self._attitude(samples)
            else:
                self._numbers(channel, column_names(recording, channel), samples)
        if self._scene is not None:
            self._shown(self._scene.moved(recording))

    def event(self, t: float, kind: str, sentence: str, data: Mapping[str, Any]) -> None:
        """Send what happened at a time (s), for people and for programs.

        What comes many times a second has a topic of its own, for programs alone.
        """
        ns, messages = self._at(t), self._messages
        if kind in STREAMS:
            parts = _schema(f"equipoise.{kind}", STREAMS[kind])
            self._json_topic(topic_of(kind), parts, {})(_json(ns, data), ns)
            return
        log = messages.Log(
            timestamp=self._stamp(ns),
            level=getattr(messages.LogLevel, LEVELS.get(kind, "Info")),
            message=sentence,
            name=kind,
        )
        self._log()(log.encode(), ns)
        message = {"kind": kind, "sentence": sentence, "data": dict(data)}
        self._events()(_json(ns, message), ns)
        if self._scene is not None:
            self._shown(self._scene.estimated(t, data))

    def scene_again(self, t: float) -> None:
        """Send the scene as it stands at a time (s), for who has not seen it yet."""
        if self._scene is not None:
            self._shown([self._scene.now(t)])

    def _opened_early(self, platform: Testbed | None) -> None:
        """Open the topics of a bench, so that who looks before the first row finds them."""
        if platform is None:
            return
        self._log()
        self._events()
        self._known(SCENE_TOPIC, self._messages.SceneUpdate)
        units = () if platform.hardware is None else platform.hardware.sensors
        given = {channel for unit in units for channel in unit.gives}
        if platform.attitude is not None or "attitude" in given:
            self._known(ATTITUDE_TOPIC, self._messages.FrameTransform)
        if platform.gyro is not None or "rate" in given:
            self._channel_of("rate", (), 3)
        if platform.masses:
            self._channel_of("masses", platform.mass_names, len(platform.masses))

    def _shown(self, updates: Iterable[tuple[float, Callable[[Any], Any]]]) -> None:
        for t, update in updates:
            ns = self._at(t)
            message = update(self._stamp(ns)).encode()
            self._known(SCENE_TOPIC, self._messages.SceneUpdate)(message, ns)

    def _attitude(self, samples: Samples) -> None:
        send = self._known(ATTITUDE_TOPIC, self._messages.FrameTransform)
        messages = self._messages
        here = messages.Vector3(x=0.0, y=0.0, z=0.0)
        for t, (w, x, y, z) in zip(samples.t.tolist(), samples.values.tolist(), strict=True):
            ns = self._at(t)
            turn = messages.Quaternion(x=x, y=y, z=z, w=w)
            transform = messages.FrameTransform(
                timestamp=self._stamp(ns), parent_frame_id=LABORATORY, child_frame_id=BODY,
                translation=here, rotation=turn,
            )  # fmt: skip
            send(transform.encode(), ns)

    def _numbers(self, name: str, named: tuple[str, ...], samples: Samples) -> None:
        keys, send = self._channel_of(name, named, samples.values.shape[1])
        for t, row in zip(samples.t.tolist(), samples.values.tolist(), strict=True):
            ns = self._at(t)
            send(_json(ns, dict(zip(keys, row, strict=True))), ns)

    def _channel_of(
        self, name: str, named: tuple[str, ...], width: int
    ) -> tuple[tuple[str, ...], Send]:
        """Return what a topic calls its numbers, and the topic, opened when it is first met."""
        topic, named = topic_of(name), named or tuple(str(k + 1) for k in range(width))
        if name not in NAMED:
            named = ()
        keys = value_names(name, named)
        if topic not in self._open:
            message = {CHANNEL_KEY: name, NAMES_KEY: json.dumps(named)}
            numbers = {key: {"type": "number"} for key in keys}
            self._json_topic(topic, _schema(f"equipoise.{name}", numbers), message)
            self._names[topic] = named
        if self._names[topic] != named:
            found = f"{name} called {', '.join(named)}"
            raise InputError(self._where, found, "those that it began with")
        return keys, self._open[topic]

    def _log(self) -> Send:
        return self._known(LOG_TOPIC, self._messages.Log)

    def _events(self) -> Send:
        parts = {
            "kind": {"type": "string"},
            "sentence": {"type": "string"},
            "data": {"type": "object"},
        }
        return self._json_topic(EVENT_TOPIC, _schema("equipoise.event", parts), {})

    def _json_topic(self, topic: str, schema: JsonSchema, metadata: Mapping[str, str]) -> Send:
        if topic not in self._open:
            self._open[topic] = self._opener(topic, "json", schema, metadata)
        return self._open[topic]

    def _known(self, topic: str, kind: Any) -> Send:
        """Return the topic of a known schema, opened when it is first met."""
        if topic not in self._open:
            self._open[topic] = self._opener(topic, "protobuf", kind.get_schema(), {})
        return self._open[topic]

    def _at(self, t: float) -> int:
        return self._zero_ns + nanoseconds(t)

    def _stamp(self, ns: int) -> Any:
        return self._messages.Timestamp(ns // PER_S, ns % PER_S)


def _json(ns: int, message: Mapping[str, Any]) -> bytes:
    """Return a message with its time in front, as Foxglove's own JSON schemas have it."""
    stamp = {"sec": ns // PER_S, "nsec": ns % PER_S}
    return json.dumps({STAMP: stamp, **message}).encode()


def _schema(title: str, parts: Mapping[str, Any]) -> JsonSchema:
    whole = {"type": "integer", "minimum": 0}
    stamp = {"title": "time", "type": "object", "properties": {"sec": whole, "nsec": whole}}
    schema = {
        "title": title, "type": "object",
        "properties": {STAMP: stamp, **parts}, "required": [STAMP, *parts],
    }  # fmt: skip
    return JsonSchema(title, json.dumps(schema).encode())
