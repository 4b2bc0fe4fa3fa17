"""The filter behind which places are that a reference saw, from what the accelerometer shows.

What software lays over the attitudes of a body it lays over its positions, too, or over these
alone: the force that is made of them is damped then, and late behind a filter that works as it
records. The clock of a reference is that which the gyro shows beside its attitudes: what positions
lag beside these is the filter's.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.behind import (
    LEAST,
    QUICKEST,
    SLOWEST,
    Filter,
    Lag,
    likeliest,
)
from pyimu.identification.reference.clock import rebanded, shifted
from pyimu.identification.reference.judged_places import FARTHEST, TOGETHER, PlacesJudge
from pyimu.identification.reference.moving import in_own_band
from pyimu.identification.reference.place import headed
from pyimu.identification.reference.track import WANDERS
from pyimu.recording.recording import Recording, filled
from pyimu.recording.reference.filters import low_passed
from pyimu.recording.reference.unfiltered_places import (
    places_on_time,
    unlagged_places,
    unsmoothed_places,
)
from pyimu.recording.reference.unlagged import LAG
from pyimu.recording.reference.unsmoothed import CLEARLY, KINDS, SMOOTHED, Smoothing

STEP = 2.0
"""From cut-off to cut-off of those that are tried first."""

LEAST_EARLY = 0.5
"""Rows by which places are moved where no filter is seen: what counts samples is late by half a
sample at least, and less may be as well what a sensor's own parts are apart in time."""

QUICK = 16.0
"""Times the highest cut-off of Butterworth's filters that of others may be: these damp what is
slower by far, too, as what rings in a sensor raises it.
"""


@dataclass(frozen=True)
class Late(Lag):
    """A low-pass filter of first order with a time constant of ``size`` s, and its delay."""

    size: float

    def seen(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """As ``Filter.seen``; what a body has ``turned`` by makes no difference."""
        return low_passed(rate, self.size / h)


def without_filter_of_places(
    trial: Trial, recording: Recording, clock: Clock | None
) -> Callable[[Recording], Recording] | None:
    """What takes a filter out of the places of a trial's ``recording``; None where they are behind
    none. ``clock`` is that which the gyro shows beside the attitudes.
    """
    if recording.gyro is None or not np.isfinite(recording.gyro).any(axis=0).all():
        return None
    moved = trial if clock is None else shifted(trial, clock)
    if not moved.segments:
        return None
    seen = in_own_band(headed(rebanded(moved)))
    judged = partial(PlacesJudge, rate=filled(recording.time, recording.gyro))
    found = likeliest(
        seen, _kinds(trial.h), lambda f: _half_variance(f) < LEAST, judged, _most_on_time
    )
    found = _shared(seen, recording, judged, found) or found
    if found is None:
        return _on_time(judged(seen, [TOGETHER]), trial.reference)
    # A filter that counts each sample when it comes is early by half a sample, one that averages
    # the last of them late by half of these.
    judge = judged(seen, [found])
    explained = 0.5 * (judge.left(None) - judge.left(found))
    known = {"kind": trial.reference, "early": judge.lead(found), "explained": explained}
    if isinstance(found, Lag):
        return partial(unlagged_places, lag=found.size, **known)
    return partial(unsmoothed_places, smoothing=found, **known)


def _shared(
    seen: Trial,
    recording: Recording,
    judged: Callable[..., PlacesJudge],
    found: Filter | None,
) -> Filter | None:
    """The filter that was taken out of the attitudes of a ``recording``, where places are rather
    behind it than behind none, and as likely as behind the one that was ``found`` among many: what
    goes over all that cameras saw is the commonest there is.
    """
    findings = () if recording.reference is None else recording.reference.findings
    filters = [_filter_of(f) for f in findings if f.column == "ref_q" and f.kind in (LAG, SMOOTHED)]
    for one in filters:
        judge = judged(seen, [one] if found is None else [one, found])
        if not judge.any_short or judge.gain(one) < 2.0 * WANDERS:
            continue
        if found is None or judge.left(one) - judge.left(found) < 2.0 * WANDERS:
            return one
    return None


def _filter_of(finding: Finding) -> Filter:
    """The filter that a finding is about."""
    if finding.kind == LAG:
        return Late(float(finding.detail["time_constant"]))
    return Smoothing.of_detail(finding.detail)


def _most_on_time(judge: PlacesJudge, alike: list[Filter]) -> Filter:
    """Of filters that say as much the one with whose delay places need the least clock of their
    own.
    """
    return min(alike, key=lambda one: abs(judge.lead(one)))


def _on_time(judge: PlacesJudge, kind: str) -> Callable[[Recording], Recording] | None:
    """What puts places right that are late, or early, and behind no filter that is seen; None where
    they are neither.
    """
    if not judge.any_short or judge.left(TOGETHER) - judge.left(None) < 2.0 * WANDERS:
        return None
    early = judge.lead(None)
    if not LEAST_EARLY * judge.whole.h < abs(early) < FARTHEST:
        return None
    explained = 0.5 * (judge.left(TOGETHER) - judge.left(None))
    return partial(places_on_time, kind=kind, early=early, explained=explained)


def _kinds(h: float) -> list[tuple[Callable[..., Filter], list[float]]]:
    """Filters with sizes to begin with, rising, by the frequencies of which ``CLEARLY`` passes."""

    def sizes(clear: float, quickest: float) -> list[float]:
        count = int(np.log(quickest / (h * SLOWEST)) / np.log(STEP)) + 1
        return [float(clear * h / quickest * STEP**k) for k in range(count)]

    late = np.sqrt(CLEARLY**-2 - 1.0) / (2.0 * np.pi)
    smooth = [
        (partial(Smoothing, name), sizes(kind.clear, QUICKEST * (QUICK if kind.variance else 1.0)))
        for name, kind in KINDS.items()
    ]
    return [(Late, sizes(late, QUICK * QUICKEST)), *smooth]


def _half_variance(one: Filter) -> float:
    """By which its gain falls with the square of the frequency, in s^2."""
    return 0.5 * one.size**2 * (KINDS[one.kind].variance if isinstance(one, Smoothing) else 1.0)
