"""What a reference that was smoothed, or that its noise hides, cannot show above the frequencies
that can be restored, as the sensor shows it.

Of a body that moves as quickly that comes down into the band: in part through the band's window,
which no window that is short enough shuts at once, and of a force in the body's axes wherever the
body turns, as products of rates and forces. Where reference and sensor agree there by definition,
nothing is said of the sensor, and nothing false.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.inputs import copied, own_rate
from pyimu.identification.fit.trial import Trial, marked
from pyimu.identification.reference.place import at_the_point, with_force
from pyimu.identification.reference.turned import turn_of
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.recording.clock import GAP, runs
from pyimu.recording.gaps import gap_rows
from pyimu.recording.reference.filters import below, seen_as, turned_by
from pyimu.recording.reference.unfiltered_places import GROUPS
from pyimu.recording.reference.unsmoothed import SMOOTHED, TURNING, Smoothing

BENT = 9
"""Rows at an end of restored attitudes at which the curve through them may be off: what it is off
by fades by a quarter from row to row."""

LONGER = 1e-3
"""Share of a filter's size by which another is longer, whose difference is in proportion."""

TURNED = 3
"""Times that a mounting is found, beside what was found with the one before: what is lacking looks
like a turn of tenths of a degree, which leaves 2 % of itself."""

COLUMNS_OF_PLACES = frozenset(names[0] for names in GROUPS.values())


def with_sensor_above(trial: Trial) -> Trial:
    """The trial with the force that its places, once restored and freed of what is noise alone,
    still lack as its sensor shows it, less the rows near an end where nobody knows what they lack;
    as it is where they lack nothing.
    """
    smoothing, shown_hz = smoothing_of(trial, COLUMNS_OF_PLACES), trial.place.shown_hz
    if smoothing is None and shown_hz == np.inf:
        return trial
    reach = 0 if smoothing is None else smoothing.reach(trial.h)
    u, force, segments = copied(trial.u), at_the_point(trial), []
    for a, b in trial.segments:
        if b - a > 3 * reach:
            body = Rotation.from_quat(u[a:b, COLUMNS["attitude"]], scalar_first=True)
            world = body.apply(force[a:b])
            kept = world if smoothing is None else world - smoothing.lost(world, trial.h)
            lost = world - below(kept, 2.0 * trial.h * shown_hz)
            u[a:b, OWN[trial.kind]] += body.apply(lost, inverse=True)
            segments.append((a + reach, b - reach))
    return with_force(replace(trial, segments=segments), u) if segments else trial


def with_gyro_above(trial: Trial) -> Trial:
    """The trial with the rate that its reference, once restored, still lacks as the gyro shows it,
    less the rows near an end of the samples, where nobody knows what they lack; as it is where they
    lack nothing.

    What is left is then what the gyro's own motion, smoothed and restored alike, differs from the
    reference by.
    """
    smoothing = smoothing_of(trial, TURNING)
    if trial.kind != "gyro" or smoothing is None:
        return trial
    if not trial.free_rotation:
        return _completed(trial, smoothing, np.eye(3))
    whole = trial
    for _ in range(TURNED):
        whole = _completed(trial, smoothing, turn_of(whole)[0])
    return whole


def _completed(trial: Trial, smoothing: Smoothing, turn: np.ndarray) -> Trial:
    """The trial with what its reference lacks by a gyro whose axes are a ``turn`` (3, 3) off."""
    u, more, segments = copied(trial.u), np.zeros(trial.y.shape), []
    reach, axes = smoothing.reach(trial.h), list(trial.axes)
    for (a, b), (first, last) in _within_samples(trial, reach):
        inner, until = max(a + BENT, first + reach), min(b - BENT, last - reach)
        if until - inner <= reach:
            continue
        seen = trial.y[first:last] @ turn.T
        if trial.reference == "attitude":
            lost = _attitude_more(smoothing, seen, u[first:last, OWN["gyro"]], trial.h)
        else:
            lost = np.zeros(seen.shape)
            lost[:, axes] = smoothing.lost(seen[:, axes], trial.h)
        more[inner:until] = lost[inner - first : until - first]
        segments.append((inner, until))
    if not segments:
        return trial
    u[:, OWN["gyro"]] += more
    whole = replace(trial, u=u, segments=segments)
    u[:, own_rate("gyro")] += slopes(whole, more)
    return whole


def if_longer(trial: Trial, smoothing: Smoothing) -> np.ndarray:
    """What the reference of a trial, once restored, shows more (n, 3) of the motion that its gyro
    saw where the filter over it was longer than the ``smoothing`` that was taken out, for each
    share of its size; zero outside segments.
    """
    out = np.zeros(trial.y.shape)
    both = smoothing, replace(smoothing, size=(1.0 + LONGER) * smoothing.size)
    for (a, b), (first, last) in _within_samples(trial, smoothing.reach(trial.h)):
        seen, h = trial.y[first:last], trial.h
        if trial.reference == "attitude":
            body = turned_by(seen, h)
            kept = [smoothing.attitudes(one.smoothed(body, h), h) for one in both]
            short, long = (seen_as(q, body, seen, h) for q in kept)
        else:
            short, long = (smoothing.vectors(one.seen(seen, h, None), h) for one in both)
        out[a:b] = (long - short)[a - first : b - first] / LONGER
    return out


def _within_samples(trial: Trial, reach: int) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Each segment of a trial, and the rows up to ``reach`` beyond it that the sensor knows without
    a gap.
    """
    known = marked(trial.segments, len(trial.time))
    known |= True if trial.left_out is None else ~trial.left_out
    breaks = gap_rows(trial.time, trial.h, GAP * trial.h)
    edges = np.unique(np.concatenate([[0], *runs(known), breaks, [len(known)]])).astype(int)
    around = []
    for a, b in trial.segments:
        first = int(edges[np.searchsorted(edges, a, side="right") - 1])
        last = int(edges[np.searchsorted(edges, b, side="left")])
        around.append(((a, b), (max(first, a - reach), min(last, b + reach))))
    return around


def _attitude_more(
    smoothing: Smoothing, seen: np.ndarray, rate: np.ndarray, h: float
) -> np.ndarray:
    """What a ``rate`` (n, 3), of attitudes that were smoothed and restored, lacks of the one that
    was ``seen`` (n, 3), ``h`` s apart: both in the axes of what they are of, between which lie the
    turns that the smoothed attitudes have lost.
    """
    body = turned_by(seen, h)
    kept = smoothing.attitudes(smoothing.smoothed(body, h), h)
    lost = Rotation.from_quat(kept, scalar_first=True).inv() * Rotation.from_quat(
        body, scalar_first=True
    )
    left = rate - seen_as(kept, body, seen, h)
    return seen + lost.apply(left, inverse=True) - rate


def smoothing_of(trial: Trial, columns: frozenset[str]) -> Smoothing | None:
    """The smoothing of some ``columns`` of a trial's reference that was undone, if any was."""
    found = (f for f in trial.findings if f.kind == SMOOTHED and f.column in columns)
    return next((Smoothing.of_detail(f.detail) for f in found), None)
