"""What of a Grbl board does not come about in time, and how that counts.

All times are attended: what nobody listened to is not late.
"""

from dataclasses import dataclass

from equipoise.hardware.boards.grbl.talk import BEGIN, HOMING, GrblTalk, Step
from equipoise.hardware.transport.driver_protocol import SILENCE, Phase
from equipoise.model.reasons.board_faults import BoardFault
from equipoise.model.reasons.reason import Reason

PATIENCE = 5.0  # s, chosen: for a state to become what it must be


@dataclass(frozen=True, slots=True)
class Late:
    """A fault; whether the position is lost with it, and the board is to be reset."""

    fault: Reason
    lost: bool
    reset: bool = False


def too_late(talk: GrblTalk, phase: Phase, since: float) -> Late | None:
    """Return what is too late; ``since`` is when it was last seen to go on (s, attended)."""
    if phase is Phase.FAULT:
        return None
    if talk.awaiting:
        return _not_begun(talk, phase) if talk.reset_waited > BEGIN else None
    pending = talk.queue.pending
    if pending is not None and talk.queue.overdue and (talk.homing or talk.reported_since_due):
        return _unanswered(talk, pending.purpose)
    if talk.question_waited > SILENCE and not talk.homing:
        code, query = BoardFault.SILENT, "its state (?)"
        return Late(_observed(talk, code, talk.question_waited, query), lost=True)
    if phase in (Phase.CONNECTING, Phase.READY) or pending is not None:
        return None
    return _stalled(talk, phase, talk.clock.now - since)


def _not_begun(talk: GrblTalk, phase: Phase) -> Late:
    text, _ = talk.last_received
    if phase is not Phase.CONNECTING:
        return Late(_observed(talk, BoardFault.NOT_BEGUN, talk.reset_waited), lost=True)
    if text is None:
        return Late(
            Reason(BoardFault.NOTHING_RECEIVED, (), {"waited": talk.reset_waited}), lost=True
        )
    return Late(Reason(BoardFault.NOT_ITS_KIND, ("Grbl", text)), lost=True)


def _unanswered(talk: GrblTalk, step: Step) -> Late:
    waited = talk.queue.waited
    if step in HOMING:
        return Late(_observed(talk, BoardFault.HOMING_LONG, waited), lost=True)
    return Late(_observed(talk, BoardFault.UNANSWERED, waited, step), lost=False)


def _stalled(talk: GrblTalk, phase: Phase, waited: float) -> Late | None:
    """Judge a state that has stayed: of a halt that it still goes, of a way that it stands."""
    if waited <= PATIENCE or talk.status is None:
        return None
    state = talk.status.state
    if phase is Phase.HALTED:
        reason = Reason(BoardFault.NOT_STOPPED, (state,), {"waited": waited})
        return Late(reason, lost=True, reset=True)
    return Late(Reason(BoardFault.STALLED, (state,), {"waited": waited}), lost=False)


def _observed(talk: GrblTalk, code: BoardFault, waited: float, *query: str) -> Reason:
    text, ago = talk.last_received
    return Reason(code, (*query, text or "nothing"), {"waited": waited, "ago": ago})
