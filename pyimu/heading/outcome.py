"""What the methods made of the logs: each one's heading, and its error."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from pyimu.display.brief import Brief
from pyimu.heading.calibration import Calibration
from pyimu.heading.filter import HeadingTrack
from pyimu.heading.statistics import Statistics, paired
from pyimu.heading.transfer import RateTransfer
from pyimu.recording.recording import Recording


@dataclass(frozen=True, eq=False, repr=False)
class Track(Brief):
    """A method's ``heading`` rad at the rows (n,) of a log after its known motion, and its
    ``error`` rad against the reference (NaN where that is missing), None without one.
    """

    name: str
    time: np.ndarray
    heading: np.ndarray
    error: np.ndarray | None
    calibration: Calibration | None = None
    filter: HeadingTrack | None = None

    @property
    def last_error(self) -> float:
        """Error in rad at the last row that has a reference; NaN without one."""
        if self.error is None:
            return float("nan")
        known = self.error[np.isfinite(self.error)]
        return float(known[-1]) if len(known) else float("nan")


@dataclass(frozen=True, eq=False, repr=False)
class Method(Brief):
    """A method by ``name`` and in ``words``, and its track over each log."""

    name: str
    words: str
    tracks: tuple[Track, ...]

    @property
    def errors(self) -> np.ndarray:
        """Heading errors in rad at the ends of the logs that have a reference there."""
        errors = np.array([t.last_error for t in self.tracks])
        return errors[np.isfinite(errors)]

    @property
    def statistics(self) -> Statistics:
        return Statistics.of(self.errors)

    @property
    def within(self) -> float:
        """RMS error in rad over all rows of all logs; NaN without a reference."""
        every = [t.error[np.isfinite(t.error)] for t in self.tracks if t.error is not None]
        rows = np.concatenate(every) if every else np.zeros(0)
        return float(np.sqrt(np.mean(rows**2))) if len(rows) else float("nan")


@dataclass(frozen=True, eq=False)
class Outcome:
    """What ``pyimu.heading.run`` found in ``recordings``, by each of the ``methods``.

    ``notes`` are what its reader should know, ``settings`` what was asked for, ``transfer`` the
    rate transfer where a log is one of a rate table.
    """

    recordings: tuple[Recording, ...]
    methods: tuple[Method, ...]
    notes: tuple[str, ...]
    settings: dict[str, Any]
    transfer: RateTransfer | None = None

    def __getitem__(self, name: str) -> Method:
        return next(m for m in self.methods if m.name == name)

    @property
    def differences(self) -> dict[tuple[str, str], Statistics]:
        """Paired differences of the errors of two methods on the same logs."""
        pairs = combinations(self.methods, 2) if len(self.recordings) > 1 else ()
        return {(a.name, b.name): paired(a.errors, b.errors) for a, b in pairs if len(a.errors)}
