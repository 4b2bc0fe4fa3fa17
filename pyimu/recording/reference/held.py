"""A reference that a logger wrote at rows of its own, each of its samples until the next one came.

A sample was taken between the row that shows it first and the row before. Where its rate is no
part of the log's, these rows come at uneven times, and the samples at even ones. Of all even times
that explain the rows the latest are taken: what the sensor then seems early by is the clock's, and
no delay of the sensor is made up.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from pyimu.recording.recording import Recording, at_own_times
from pyimu.recording.reference.file import TRUTHS, at_log
from pyimu.recording.reference.track import fresh, known_axes

UNEVEN = 0.1
"""Rows by which first rows must come too late, some more than others, to tell of even times."""

LATEST = 1.05
"""Rows by which a sample may be late: one, and what the rows' own stamps scatter by."""

WINDOW = 32
"""Samples without one that is missing by which their spacing is first known, to a row in so many;
from there the line through them is laid through more and more."""

REPEATED = 0.03
"""Share of the rows that must repeat the one before, for a reference to be held at all."""


def held_apart(recording: Recording) -> Recording:
    """The recording with the samples that its reference was held between as a reference of its own,
    at even times where these explain the rows; as it is where it was not held.
    """
    groups = [g for g in TRUTHS if getattr(recording, g) is not None]
    if recording.reference is not None or not groups:
        return recording
    values = [np.reshape(getattr(recording, g), (len(recording), -1)) for g in groups]
    # An axis that nobody knows is no value that is missing.
    together = np.hstack(values)
    known = together[:, known_axes(together)]
    rows, even = _first_rows(recording, known)
    if not len(rows):
        return recording
    given = {g: getattr(recording, g)[rows] for g in groups}
    if recording.latitude is not None:
        given["latitude"] = recording.latitude[rows]
    time = recording.time[rows] if even is None else even
    return at_log(recording, at_own_times(recording, time, **given))


def _first_rows(recording: Recording, values: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """The rows (k,) that show samples of values (n, d) first, and the even times (k,) of these, if
    they have any; no rows where nothing was held.

    Where samples come nearly as often as rows, these times alone say that anything was.
    """
    whole, row = np.flatnonzero(np.isfinite(values).all(axis=1)), recording.sample_period
    rows = fresh(values)
    if 0 < len(rows) < len(whole):
        return rows, _even(recording.time[rows], row)
    new = np.append(True, np.any(np.diff(values[whole], axis=0) != 0.0, axis=1))[: len(whole)]
    even = _even(recording.time[whole[new]], row) if np.mean(~new) > REPEATED else None
    # What stands still for a while repeats rows, too, but no others.
    if even is None or np.median(np.diff(even)) < (1.0 + REPEATED) * row:
        return whole[:0], None
    return whole[new], even


def _even(time: np.ndarray, row: float) -> np.ndarray | None:
    """The even times (k,) s of samples that rows ``row`` s apart show first at ``time`` (k,);
    None where no such times explain the rows, or where they are the rows' own.
    """
    # What the log's first row shows may be older than that row by any part of a spacing.
    seen = time[1:]
    if len(seen) <= WINDOW:
        return None
    number = np.arange(len(seen))
    line, late = _narrowest(number, seen, np.polyfit(number, seen, 1))
    if np.ptp(late) >= LATEST * row:
        number, line = _counted(seen)
        line, late = _narrowest(number, seen, line)
    even = UNEVEN * row < np.ptp(late) < LATEST * row and np.all(np.diff(number) > 0)
    numbers = np.append(number[0] - 1, number)
    return np.polyval(line, numbers) + late.min() if even else None


def _narrowest(
    number: np.ndarray, seen: np.ndarray, line: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The line (2,) about which ``seen`` (k,) s spreads least, and by how much each is later than
    it (k,) s, from a ``line`` near it on.

    Delays of at most a row bound the line, however they come; of few slow beats between the two
    rates, least squares follow these.
    """
    late = seen - np.polyval(line, number)
    scale = max(float(np.ptp(late)), 1e-12), max(float(np.ptp(number)), 1.0)
    points = np.column_stack([number / scale[1], late / scale[0]])
    edge = points[ConvexHull(points, qhull_options="QJ").vertices]
    # Least e with |late - slope number - offset| <= e at the corners of all.
    sides = np.column_stack([edge[:, 0], np.ones(len(edge))])
    bounds = np.hstack([np.vstack([-sides, sides]), -np.ones((2 * len(edge), 1))])
    limits = np.concatenate([-edge[:, 1], edge[:, 1]])
    found = linprog([0.0, 0.0, 1.0], A_ub=bounds, b_ub=limits, bounds=(None, None)).x
    line = line + found[:2] * [scale[0] / scale[1], scale[0]]
    return line, seen - np.polyval(line, number)


def _counted(seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (k,) of samples of which some are missing, first ``seen`` (k,) s, and the line
    through them.
    """
    low = int(np.argmin(sliding_window_view(np.diff(seen), WINDOW).max(axis=1)))
    high, number = low + WINDOW, np.arange(WINDOW + 1)
    while True:
        line = np.polyfit(number, seen[low : high + 1], 1)
        if len(number) == len(seen):
            return number, line
        more = high - low
        low, high = max(0, low - more), min(len(seen) - 1, high + more)
        number = np.rint((seen[low : high + 1] - line[1]) / line[0])
