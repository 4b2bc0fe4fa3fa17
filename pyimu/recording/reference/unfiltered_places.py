"""Places, or velocities, without the filter that they went through."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.recording.reference.file import at_log
from pyimu.recording.reference.nodes import own_places
from pyimu.recording.reference.sampling import through
from pyimu.recording.reference.track import LEAST_NODES, Track, fresh
from pyimu.recording.reference.unlagged import LAG, slope
from pyimu.recording.reference.unsmoothed import SMOOTHED, Smoothing

DEGREE = 5
"""Of the splines between samples: what is made of them is differentiated twice."""

LATE = "positions_late"
"""The finding of places that have another clock than the attitudes beside them."""

SIDEWAYS = "reference_sideways"
"""The finding of attitudes and places in a world whose vertical is another axis than z."""

EXPLAINED = "explained"
"""Of a finding: what the filter, or the clock, explained of what the accelerometer shows beside the
places, in nat."""

GROUPS = {
    "position": ("ref_east", "ref_north", "ref_up"),
    "velocity": ("ref_velocity",),
}
"""What holds the places of each kind."""


def unsmoothed_places(
    recording: Recording,
    smoothing: Smoothing,
    kind: str,
    early: float = 0.0,
    explained: float = 0.0,
) -> Recording:
    """The recording with the places of a ``kind`` that were smoothed, less those near an end, and
    are ``early`` by so many s; as it is where no segment reaches further. That they were smoothed
    ``explained`` so many nat.
    """

    def sharp(time: np.ndarray, values: np.ndarray) -> np.ndarray:
        reach = smoothing.reach(h := float(np.median(np.diff(time))))
        out = np.full_like(values, np.nan)
        if len(time) >= 2 * reach + LEAST_NODES:
            out[reach:-reach] = smoothing.vectors(values, h)[reach:-reach]
        return out

    found = Finding(SMOOTHED, "", 1, smoothing.as_detail() | {EXPLAINED: explained})
    return _with(recording, kind, sharp, early, found)


def unlagged_places(
    recording: Recording, lag: float, kind: str, early: float = 0.0, explained: float = 0.0
) -> Recording:
    """The recording with the places of a ``kind`` that went into a low-pass filter of first order
    with a time constant of ``lag`` s, and are ``early`` by so many s. The filter ``explained`` so
    many nat.
    """

    def quick(time: np.ndarray, values: np.ndarray) -> np.ndarray:
        return values + lag * slope(time, values)

    found = Finding(LAG, "", 1, {"time_constant": lag, EXPLAINED: explained})
    return _with(recording, kind, quick, early, found)


def places_on_time(
    recording: Recording, kind: str, early: float, explained: float = 0.0
) -> Recording:
    """The recording with the places of a ``kind`` that are ``early`` by so many s beside its
    attitudes, which ``explained`` so many nat.
    """
    found = Finding(LATE, "", 1, {"late": -early, EXPLAINED: explained})
    return _with(recording, kind, lambda _, values: values, early, found)


def _with(
    recording: Recording,
    kind: str,
    undo: Callable[[np.ndarray, np.ndarray], np.ndarray],
    early: float,
    found: Finding,
) -> Recording:
    """The recording with what ``undo`` makes of each stretch of the samples that the places of a
    ``kind`` have of their own, so ``early``, seen at the rows again, and what was ``found``.
    """
    source = recording if recording.reference is None else recording.reference
    values = np.column_stack([getattr(source, name) for name in GROUPS[kind]])
    known = fresh(values)
    at, nodes = own_places(source.time[known], values[known])
    out = np.full_like(values, np.nan)
    track = Track(at, np.arange(len(at)), lambda n: np.diff(nodes[n], axis=0), np.inf)
    for part in track.segments:
        sharp = undo(at[part], nodes[part])
        inner = np.isfinite(sharp).all(axis=1)
        if np.count_nonzero(inner) < LEAST_NODES:
            continue
        time = at[part][inner] + early
        rows = (source.time >= time[0]) & (source.time <= time[-1])
        out[rows] = through(time, sharp[inner], DEGREE)(source.time[rows])
    if not np.isfinite(out).any():
        return recording
    names = GROUPS[kind]
    places = dict(zip(names, out.T, strict=True)) if len(names) > 1 else {names[0]: out}
    findings = (*source.findings, replace(found, column=names[0]))
    return at_log(recording, replace(source, **places, findings=findings))
