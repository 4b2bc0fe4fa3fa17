"""The noise of each axis: what a part declares of it, and what a residual shows."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import Linear, in_band
from pyimu.identification.fit.filters import Segments
from pyimu.identification.fit.normal import Noise
from pyimu.identification.fit.reduction import Unit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk
from pyimu.model.catalogue import WALK, WHITE
from pyimu.model.kinds import KINDS
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

LEAST_ROWS = 50
"""Rows for each column of motion that is taken out of a residual: with fewer, noise would go with
it."""

HALF_WAVES = 8
"""Of a cosine over the time of a log that are taken out of a residual before its noise is fitted.
A step of any place keeps a fortieth of its power beside so many (2 / pi^2 / 8)."""

SPANS = 2
"""Memories of an autoregression over which a level is taken out of a residual: over one, of the
noise that it predicts hardly any would be left, and of a step the share of a single span stays."""

MOSTLY_NOISE = 0.5
"""Share of an axis' own rate in a residual from which on it is taken for the noise of the
reference, which is in both, where an axis stands all of it: no scale factor is wrong by so much.
"""

BY_NOISE = 10.0
"""Times as much as the noise in the motion itself may take out of a residual that the motion must
take, where it is more than noise."""


def declared_variances(sensor: Sensor, h: float) -> tuple[np.ndarray, np.ndarray]:
    """Variance (3,) of a sample's white noise, and of the random walk in a second; zero where the
    sensor declares none.
    """
    white, walk = (
        np.asarray(sensor.values[effect][parameter]) if effect in sensor.values else np.zeros(3)
        for effect, parameter in (WHITE, WALK)
    )
    return white**2 / h, walk**2


def fit_noise(
    trials: tuple[Trial, ...],
    residuals: list[Linear],
    coloured: bool = False,
    whole: Collection[int] = (),
) -> Noise:
    """Noise model of each axis, one for all logs: the whitening follows what the reference is. The
    residual of the axes ``whole`` is taken as it stands, motion and all.
    """
    if any(t.reduction is not None for t in trials):
        return {0: Unit()}
    coloured |= any(t.band_hz is not None for t in trials)
    made = {}
    for i in sorted({i for t in trials for i in t.axes}):
        axis = [(t, one) for t, one in zip(trials, residuals, strict=True) if i in one.keys]
        if coloured:
            made[i] = _autoregression(axis, i, i in whole)
        else:
            made[i] = RandomWalk.fit(
                [(one.residual[:, i], one.time, one.segments) for _, one in axis]
            )
    return made


def less_levels(residuals: list[Linear], noise: Noise) -> Noise:
    """A ``noise`` whose autoregressions predict nothing that is slow: each is that of its axis'
    residual less the means over spans of a few memories.

    A step is what its past predicts, but for one row: an autoregression that was fitted to it
    whitens it away, and makes the noise of means so large that nothing slow counts beside it.
    """
    return {
        i: _less_levels(residuals, i, n) if isinstance(n, Autoregressive) else n
        for i, n in noise.items()
    }


def _less_levels(residuals: list[Linear], axis: int, noise: Autoregressive) -> Autoregressive:
    order = len(noise.coefficients)
    if not order or noise.theta:
        return noise
    parts = [
        (_less_means(one.residual[:, axis], one.segments, SPANS * order), one.time, one.segments)
        for one in residuals
        if axis in one.keys
    ]
    found = Autoregressive.fit(parts, order)
    if found.slow.r >= noise.slow.r:
        return noise
    return replace(found, beside_motion=noise.beside_motion, k2=noise.k2, before=noise.before)


def _less_means(left: np.ndarray, segments: Segments, span: int) -> np.ndarray:
    """A residual (m,) less its means over ``span`` rows, or up to twice as many, of a segment."""
    out = np.array(left)
    for a, b in segments:
        for piece in np.array_split(out[a:b], max(1, (b - a) // span)):
            piece -= piece.mean() if len(piece) else 0.0
    return out


def _autoregression(rows: list[tuple[Trial, Linear]], axis: int, whole: bool) -> Autoregressive:
    """The autoregression of an axis' residual, ``whole`` or less the motion in it, and less what
    goes with time and temperature.
    """
    parts, slow, less = [], [], False
    for trial, one in rows:
        left = one.residual[:, axis]
        noise = left if whole else _beside_motion(trial, axis, left)
        parts.append((_beside_slow(trial, one.time, noise), one.time, one.segments))
        slow.append((noise, one.time, one.segments))
        less |= noise is not left
    least = None
    if all(t.differs for t, _ in rows):
        least = (HALF_WAVES / 2 + 1) / max(1, min(len(one.time) for _, one in rows))
    found = replace(Autoregressive.fit(parts, least=least), beside_motion=less)
    errors = []
    for noise, time, segments in slow:
        seen = found.predicted(len(time), segments)
        if seen.any():
            white = found.whiten(noise[:, None], time, segments)[seen, 0]
            errors.append((white, time[seen], [(0, len(white))]))
    walk = RandomWalk.fit(errors)
    return replace(found, k2=walk.k2 / walk.r * found.slow.r)


def _beside_slow(trial: Trial, time: np.ndarray, left: np.ndarray) -> np.ndarray:
    """The residual ``left`` (m,) of an axis at ``time`` (m,), less a ramp and a line in the
    temperature, and beside a differentiated reference what a few half waves say of it.

    A slow error is what its past predicts, too: it would be whitened away, and its cause with it.
    Of a bias that walks the most is left, which is still predicted.
    """
    columns = [np.ones(len(time)), time - time.mean()]
    if "temperature" in trial.known:
        columns.append(in_band(trial, trial.u[:, COLUMNS["temperature"]])[:, 0])
    if trial.differs and len(left) >= LEAST_ROWS * (len(columns) + HALF_WAVES):
        through = np.pi * (time - time[0]) / (time[-1] - time[0])
        columns += [np.cos(k * through) for k in range(1, HALF_WAVES + 1)]
    if len(left) < LEAST_ROWS * len(columns):
        return left
    slow = np.column_stack(columns)
    return left - slow @ np.linalg.lstsq(slow, left)[0]


def _beside_motion(trial: Trial, axis: int, left: np.ndarray) -> np.ndarray:
    """The residual ``left`` (m,) of an axis, without what gains, axes and a delay that are not
    right yet make of the motion, where it is more than the reference's noise makes of it.

    A motion that repeats is what its past predicts: an autoregression would take that for noise,
    and whiten the motion away with it. The reference's own noise is in the residual and in the
    motion, and takes of the residual the share that it is of the motion: all, where an axis stands.
    """
    own = KINDS[trial.kind].own, KINDS[trial.kind].own_rate
    motion = in_band(trial, np.hstack([trial.u[:, COLUMNS[name]] for name in own]))
    if len(left) < LEAST_ROWS * (motion.shape[1] + 1):
        return left
    beside, gains = _less(left, motion)
    if gains[axis] < -MOSTLY_NOISE:
        motion[:, axis] = 0.0
        beside, _ = _less(left, motion)
    taken = 1.0 - float(beside @ beside) / max(float(left @ left), 1e-300)
    return beside if taken > BY_NOISE * _shared(trial, beside, motion) else left


def _less(left: np.ndarray, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A residual ``left`` (m,) less a constant and what goes with columns (m, c) of ``motion``, and
    the gains (c,) of these.
    """
    columns = np.column_stack([motion, np.ones(len(motion))])
    gains = np.linalg.lstsq(columns, left)[0]
    return left - columns @ gains, gains[:-1]


def _shared(trial: Trial, noise: np.ndarray, motion: np.ndarray) -> float:
    """Share of ``noise`` (m,) that a ``motion`` (m, 6), rates and their slopes, takes out of it
    where its own noise is as large.
    """
    step = trial.h * trial.band.stride
    powers = np.repeat([np.var(noise), np.var(np.diff(noise)) / step**2], 3)
    seen = np.var(motion, axis=0)
    moves = seen > 0.0
    return float(np.sum(powers[moves] / seen[moves]))
