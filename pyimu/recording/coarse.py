"""Stamps coarser than the sample period, of rows that come evenly: each row gets a time of its own.

A clock of 20 ms, or of whole seconds, gives several rows one stamp, and so does a packet of
samples. A bus hands over several at once, and who stamps them as they are read gives them stamps
that follow close on one another, long after the burst before.
"""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.clock import GAP, runs
from pyimu.recording.recording import Recording

COARSE_STAMPS = 0.01
"""Above this share of rows with the time of the row before, the stamps are coarser than the sample
period."""

LEAST_STAMPS = 16
"""Stamps that tell a period: their first and last groups of rows may be cut, which is an eighth."""

HELD = 0.5
"""Share of the rows with the stamp of the row before that repeat a sensor's values, above which
they are no samples of their own: a sensor's row comes with each of its samples."""

CLOSE, FAR = 0.25, 0.98
"""Quantiles of the steps of time by which bursts are known: the one lies within them, the other
between them, of 2 to 50 rows each."""

APART = 5.0
"""The steps between bursts are so many times those within them at least."""

WAITS = 2.0
"""Times the scatter of the stamps of bursts about a line, within which all of a log lie."""

REGULAR = 0.9
"""Share of the bursts whose sizes are alike, but for a row: one polls evenly."""

COARSE = "coarse_stamps"
"""The finding of stamps that several rows share."""

IN_BURSTS = "of rows that come in bursts"


class EvenTimes:
    """Gives rows of one stamp even times, row by row, whatever the pieces in which they come.

    With stamps that are cut to a ``unit`` [s], row k was sampled at its stamp or less than a unit
    later: a row is a ``period`` [s] after the one before, within that. So rows follow the clock of
    the stamps, over a gap too. All may be off by less than a unit together. A row for which a unit
    has no place left keeps the time of the row before. ``moved`` counts rows off the period by more
    than half of it, ``count`` those whose stamp is that of the row before.

    Rows of a burst, at most ``within`` [s] apart, were all sampled before the first of them was
    read, a unit being from burst to burst, and at most ``wait`` [s] before that.
    """

    def __init__(
        self, period: float, unit: float, start: float, within: float = 0.0, wait: float = 0.0
    ) -> None:
        """``start`` [s] is the time of the first row."""
        self.period, self.unit, self.within, self.wait = period, unit, within, wait
        self.count, self.moved = 0, 0
        self._read, self._first, self._place = -np.inf, -np.inf, 0
        self._time = start - period

    def add(self, stamps: np.ndarray) -> np.ndarray:
        """The times (n,) of rows with stamps (n,) that follow those that were added before."""
        again = np.diff(stamps, prepend=self._read) <= self.within
        self.count += int(np.count_nonzero(again))
        self._read = float(stamps[-1])
        time, period = self._time, self.period
        out = []
        for low, high in zip(*(limit.tolist() for limit in self._limits(stamps, again))):
            due = time + period
            time = min(max(due, low), max(high, time))
            self.moved += abs(time - due) > period / 2
            out.append(time)
        self._time = time
        return np.array(out)

    def _limits(self, stamps: np.ndarray, again: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The earliest and the latest times (n,) of rows, those ``again`` (n,) being of the stamp
        or the burst of the row before.
        """
        row = np.arange(len(stamps))
        first = np.maximum.accumulate(np.where(again, -1, row))
        stamp = np.where(first < 0, self._first, stamps[first])
        place = np.where(first < 0, self._place + 1 + row, row - first)
        self._first, self._place = float(stamp[-1]), int(place[-1])
        if not self.within:
            return stamp, stamp + self.unit
        latest = stamp - self.unit + self.period * (1 + place)
        return latest - self.wait, latest

    def finding(self, **more: str) -> Finding:
        """That rows were spread over their stamps, with ``more`` about these."""
        detail = {"unit": self.unit, "period": self.period}
        bursts = {"stamps": IN_BURSTS} if self.within else {}
        return Finding(COARSE, "time", self.count, detail | bursts | more)


def came_in_bursts(finding: Finding) -> bool:
    """Whether a finding says that the rows of a log were stamped as a bus handed them over."""
    return finding.kind == COARSE and finding.detail.get("stamps") == IN_BURSTS


def _within(stamps: np.ndarray) -> float:
    """s; the longest step of time within bursts in which rows come; 0 where they come otherwise."""
    step = np.diff(stamps)
    if len(step) < LEAST_STAMPS:
        return 0.0
    close, far = np.quantile(step, (CLOSE, FAR))
    if close == 0.0 or far < APART * close:
        return 0.0
    within = float(np.sqrt(close * far))
    size = np.diff(np.flatnonzero(step > within))
    usual = np.median(size) if len(size) else 1.0
    alike = len(size) > 0 and np.mean(np.abs(size - usual) <= 1.0) >= REGULAR
    return within if alike and usual >= 2.0 else 0.0


def even_times(stamps: np.ndarray, held: np.ndarray) -> EvenTimes | None:
    """Even times for a log whose first rows have ``stamps`` (n,); None where its stamps are no
    coarser than its period, or its rows do not come evenly.

    ``held`` (n,) flags rows in which a sensor has the values of the row before.
    """
    within = _within(stamps)
    again = np.append(False, np.diff(stamps) <= within)
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
    late = stamps[first] - period * first
    if within:
        line = stamps[known] - period * known
        start = float(late[:LEAST_STAMPS].min()) - unit + period
        found = EvenTimes(period, unit, start, within, min(WAITS * float(np.ptp(line)), unit))
    else:
        # No row came before its stamp: the first group may be cut, and its rows be the unit's last.
        start = float(late[:LEAST_STAMPS].max())
        found = EvenTimes(period, unit, min(start, float(stamps[0]) + unit))
    tried = copy(found)
    tried.add(stamps)
    return found if tried.moved <= COARSE_STAMPS * len(stamps) else None


def evened(recording: Recording) -> Recording:
    """The recording at even times, with the finding ``coarse_stamps``, where its rows come in
    bursts; else as it is.
    """
    even = even_times(recording.time, np.zeros(len(recording), dtype=bool))
    if even is None:
        return recording
    time = even.add(recording.time)
    kept = np.append(True, np.diff(time) > 0)
    groups = {name: values[kept] for name, values in recording.groups.items()}
    findings = (*recording.findings, even.finding())
    return replace(recording, time=time[kept], findings=findings, **groups)
