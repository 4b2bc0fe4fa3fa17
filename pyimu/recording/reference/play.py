"""Play between an encoder and what it turns, about an axis of the world or of the body.

An encoder before a gear, as on a pan-tilt head, goes on by the gear's play after each reversal
before the body follows (Nordin and Gutman 2002, Automatica 38, equation 1 without a stiffness).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import attitude_at, attitude_track, steps_of
from pyimu.recording.reference.file import TRUTHS, at_log
from pyimu.recording.reference.nodes import own_samples

PLAY = "reference_play"
"""The finding of a reference before a gear with play."""

OF_JOINT = "_play"
"""How the details of that finding end, each the play of a joint in rad."""

AXES = "xyz"


@njit(cache=True)
def behind_play(angle, width):
    """Angles (n,) behind a play of a ``width`` > 0: they stay until one end of it is reached."""
    out, at = np.empty_like(angle), angle[0]
    for k in range(len(angle)):
        if angle[k] - at > 0.5 * width:
            at = angle[k] - 0.5 * width
        elif at - angle[k] > 0.5 * width:
            at = angle[k] + 0.5 * width
        out[k] = at
    return out


def stays_behind(turns: np.ndarray, width: float, backward: bool = False) -> np.ndarray:
    """By what angles (n,) rad a body stays behind an encoder that makes ``turns`` (n,) rad from row
    to row, with a play of a ``width`` in rad; ``backward`` in time it runs ahead.
    """
    angle = np.cumsum(turns)
    order = slice(None, None, -1 if backward else 1)
    return behind_play(np.ascontiguousarray(angle[order]), width)[order] - angle


@dataclass(frozen=True)
class Joint:
    """Where an encoder turns a body: about axis ``number`` of the ``world``, or of the body."""

    world: bool
    number: int

    @property
    def name(self) -> str:
        """What findings call it: the world's third axis points up."""
        if self.world and self.number == 2:
            return "vertical"
        return f"{'world' if self.world else 'body'}_{AXES[self.number]}"

    def axis(self, attitude: Rotation) -> np.ndarray:
        """The axis (n, 3), in the body's."""
        unit = np.eye(3)[self.number]
        return (
            attitude.apply(unit, inverse=True) if self.world else np.tile(unit, (len(attitude), 1))
        )


JOINTS = tuple(Joint(world, number) for world in (True, False) for number in (2, 1, 0))
"""All of them: on a turntable, whose vertical is the world's and the body's, the world's."""


def without_play(recording: Recording, widths: dict[Joint, float]) -> Recording:
    """The recording with the attitudes that its body had behind plays of ``widths`` in rad, which
    its ``ref_q`` was taken before.
    """
    source = recording if recording.reference is None else recording.reference
    own = own_samples(source)
    behind = replace(own, ref_q=_behind(own, widths))
    if own is not source and any(getattr(source, g) is not None for g in TRUTHS if g != "ref_q"):
        behind = replace(source, ref_q=attitude_at(behind, source.time))
    detail = {f"{joint.name}{OF_JOINT}": width for joint, width in widths.items()}
    found = Finding(PLAY, "ref_q", len(widths), detail)
    return at_log(recording, replace(behind, findings=(*behind.findings, found)))


def _behind(source: Recording, widths: dict[Joint, float]) -> np.ndarray:
    out = np.full_like(source.ref_q, np.nan)
    for nodes in attitude_track(source).segments:
        steps = steps_of(source.ref_q, nodes)
        attitude = Rotation.from_quat(source.ref_q[nodes], scalar_first=True)
        body = attitude
        for joint, width in widths.items():
            axis = joint.axis(attitude)
            turns = np.sum(steps * (axis[:-1] + axis[1:]), axis=1) / 2.0
            late = stays_behind(np.append(0.0, turns), width)[:, None]
            unit = np.eye(3)[joint.number]
            turn = Rotation.from_rotvec(late * unit)
            body = turn * body if joint.world else body * turn
        out[nodes] = body.as_quat(scalar_first=True)
    return out
