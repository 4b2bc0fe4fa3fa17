"""The specific force of a body whose attitude and positions, or velocities, a reference saw.

They are differentiated by a spline of fifth degree through their own samples. Like that of an
attitude it adds no bandwidth of its own and stays inside each segment that was seen.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.recording.gravity import gravity_of
from pyimu.recording.quality.spikes import spikes
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import attitude_at, one_sign, within
from pyimu.recording.reference.band import trusted_band
from pyimu.recording.reference.course import SPIKE, looks_like_degrees
from pyimu.recording.reference.filters import below
from pyimu.recording.reference.nodes import own_places
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.reference.sampling import slope_at, through
from pyimu.recording.reference.shown import shown_up_to
from pyimu.recording.reference.track import LEAST_NODES, STEP_RATIO, Track, fresh
from pyimu.recording.reference.unsmoothed import restored_up_to
from pyimu.recording.reference.white_noise import white_noise

DEGREE = 5
"""Of the spline: the acceleration of its positions is one of the third."""

EDGE = 12
"""Samples at each end of a stretch where its acceleration is not used: there the noise of these is
some hundred times as large as within, and falls by 0.43 from each sample to the next: the root that
is nearest to one of z^4 + 26 z^3 + 66 z^2 + 26 z + 1, the equations of a quintic spline."""

ORDER = {"position": 2, "velocity": 1}
"""How often each is differentiated."""

EVEN = 1.25
"""Times the usual four periods that four may last without a gap in them."""


@dataclass(frozen=True, eq=False)
class Force:
    """The specific force ``value`` (n, 3) m/s^2 in body axes at n instants, NaN where unknown, of
    the point that the reference tracks.

    ``kind`` says what was differentiated, ``attitude`` (n, 4) is the body's, without jumps of sign,
    ``rate`` (n, 3) rad/s its rate; ``gravity`` m/s^2 was added, and is known to ``gravity_std``.
    ``band_hz`` is the highest frequency at which it is to be used, at most ``band_limit``; ``time``
    (n,) s are the instants where the sensor's stamps scatter about these. Above ``shown_hz`` what
    was differentiated shows no motion, and was left out.
    """

    value: np.ndarray
    kind: Literal["position", "velocity"]
    attitude: np.ndarray
    rate: np.ndarray
    gravity: float
    gravity_std: float
    band_hz: float
    band_limit: float
    findings: tuple[Finding, ...]
    time: np.ndarray | None
    shown_hz: float = np.inf


def reference_force(recording: Recording, latitude: float | None = None) -> Force | None:
    """The force that the reference of a recording says was there, f = R_nb^T (a + g); None where
    it has no attitude, or neither positions nor velocities on three axes, beside the
    accelerometer.

    It is that of the positions or of the velocities, whichever explains the accelerometer up to the
    higher frequency. ``latitude`` [rad] gives the size of gravity.
    """
    source = recording if recording.reference is None else recording.reference
    if recording.accel is None or not has_places(recording):
        return None
    seen = reference_rate(recording)
    time = recording.time if seen.time is None else seen.time
    q = one_sign(attitude_at(source, time))
    given = _given(source)
    made = [_of(kind, v, recording, source, time, q, seen, latitude) for kind, v in given]
    return max((f for f in made if f is not None), key=lambda f: f.band_hz, default=None)


def has_places(recording: Recording) -> bool:
    """Whether a recording has what a force follows from: an attitude, beside positions or
    velocities on three axes.
    """
    source = recording if recording.reference is None else recording.reference
    return source.ref_q is not None and any(True for _ in _given(source))


def _given(source: Recording) -> Iterator[tuple[str, np.ndarray]]:
    places = source.ref_east, source.ref_north, source.ref_up
    if all(p is not None for p in places) and not looks_like_degrees(source):
        seen = np.column_stack(places)
        if np.count_nonzero(np.isfinite(seen).all(axis=1)) >= LEAST_NODES:
            yield "position", seen
    if source.ref_velocity is not None:
        yield "velocity", source.ref_velocity


def _of(kind, values, recording, source, time, q, seen, latitude) -> Force | None:
    """The force from ``values`` (m, 3) of one kind; None where none of it is known."""
    row = recording.sample_period
    acceleration, track, shown = _acceleration(kind, values, source, time, row)
    gravity, unsure = gravity_of(recording, latitude)
    force = np.full((len(time), 3), np.nan)
    known = np.isfinite(acceleration).all(axis=1) & np.isfinite(q).all(axis=1)
    known &= np.isfinite(seen.rate).all(axis=1)
    if not known.any():
        return None
    attitude = Rotation.from_quat(q[known], scalar_first=True)
    force[known] = attitude.inv().apply(acceleration[known] + [0.0, 0.0, gravity])
    limit = min(0.25 / max(track.period, row), restored_up_to(recording.reference, places=True))
    arms = arm_forces(seen.rate, time)
    moved = np.column_stack([force, arms.reshape(len(time), -1)])
    band = trusted_band(time, _without_spikes(recording), moved, limit)
    found = tuple(track.findings)
    return Force(force, kind, q, seen.rate, gravity, unsure, band, limit, found, seen.time, shown)


def _without_spikes(recording: Recording) -> np.ndarray:
    accel = recording.accel
    return np.where(spikes(accel, recording.segments), np.nan, accel)


def arm_forces(rate: np.ndarray, time: np.ndarray) -> np.ndarray:
    """What a metre along each axis of a body adds to the specific force (n, 3, 3), [:, :, k] along
    axis k: alpha x e_k + omega x (omega x e_k) at rates (n, 3) rad/s.
    """
    w, acceleration = np.ascontiguousarray(rate.T), _slope(rate, time)
    made = w[:, None] * w  # omega x (omega x e_k) = omega omega_k - |omega|^2 e_k
    squared = np.trace(made)
    for k, (one, other) in enumerate(((1, 2), (2, 0), (0, 1))):
        made[k, k] -= squared
        made[k, one] += acceleration[:, other]
        made[k, other] -= acceleration[:, one]
    return made.transpose(2, 1, 0)


def _acceleration(
    kind: str, values: np.ndarray, source: Recording, time: np.ndarray, row: float
) -> tuple[np.ndarray, Track, float]:
    """Acceleration (n, 3) m/s^2 in the world at times (n,) of rows ``row`` s apart, the samples
    that it is from, and the frequency in Hz above which these show no motion.
    """
    from scipy.interpolate import make_interp_spline  # a tenth of a second, and few logs need it

    known = fresh(values)
    at, nodes = own_places(source.time[known], values[known])
    # Of what was smoothed hardly any change of a step opposes the one before, noise or motion.
    usual = np.quantile(np.linalg.norm(np.diff(nodes, 2, axis=0), axis=1), 0.9)
    spread = max(SPIKE * white_noise(nodes), STEP_RATIO * float(usual))
    rows = np.arange(len(at))
    track = Track(at, rows, lambda n: np.diff(nodes[n], axis=0), spread)
    parts = [p for p in track.segments if len(p) > 2 * EDGE]
    shown = shown_up_to([nodes[p] for p in parts], track.period, ORDER[kind])
    out = np.full((len(time), 3), np.nan)
    for part in parts:
        inner = at[part[EDGE:-EDGE]]
        here = within(time, inner)
        if len(here):
            curve = make_interp_spline(at[part], nodes[part], k=DEGREE)
            if shown < np.inf:
                pushed = below(curve(inner, ORDER[kind]), 2.0 * track.period * shown)
                curve = through(inner, pushed, DEGREE)
            out[here] = slope_at(
                time[here], curve, inner, row, 0 if shown < np.inf else ORDER[kind]
            )
    return out, track, shown


def _slope(values: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Rate of change (n, 3) of values by four neighbours, right to the fourth order of the period;
    by two beside a gap.
    """
    near = np.gradient(values, time, axis=0)
    if len(time) < 5:
        return near
    wide = time[4:] - time[:-4]
    far = (values[4:] - values[:-4]) / wide[:, None]
    whole = (wide < EVEN * np.median(wide)) & np.isfinite(far).all(axis=1)
    near[2:-2][whole] = ((4.0 * near[2:-2] - far) / 3.0)[whole]
    return near
