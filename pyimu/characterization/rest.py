"""Whether a log is one of a sensor at rest: changes of the mean from one second to the next that no
such sensor makes by itself.
"""

from __future__ import annotations

from collections.abc import Container, Iterator

import numpy as np

from pyimu.characterization.samples import CHUNK, Samples
from pyimu.errors import Finding
from pyimu.model.part import AXES

LARGEST = {"gyro": np.deg2rad(0.5), "accel": 0.1}
"""rad/s and m/s^2 (10 mg): ten and more standard deviations of a second's mean of a consumer part
(N of 0.05 deg/s/sqrt(Hz), 1 mg/sqrt(Hz))."""

SECONDS = 1.0

RARE = 0.005
"""Share of the seconds up to which it is a jolt, and not motion."""


def motion(samples: Samples, wrapped: Container[str] = ()) -> list[Finding]:
    """``motion`` for each column that moves in more than a few seconds; ``count`` seconds of it,
    the first of them in ``first_row``.

    Columns ``wrapped`` are left out: they jump without a motion.
    """
    length = max(round(SECONDS / samples.h), 1)
    found = []
    for axis, column in zip(AXES, samples.columns, strict=True):
        if f"{samples.kind}_{axis}" in wrapped:
            continue
        changes = list(_changes(samples, column, length))
        steps = np.concatenate([c for c, _ in changes]) if changes else np.empty(0)
        rows = np.concatenate([r for _, r in changes]) if changes else np.empty(0, dtype=int)
        moved = np.abs(steps) > LARGEST[samples.kind]
        if np.count_nonzero(moved) > RARE * len(steps):
            detail = {
                "largest": float(np.abs(steps).max()),
                "first_row": int(samples.row(rows[np.argmax(moved)])),
            }
            found.append(
                Finding("motion", f"{samples.kind}_{axis}", int(np.count_nonzero(moved)), detail)
            )
    return found


def _changes(
    samples: Samples, column: np.ndarray, length: int
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Changes (k,) of the mean from one second to the next, and the samples (k,) at which the
    second one begins.
    """
    step = max(CHUNK // length, 2) * length
    for start, stop in samples.stretches:
        for a in range(start, stop, step):
            # A second more, so that the change across the chunk's end is one of it.
            count = (min(a + step + length, stop) - a) // length
            if count > 1:
                means = column[a : a + count * length].reshape(count, length).mean(axis=1)
                yield np.diff(means), a + length * np.arange(1, count)
