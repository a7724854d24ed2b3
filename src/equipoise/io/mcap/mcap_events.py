"""Events of our own MCAP recordings: steps, marks of a person, interlocks."""

from equipoise.io.files.file_content import Content
from equipoise.io.formats.clock_units import PER_S
from equipoise.io.logs.log_topics import DECODED
from equipoise.io.mcap.log_messages import EVENT_TOPIC
from equipoise.io.mcap.mcap_recording import json_object, time_zero
from equipoise.io.mcap.mcap_salvage import salvaged
from equipoise.model.recorded_step import RecordedStep


def mcap_events(content: Content, source: str) -> tuple[RecordedStep, ...]:
    """Return the events of a file in their order; none of another program's file.

    Times are the recording's (s). A message that is no event is passed over.
    """
    found = salvaged(content, source, lambda channel, _: channel.topic == EVENT_TOPIC)
    zero = time_zero(found)
    if zero is None:
        return ()
    ids = {key: each for key, each in found.channels.items() if each.topic == EVENT_TOPIC}
    events = list[RecordedStep]()
    for _, ns, data in found.kept.of(ids):
        found.meter.check(DECODED * len(data))
        event = _event((ns - zero) / PER_S, data)
        if event is not None:
            events.append(event)
    return tuple(sorted(events, key=lambda event: event.time))


def _event(t: float, data: bytes) -> RecordedStep | None:
    message = json_object(data)
    kind, sentence = message.get("kind"), message.get("sentence")
    if not isinstance(kind, str) or not isinstance(sentence, str):
        return None
    return RecordedStep(kind, t, sentence)
