"""Columns that hold increments from sample to sample: of the angle, and of the velocity."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pyimu.recording.naming.name import Name, named

GLUED = re.compile(r"(d(?:el(?:ta)?)?(?:theta|th|angle|ang|velocity|vel|v)|velinc)_?([xyz])")
"""Names in one word: ``dthx``, ``dvelx``, ``DVX``."""

STEPS = {"d", "delta", "del", "inc", "incr", "increment", "increments"}
"""Words for an increment, beside one for what it is of."""

OF = {"gyro": {"angle", "ang", "theta", "th", "rotation"}, "accel": {"velocity", "vel", "v"}}
"""Words for the angle and the velocity."""

WHOLE = {
    "gyro": {"dtheta", "dth", "dangle", "dang", "deltatheta", "deltaangle", "delang", "angleinc"},
    "accel": {"dv", "dvel", "dvelocity", "deltav", "deltavel", "deltavelocity", "delvel", "velinc"},
}
"""The two in one word."""


def increments(header: Sequence[str]) -> dict[str, list[tuple[int, Name]]]:
    """Positions and names of the increments of "gyro" and "accel", x, y and z, in a header."""
    found: dict[str, dict[str, tuple[int, Name]]] = {"gyro": {}, "accel": {}}
    for at, cell in enumerate(header):
        name = named(cell)
        axis, words = name.axis, set(name.words)
        glued = None if axis else GLUED.fullmatch("".join(name.words))
        if glued is not None:
            axis, words = glued[2], {glued[1]}
        for group, of in OF.items():
            told = words & WHOLE[group] or (words & STEPS and words & of)
            if told and axis in ("x", "y", "z"):
                found[group].setdefault(axis, (at, name))
    return {group: [axes[a] for a in "xyz"] for group, axes in found.items() if len(axes) == 3}
