"""A reference without the lag of the first-order low-pass filter behind which it was taken."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import attitude_at, attitude_curve, attitude_track
from pyimu.recording.reference.file import TRUTHS, at_log
from pyimu.recording.reference.nodes import own_samples

LAG = "reference_lag"
"""The finding of a reference that lagged."""

FILTERED = ("rate", "attitude")
"""Kinds of reference that a filter may have smoothed."""


def slope(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Rate of change of values (n, k) at ``time`` (n,) s, of cubic splines through them."""
    from scipy.interpolate import CubicSpline  # a tenth of a second, and few logs need it

    return CubicSpline(time, values)(time, 1) if len(time) > 3 else np.zeros_like(values)


def unlagged_rate(time: np.ndarray, rate: np.ndarray, lag: float, kind: str) -> np.ndarray:
    """What a filter of time constant ``lag`` s made the ``rate`` (n, 3) rad/s of, at ``time``.

    A rate was filtered axis by axis, w + lag w'. A quaternion q was, too: q + lag q' turns by
    lag w in the body, and the rate is that of both turns (the right Jacobian of SO(3) to second
    order, Sola et al. 2018, "A micro Lie theory", eq. 143).
    """
    change = slope(time, rate)
    quick = rate + lag * change
    return quick - lag**2 / 2 * np.cross(rate, change) if kind == "attitude" else quick


def unlagged(recording: Recording, lag: float) -> Recording:
    """The recording with the reference that went into a filter of time constant ``lag`` s: its
    ``ref_rate``, or its ``ref_q``.

    It has samples of its own from then on, so that a rate is used in the band alone in which the
    sensor shows it: above the filter's its noise is what the lag has made larger.
    """
    source = recording if recording.reference is None else recording.reference
    rate = source.ref_rate is not None
    quick = replace(source, ref_rate=_rate(source, lag)) if rate else _attitude(source, lag)
    found = Finding(LAG, "ref_rate" if rate else "ref_q", 1, {"time_constant": lag})
    return at_log(recording, replace(quick, findings=(*quick.findings, found)))


def _rate(source: Recording, lag: float) -> np.ndarray:
    out = np.array(source.ref_rate)
    known = np.isfinite(out).any(axis=0)
    seen = np.isfinite(out[:, known]).all(axis=1)
    for start, stop in source.segments:
        for a, b in runs(seen[start:stop]):
            rows = slice(start + a, start + b)
            rate = np.where(known, out[rows], 0.0)
            out[rows] = np.where(known, unlagged_rate(source.time[rows], rate, lag, "rate"), np.nan)
    return out


def _attitude(source: Recording, lag: float) -> Recording:
    """q + lag q' of a unit quaternion q turns it by 2 atan(lag |w| / 2) about w in the body.

    It has the samples that its rows were interpolated from, or the rows of what else the reference
    knows.
    """
    own = own_samples(source)
    quick = np.full_like(own.ref_q, np.nan)
    for nodes in attitude_track(own).segments:
        curve = attitude_curve(own, nodes)
        rate = curve(own.time[nodes], 1)
        speed = np.linalg.norm(rate, axis=1, keepdims=True)
        turn = rate * 2.0 * np.arctan(lag * speed / 2.0) / np.maximum(speed, 1e-300)
        turned = curve(own.time[nodes]) * Rotation.from_rotvec(turn)
        quick[nodes] = turned.as_quat(scalar_first=True)
    found = replace(own, ref_q=quick)
    alone = all(getattr(source, g) is None for g in TRUTHS if g != "ref_q")
    if own is source or alone:
        return found
    return replace(source, ref_q=attitude_at(found, source.time))
