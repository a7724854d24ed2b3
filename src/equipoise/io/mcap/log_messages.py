"""A bench's rows and events as messages, one place for the file and for the live view.

Topics, all times in ns on the clock of the log (UTC of a real bench):

    /attitude   foxglove.FrameTransform, laboratory to body: Foxglove and Lichtblick show it in 3D
    /log        foxglove.Log: the sentence of each event, for people
    /events     JSON {"kind", "sentence", "data"}: the same events, for programs
    /rate /masses /momentum /torque /devices /field /temperature
                JSON, one number for each name, the unit at its end: {"x_rad_s": 0.01, ...}

JSON prints a double with the digits that give the same double again, so values come back exactly.
Schemas of the first two: the public Foxglove schemas. The names of a topic's columns are in its
channel's metadata, so that they survive in whatever order a program writes JSON.
"""

import json
from collections.abc import Mapping
from typing import Any

from equipoise.io.columns.device_columns import si_column
from equipoise.io.columns.native_columns import TEMPERATURE
from equipoise.io.formats.clock_units import PER_S, nanoseconds
from equipoise.io.formats.optional_libraries import log_library
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples

ATTITUDE_TOPIC, LOG_TOPIC, EVENT_TOPIC = "/attitude", "/log", "/events"
LABORATORY, BODY = "laboratory", "body"
CHANNEL_KEY, NAMES_KEY = "equipoise.channel", "equipoise.names"  # of a channel's metadata
START = "start"  # kind of the event with which the platform is free
LEVELS = {"interlock": "Error", "fault": "Warning"}  # how loud a kind of event is; else Info
XYZ_UNITS = {"rate": "rad_s", "momentum": "N_m_s", "torque": "N_m", "field": "T"}


def topic_of(channel: str) -> str:
    """Return the topic of a recording's channel."""
    return f"/{channel}"


def value_names(channel: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a topic calls its numbers; ``names`` are those of masses or devices."""
    if channel == "masses":
        return tuple(f"{name}_m" for name in names)
    if channel == "devices":
        return tuple(map(si_column, names))
    if channel == "temperature":
        return TEMPERATURE
    return tuple(f"{axis}_{XYZ_UNITS[channel]}" for axis in "xyz")


class Topics:
    """The topics of one context, made as their first rows come."""

    def __init__(self, context: Any, zero_ns: int, where: str) -> None:
        """Take the clock's reading at bench time zero, and what to call this in an error."""
        self._context, self._zero_ns, self._where = context, zero_ns, where
        self._foxglove = log_library("foxglove", where)
        self._messages = log_library("foxglove.messages", where)
        self._channels = log_library("foxglove.channels", where)
        self._open: dict[str, Any] = {}
        self._names: dict[str, tuple[str, ...]] = {}

    def rows(self, recording: Recording) -> None:
        """Send the rows of every channel."""
        for channel in CHANNELS:
            samples: Samples | None = getattr(recording, channel)
            if samples is None or not len(samples):
                continue
            if channel == "attitude":
                self._attitude(samples)
            else:
                named = {"masses": recording.mass_names, "devices": recording.device_names}
                self._numbers(channel, named.get(channel, ()), samples)

    def event(self, t: float, kind: str, sentence: str, data: Mapping[str, Any]) -> None:
        """Send what happened at a time (s), for people and for programs."""
        ns, messages = self._at(t), self._messages
        log = messages.Log(
            timestamp=self._stamp(ns),
            level=getattr(messages.LogLevel, LEVELS.get(kind, "Info")),
            message=sentence,
            name=kind,
        )
        self._opened(LOG_TOPIC, self._channels.LogChannel).log(log, log_time=ns)
        message = {"kind": kind, "sentence": sentence, "data": dict(data)}
        events = self._open.get(EVENT_TOPIC) or self._json(EVENT_TOPIC, _event_schema(), {})
        events.log(json.dumps(message).encode(), log_time=ns)

    def _attitude(self, samples: Samples) -> None:
        channel = self._opened(ATTITUDE_TOPIC, self._channels.FrameTransformChannel)
        messages = self._messages
        here = messages.Vector3(x=0.0, y=0.0, z=0.0)
        for t, (w, x, y, z) in zip(samples.t.tolist(), samples.values.tolist(), strict=True):
            ns = self._at(t)
            turn = messages.Quaternion(x=x, y=y, z=z, w=w)
            transform = messages.FrameTransform(
                timestamp=self._stamp(ns), parent_frame_id=LABORATORY, child_frame_id=BODY,
                translation=here, rotation=turn,
            )  # fmt: skip
            channel.log(transform, log_time=ns)

    def _numbers(self, name: str, named: tuple[str, ...], samples: Samples) -> None:
        keys, channel = self._channel_of(name, named, samples.values.shape[1])
        for t, row in zip(samples.t.tolist(), samples.values.tolist(), strict=True):
            message = json.dumps(dict(zip(keys, row, strict=True)))
            channel.log(message.encode(), log_time=self._at(t))

    def _channel_of(
        self, name: str, named: tuple[str, ...], width: int
    ) -> tuple[tuple[str, ...], Any]:
        """Return what a topic calls its numbers, and the topic, opened with its first rows."""
        topic, named = topic_of(name), named or tuple(str(k + 1) for k in range(width))
        if name not in ("masses", "devices"):
            named = ()
        keys = value_names(name, named)
        if topic not in self._open:
            message = {CHANNEL_KEY: name, NAMES_KEY: json.dumps(named)}
            self._json(topic, _schema(f"equipoise.{name}", keys), message)
            self._names[topic] = named
        if self._names[topic] != named:
            found = f"{name} called {', '.join(named)}"
            raise InputError(self._where, found, "those that it began with")
        return keys, self._open[topic]

    def _json(self, topic: str, schema: dict[str, Any], metadata: dict[str, str]) -> Any:
        self._open[topic] = self._foxglove.Channel(
            topic, schema=schema, context=self._context, metadata=metadata
        )
        return self._open[topic]

    def _opened(self, topic: str, kind: Any) -> Any:
        """Return the topic of a known schema, opened when it is first met."""
        if topic not in self._open:
            self._open[topic] = kind(topic, context=self._context)
        return self._open[topic]

    def _at(self, t: float) -> int:
        return self._zero_ns + nanoseconds(t)

    def _stamp(self, ns: int) -> Any:
        return self._messages.Timestamp(ns // PER_S, ns % PER_S)


def _schema(title: str, keys: tuple[str, ...]) -> dict[str, Any]:
    numbers = {key: {"type": "number"} for key in keys}
    return {"title": title, "type": "object", "properties": numbers, "required": list(keys)}


def _event_schema() -> dict[str, Any]:
    parts = {"kind": {"type": "string"}, "sentence": {"type": "string"}, "data": {"type": "object"}}
    return {"title": "equipoise.event", "type": "object", "properties": parts}
