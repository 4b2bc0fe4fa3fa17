"""A reference without the lag of the first-order low-pass filter behind which it was taken, also of
one that adapts.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording
from pyimu.recording.reference.adapting import Adapting
from pyimu.recording.reference.attitude import (
    attitude_at,
    attitude_curve,
    attitude_track,
    steps_of,
)
from pyimu.recording.reference.file import TRUTHS, at_log
from pyimu.recording.reference.nodes import own_samples
from pyimu.recording.reference.sampling import through

LAG = "reference_lag"
"""The finding of a reference that lagged."""

ADAPTS = "reference_adapts"
"""The finding of one that lagged less where it turned faster."""

HIGHEST = "highest_frequency"
"""The detail of a finding that says up to what frequency [Hz] a reference may be used."""

BEYOND, CUT_OFF, ORDER = 1.5, 2.0, 6
"""Times the frequencies of its motion up to which an attitude that lagged is used, and from which
on its lag stays; by a filter of this order run both ways, which takes 3 % of the slope there, and
0.02 % where it moves."""

SETTLED = 3.0
"""Periods of a filter's cut-off by which values are gone on with beyond their ends."""


def slope(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Rate of change of values (n, k) at ``time`` (n,) s, of cubic splines through them."""
    return through(time, values)(time, 1) if len(time) > 3 else np.zeros_like(values)


def unlagged(recording: Recording, lag: float | Adapting, motion: float = np.inf) -> Recording:
    """The recording with the reference that went into a filter of time constant ``lag`` s, or one
    that adapts: its ``ref_rate``, or its ``ref_q``, which moves at frequencies up to ``motion`` Hz.

    It has samples of its own from then on, so that a rate is used in the band alone in which the
    sensor shows it: above the filter's its noise is what the lag has made larger. Of an attitude
    that is left out: turns as quick as the noise of many samples do not add up, and the products of
    what is left over look like coning.
    """
    source = recording if recording.reference is None else recording.reference
    if source.ref_rate is not None:
        quick, group, more = replace(source, ref_rate=_rate(source, lag)), "ref_rate", {}
    else:
        quick, group, more = _attitude(source, lag, motion), "ref_q", {}
        if np.isfinite(motion):
            more = {HIGHEST: BEYOND * motion}
    if isinstance(lag, Adapting):
        kind, size = ADAPTS, {"time_constant": lag.size, "halves_at": lag.halves}
    else:
        kind, size = LAG, {"time_constant": lag}
    found = Finding(kind, group, 1, {**size, **more})
    return at_log(recording, replace(quick, findings=(*quick.findings, found)))


def _constants(lag: float | Adapting, rate: np.ndarray, h: float) -> np.ndarray | float:
    """Time constants (n, 1) s at a ``rate`` (n, 3) rad/s, ``h`` s apart; one that adapts to none is
    a number.
    """
    return lag.constants(rate, h)[:, None] if isinstance(lag, Adapting) else lag


def _rate(source: Recording, lag: float | Adapting) -> np.ndarray:
    out = np.array(source.ref_rate)
    known = np.isfinite(out).any(axis=0)
    seen = np.isfinite(out[:, known]).all(axis=1)
    for start, stop in source.segments:
        for a, b in runs(seen[start:stop]):
            rows = slice(start + a, start + b)
            rate = np.where(known, out[rows], 0.0)
            lags = _constants(lag, rate, source.sample_period)
            quick = rate + lags * slope(source.time[rows], rate)
            out[rows] = np.where(known, quick, np.nan)
    return out


def _attitude(source: Recording, lag: float | Adapting, motion: float) -> Recording:
    """q + lag q' of a unit quaternion q turns it by 2 atan(lag |w| / 2) about w in the body, as far
    as that is no quicker than ``motion`` Hz and some more.

    It has the samples that its rows were interpolated from, or the rows of what else the reference
    knows.
    """
    own = own_samples(source)
    quick = np.full_like(own.ref_q, np.nan)
    for nodes in attitude_track(own).segments:
        time, curve = own.time[nodes], attitude_curve(own, nodes)
        shown, h = curve(time), float(np.median(np.diff(time)))
        if isinstance(lag, Adapting) and lag.steps:
            # What it was shown, noise and all.
            lags = lag.constants_of(shown.as_quat(scalar_first=True), h)[:, None]
            rate = steps_of(own.ref_q, nodes) / np.diff(time)[:, None]
            turned = shown * Rotation.from_rotvec(lags * np.vstack([rate[:1], rate]))
        else:
            rate = _below(curve(time, 1), time, CUT_OFF * motion)
            speed, lags = np.linalg.norm(rate, axis=1, keepdims=True), _constants(lag, rate, h)
            turn = rate * 2.0 * np.arctan(lags * speed / 2.0) / np.maximum(speed, 1e-300)
            turned = shown * Rotation.from_rotvec(turn)
        quick[nodes] = turned.as_quat(scalar_first=True)
    found = replace(own, ref_q=quick)
    alone = all(getattr(source, g) is None for g in TRUTHS if g != "ref_q")
    if own is source or alone:
        return found
    return replace(source, ref_q=attitude_at(found, source.time))


def _below(values: np.ndarray, time: np.ndarray, cut_off: float) -> np.ndarray:
    """Values (n, k) at ``time`` (n,) s without what is above ``cut_off`` Hz, where they show it."""
    rate = (len(time) - 1) / (time[-1] - time[0])
    if not cut_off < 0.5 * rate:
        return values
    low = butter(ORDER, cut_off, fs=rate, output="sos")
    return sosfiltfilt(
        low, values, axis=0, padlen=min(len(values) - 1, int(SETTLED * rate / cut_off))
    )
