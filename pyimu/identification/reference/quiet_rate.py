"""The rate of a reference that was differentiated, above the band in which it is used.

Its noise grows with the frequency, and from row to row it may be as large as the motion. What is
not linear, as the size of a rate, a zone about zero or a product of rates, brings it down into the
band, where another effect or a step of something looks like it: what is above goes.

A body that shakes moves there, and what its reference lacks of that comes down, too, if by
hundredths: no window that is short enough shuts at once. Cameras that see such a motion with few
frames show it in part, or at another frequency, and what the axis turns by between two frames is
lost. There the gyro has the word, as it would look to them, and nothing is said of it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.band import BEYOND
from pyimu.identification.fit.inputs import copied, own_rate
from pyimu.identification.fit.interpolated import delayed
from pyimu.identification.fit.trial import MEASURED, Trial
from pyimu.identification.reference.turned import turn_of
from pyimu.model.kinds import OWN
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import rate_through, within
from pyimu.recording.reference.filters import below, below_hz, turned_by, turns_of
from pyimu.recording.reference.sampling import slope_at
from pyimu.recording.reference.track import LEAST_NODES

EDGE = 1.5
"""Times the band's edge from which on the gyro has the word: of what lies at the edge 99.8 % stays,
and beyond lie 3 % of the white noise that the band's window passes."""

ROOM = 4.0
"""Periods of that frequency at an end that a filter needs."""

BENT = 8
"""Attitudes at an end of a curve, which is another there where it does not go on: what one of fifth
degree is off by fades to 0.43 from one to the next."""

FEW = 1.5
"""Rows for each sample of an attitude from which on the curve through them shows a motion in part.
"""

SHOWN = 30.0
"""Times the density of what is left in the band that a motion must have above it: as much as is
left comes down then. A sensor that bends its signal moves above the band by less."""


def with_quiet_rate(trial: Trial) -> Trial:
    """The trial of a gyro with the rate of its reference low-passed above its band, and with the
    gyro's there where that shows a motion; as it is where the reference was not differentiated.
    """
    if trial.kind != "gyro" or trial.band_hz is None or trial.reference in MEASURED:
        return trial
    moved = _moved_above(trial)
    cutoff = (BEYOND if moved is None else EDGE) * trial.band_hz
    if cutoff >= 0.5 / trial.h:
        return trial
    if moved is None:
        return _with_rate(trial, trial.u[:, OWN["gyro"]], cutoff)
    seen, segments = _seen_by_few(trial, moved)
    trial, lacking = replace(trial, segments=segments), moved - seen
    above = moved - below_hz(moved, segments, trial.h, cutoff)
    return _with_rate(trial, trial.u[:, OWN["gyro"]] + lacking, cutoff, above)


def _with_rate(
    trial: Trial, rate: np.ndarray, cutoff: float, above: np.ndarray | float = 0.0
) -> Trial:
    """The trial with a reference's ``rate`` (n, 3) below a ``cutoff`` in Hz, and one ``above``."""
    u, own, slope = copied(trial.u), OWN[trial.kind], own_rate(trial.kind)
    u[:, own] = below_hz(rate, trial.segments, trial.h, cutoff) + above
    for a, b in trial.segments:
        if b - a > 1:
            u[a:b, slope] = np.gradient(u[a:b, own], trial.time[a:b], axis=0)
    return replace(trial, u=u, cutoff=cutoff)


def _moved_above(trial: Trial) -> np.ndarray | None:
    """What a gyro shows (n, 3), in the axes and on the clock of its reference, where a motion in an
    octave above the band stands out from what is left within; None where none does.
    """
    edge, most = EDGE * trial.band_hz, 0.5 / trial.h
    if edge >= most:
        return None
    moved = trial.y @ turn_of(trial)[0].T if trial.free_rotation else trial.y
    if trial.clock is not None and trial.clock.own:
        moved = delayed(moved, -trial.clock.own / trial.h)
    of_both = np.isin(np.arange(3), trial.axes)
    moved = np.where(of_both, moved, trial.u[:, OWN["gyro"]])
    left = _within(trial, moved - trial.u[:, OWN["gyro"]], 0.0, trial.band_hz)
    octaves = edge * 2.0 ** np.arange(int(np.ceil(np.log2(most / edge))))
    above = (_within(trial, moved, low, min(2.0 * low, most)) for low in octaves)
    return moved if any(density > SHOWN * left for density in above) else None


def _within(trial: Trial, values: np.ndarray, low: float, high: float) -> float:
    """Density, per Hz, of values (n, 3) of a trial between two frequencies [Hz], away from the ends
    of its segments, at which a filter lacks what goes on.
    """
    power, count, room = 0.0, 0, round(ROOM / (EDGE * trial.band_hz * trial.h))
    for a, b in trial.segments:
        if b - a > 3 * room:
            inside = values[a:b] - values[a:b].mean(axis=0)
            inside = inside - (below(inside, 2.0 * trial.h * low) if low else 0.0)
            kept = below(inside, 2.0 * trial.h * high)[room:-room]
            power, count = power + float(np.sum(kept**2)), count + len(kept)
    return power / max(count, 1) / (high - low)


def _seen_by_few(trial: Trial, moved: np.ndarray) -> tuple[np.ndarray, list[tuple[int, int]]]:
    """The rate (n, 3) of a curve through the attitudes of a body that ``moved`` as a gyro shows, at
    the times at which the reference was seen, and the segments where it is like the reference's; as
    it moved where that was seen as often as rows.
    """
    out, at, segments = np.array(moved), trial.seen_at, []
    if at is None or len(at) < LEAST_NODES or np.median(np.diff(at)) < FEW * trial.h:
        return out, trial.segments
    for a, b in trial.segments:
        time = trial.time[a:b]
        nodes = at[(at >= time[0]) & (at <= time[-1])]
        if len(nodes) < LEAST_NODES + 2 * BENT:
            continue
        seen = Recording.from_arrays(time=nodes, ref_q=_turned(moved[a:b], time, nodes))
        curve = rate_through(seen, np.arange(len(nodes)))
        rows = a + within(time, nodes)
        out[rows] = slope_at(trial.time[rows], curve, nodes, trial.h)
        first, last = within(time, nodes[BENT:-BENT])[[0, -1]]
        segments.append((a + int(first), a + int(last) + 1))
    return (out, segments) if segments else (np.array(moved), trial.segments)


def _turned(moved: np.ndarray, time: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Attitudes (m, 4) at times (m,) s of a body that ``moved`` (n, 3) rad/s at ``time`` (n,)."""
    h, row = float(np.median(np.diff(time))), np.interp(at, time, np.arange(len(time)))
    before, turns = row.astype(int), turns_of(moved)
    whole = Rotation.from_quat(turned_by(moved, h)[before], scalar_first=True)
    # Within a step its axis hardly turns.
    rest = Rotation.from_rotvec(h * (turns(row) - turns(before)))
    return (whole * rest).as_quat(scalar_first=True)
