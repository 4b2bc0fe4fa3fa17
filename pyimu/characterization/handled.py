"""The hand that begins and ends a log at rest: left out of it."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from pyimu.characterization.samples import PIECE, Samples
from pyimu.errors import Finding
from pyimu.model.part import AXES
from pyimu.recording.quality.in_pieces import Inspector
from pyimu.recording.recording import Recording
from pyimu.recording.rest import SECOND, seconds_of

MOST = 0.1
"""Share of a log that a hand may have at both ends together: with more it is no log at rest."""

PAUSE = 10.0
"""s; between two seconds of motion of one hand, and before the first or after the last of them."""


def without_ends(
    sensors: Mapping[str, Samples], ignored: Container[str] = ()
) -> tuple[dict[str, Samples], list[Finding]]:
    """The sensors without the motion at the beginning and the end of a log, and a finding
    ``handled``; as they are where more moves than that.

    Who presses the button and lays the sensor down, or picks it up to end a log, moves it for some
    seconds. The finding has their number, and the seconds at the ``first`` and the ``last``.
    The columns ``ignored`` are not looked at.
    """
    known = [s for s in sensors.values() if len(s)]
    if not known:
        return dict(sensors), []
    start, stop = min(s.time[0] for s in known), max(s.time[-1] for s in known)
    times = np.sort(np.concatenate([t for s in known for t in _moving(s, ignored)]))
    begin, end = _first_end(times, start), -_first_end(-times[::-1] - SECOND, -stop)
    lost = float(begin - start), float(stop - end)
    if not 0.0 < sum(lost) <= MOST * (stop - start):
        return dict(sensors), []
    rest = {kind: s.between(begin, end) for kind, s in sensors.items()}
    if any(s.motion(ignored) for s in rest.values()):
        return dict(sensors), []
    return rest, [Finding("handled", "time", round(sum(lost)), {"first": lost[0], "last": lost[1]})]


def of_what_is_left(
    findings: Iterable[Finding], sensors: Mapping[str, Samples]
) -> Iterator[Finding]:
    """The findings of a log, its spikes being those of the samples that are left: in quick motion
    there may be others, which are in no noise.
    """
    yield from (f for f in findings if f.kind != "spikes")
    for kind, samples in sensors.items():
        inspector = Inspector()
        for a in range(0, len(samples), PIECE):
            values = np.column_stack([column[a : a + PIECE] for column in samples.columns])
            time = samples.time[a : a + PIECE]
            inspector.add(Recording.from_arrays("left", time=time, **{kind: values}))
        for f in inspector.findings():
            if f.kind == "spikes":
                row = samples.row(f.detail["first_row"])
                yield replace(f, detail={**f.detail, "first_row": row})


def _moving(samples: Samples, ignored: Container[str]) -> Iterator[np.ndarray]:
    """By column the times (k,) s at which seconds begin in which it moves."""
    yield np.empty(0)
    for axis, column in zip(AXES, samples.columns, strict=True):
        if f"{samples.kind}_{axis}" not in ignored:
            found = seconds_of(column, samples.segments, samples.h)
            moves = found.moving(samples.kind) | found.far(samples.kind)
            yield samples.time[found.first[moves | found.vibrating(samples.kind)]]


def _first_end(times: np.ndarray, start: float) -> float:
    """When the motion is over that is there from a ``start`` on, of seconds that begin at ``times``
    (k,), in order, and a second later: a change is known in the second behind it.
    """
    end = start
    for t in times[times >= start]:
        if t > end + PAUSE:
            break
        end = max(end, t + 2 * SECOND)
    return end
