"""Stamps coarser than the sample period, of rows that come evenly: each row gets a time of its own.

A clock of 20 ms, or of whole seconds, gives several rows one stamp, and so does a packet of
samples.
"""

from __future__ import annotations

from copy import copy

import numpy as np

from pyimu.recording.clock import GAP, runs

COARSE_STAMPS = 0.01
"""Above this share of rows with the time of the row before, the stamps are coarser than the sample
period."""

LEAST_STAMPS = 16
"""Stamps that tell a period: their first and last groups of rows may be cut, which is an eighth."""

HELD = 0.5
"""Share of the rows with the stamp of the row before that repeat a sensor's values, above which
they are no samples of their own: a sensor's row comes with each of its samples."""


class EvenTimes:
    """Gives rows of one stamp even times, row by row, whatever the pieces in which they come.

    With stamps that are cut to a ``unit`` [s], row k was sampled at its stamp or less than a unit
    later: a row is a ``period`` [s] after the one before, within that. So rows follow the clock of
    the stamps, over a gap too. All may be off by less than a unit together. A row for which a unit
    has no place left keeps the time of the row before. ``moved`` counts rows off the period by more
    than half of it, ``count`` those whose stamp is that of the row before.
    """

    def __init__(self, period: float, unit: float, start: float) -> None:
        """``start`` [s] is the time of the first row."""
        self.period, self.unit = period, unit
        self.count, self.moved = 0, 0
        self._stamp, self._time = -np.inf, start - period

    def add(self, stamps: np.ndarray) -> np.ndarray:
        """The times (n,) of rows with stamps (n,) that follow those that were added before."""
        before = np.append(self._stamp, stamps[:-1])
        self.count += int(np.count_nonzero(stamps == before))
        time, period, unit = self._time, self.period, self.unit
        out = []
        for stamp in stamps.tolist():
            due = time + period
            time = min(max(due, stamp), max(stamp + unit, time))
            self.moved += abs(time - due) > period / 2
            out.append(time)
        self._stamp, self._time = float(stamps[-1]), time
        return np.array(out)


def even_times(stamps: np.ndarray, held: np.ndarray) -> EvenTimes | None:
    """Even times for a log whose first rows have ``stamps`` (n,); None where its stamps are no
    coarser than its period, or its rows do not come evenly.

    ``held`` (n,) flags rows in which a sensor has the values of the row before.
    """
    again = np.append(False, np.diff(stamps) == 0)
    if len(stamps) < 2 or np.mean(again) <= COARSE_STAMPS or np.mean(held[again]) > HELD:
        return None
    first = np.flatnonzero(~again)
    step = np.diff(stamps[first])
    if len(step) < LEAST_STAMPS or not np.all(step > 0):
        return None
    unit = float(np.median(step))
    # Of the stamps between gaps, without the first of all: its rows may have been cut.
    start, stop = max(runs(step[1:] < GAP * unit), key=np.ptp, default=(0, 0))
    known = first[start + 1 : stop + 2]
    if len(known) < LEAST_STAMPS:
        return None
    period = float(np.polyfit(known - known[0], stamps[known] - stamps[known[0]], 1)[0])
    # No row came before its stamp: the first group may be cut, and its rows be the unit's last.
    rows = np.arange(first[LEAST_STAMPS])
    start = float(np.max(stamps[rows] - period * rows))
    found = EvenTimes(period, unit, min(start, float(stamps[0]) + unit))
    tried = copy(found)
    tried.add(stamps)
    return found if tried.moved <= COARSE_STAMPS * len(stamps) else None
