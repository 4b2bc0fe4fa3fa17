"""The start of a log that begins in motion, by its first two minutes at once.

Turned along by the gyro, the mean forces of some seconds each point upwards, but for what pushed
the body meanwhile. Attitude and bias of the first sample follow by least squares over all of them,
with the gyro's scale factors as further unknowns, and how large the pushes are by what is left: a
boat in waves, which go to and fro, is told from a car in bends, and neither has to rest. How the
pushes are to be weighed follows from the likelihood of what is left, in which the unknowns have no
part (Patterson and Thompson 1971, restricted maximum likelihood).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import cho_factor, cho_solve, eigh
from scipy.spatial.transform import Rotation

from pyimu.display.brief import Brief
from pyimu.recording.integration import integrated
from pyimu.recording.recording import Recording

LONGEST = 120.0
"""s; more of a log is not looked at. The longer, the better is the start of an aircraft, but the
bias of a real gyro does not stay."""

LENGTH, FEWEST = 15.0, 3
"""s; over which forces are averaged, and how many means there are at least: of a short log they are
over less. With 10 s starts of cars and of drones that circle are 1.2 and 1.6 times as far off, with
20 s that of a hand. Chosen, as what follows, with the even ones of the seeds 0 to 18 of bodies that
are alike to ``drives/starts.py`` of the benchmarks."""

SHORTER = 3
"""Into how many spans each of these is parted to see how large pushes are: a drone that circles
goes all round in one of them."""

FINEST = 0.005
"""s; of faster logs the samples are averaged over so long."""

MISSING = 0.05
"""Share of the gyro's samples without which the force is not turned along."""

GAP = 0.2
"""s; rows that are missing for longer end what is looked at: nobody knows how the body turned."""

TILT_STD = 0.5
"""rad; of the tilt of the mean force, before that of any part of it is compared."""

BIAS_STD = 0.01
"""rad/s; of the bias of a gyro that was not seen at rest."""

SCALE_STD, RATE_NOISE = 0.02, 1.6e-3
"""1, sqrt(s); scale factors of a gyro of which nothing is known, and what else its errors make of
an angle: what the settings ``scale_std`` and ``rate_noise`` are at most."""

PUSH_STD, DRAWN = 0.335, 2.0
"""m/s^2; of an axis of the pushes of a body of which nothing is known, and how many numbers that
were drawn of them would say as much."""

LASTS = 10.0
"""s; correlation time of a push, as the filter takes it (``long_push.LASTS``)."""

PUSHES, VELOCITIES = np.geomspace(0.01, 6.0, 40), np.geomspace(0.5, 40.0, 14)
"""m/s^2, m/s; standard deviations of an axis of pushes that last, and of the velocity with which a
mean begins and ends, that are compared: of a hand or an aircraft."""

TWICE = 2.0
"""Factor on the standard deviations of what the filter will take from the same rows once more: of
that information a quarter counts twice."""

PASSES = 3
"""Times that the force is turned along, each with the bias that was found before."""


@dataclass(frozen=True, repr=False)
class Underway(Brief):
    """What the first ``duration`` s show of the first sample.

    The mean ``force`` (3,) m/s^2 upwards in body axes with the standard deviation ``tilt_std`` rad
    of its direction, the gyro's ``bias`` (3,) and the standard deviation ``bias_std`` (3,) in
    rad/s, and ``push_std`` m/s^2 of an axis of the pushes that last.
    """

    duration: float
    force: np.ndarray
    tilt_std: float
    bias: np.ndarray
    bias_std: np.ndarray
    push_std: float


@dataclass(frozen=True)
class Means:
    """Means over one span after another.

    ``force`` (k, 3) m/s^2 in axes of the first sample, how many rad these turn there by ``bias``
    (k, 3, 3) and by ``scale`` (k, 3, 3) of the gyro's axes, and the ``angle`` (k,) rad^2/s, the
    integral of the squared rate.
    """

    force: np.ndarray
    bias: np.ndarray
    scale: np.ndarray
    angle: np.ndarray

    @classmethod
    def of(cls, rate: np.ndarray, force: np.ndarray, period: float, count: int) -> Means:
        """Over ``count`` spans of rates (n, 3) rad/s and forces (n, 3) m/s^2, NaN where there is
        none.
        """
        axes = integrated(rate, period, Rotation.identity()).as_matrix()
        turned = np.einsum("nij,nj->ni", axes, force)
        off = (-period * np.cumsum(by, axis=0) for by in (axes, axes * rate[:, None, :]))
        angle = np.sum(rate**2, axis=1) * (period * len(rate) / count)
        spans = (
            [np.nanmean(p, axis=0) for p in np.array_split(v, count)] for v in (turned, *off, angle)
        )
        return cls(*(np.array(v) for v in spans))

    def longer(self) -> Means:
        """The same over ``SHORTER`` spans each."""
        parts = (v.reshape(-1, SHORTER, *v.shape[1:]) for v in vars(self).values())
        whole = Means(*(v.mean(axis=1) for v in parts))
        return replace(whole, angle=SHORTER * whole.angle)


def underway(recording: Recording) -> Underway | None:
    """The start of a recording that begins in motion; None where gyro or force are missing."""
    samples = _samples(recording)
    if samples is None:
        return None
    rate, force, period = samples
    count = max(FEWEST, int(len(rate) * period / LENGTH))
    if any(np.isnan(p).all() for p in np.array_split(force[:, 0], SHORTER * count)):
        return None
    up, bias, found = None, np.zeros(3), None
    for _ in range(PASSES):
        means = Means.of(rate - bias, force, period, SHORTER * count)
        mean = means.force.mean(axis=0)
        if not mean.any():
            return None
        found = _fitted(means, mean if up is None else up, bias, len(rate) * period / count)
        up, bias = found.force, found.bias
    return found


def _samples(recording: Recording) -> tuple[np.ndarray, np.ndarray, float] | None:
    """The rates (n, 3) and forces (n, 3) of the start, one a period in s; None without these.

    A rate that is missing is none; a force that is missing is NaN. Where rows are missing for no
    more than ``GAP`` the rate after them is that of the whole time.
    """
    if recording.gyro is None or recording.accel is None:
        return None
    stop = int(np.searchsorted(recording.time, recording.time[0] + LONGEST))
    many = max(1, int(FINEST / recording.sample_period))
    lasts = np.ones((len(recording.time), 1))
    for start, _ in recording.segments[1:]:
        gap = recording.time[start] - recording.time[start - 1]
        stop = min(stop, start) if gap > GAP else stop
        lasts[start] = gap / recording.sample_period
    rate, force = recording.gyro[:stop], recording.accel[:stop]
    known, shown = (np.isfinite(v).all(axis=1, keepdims=True) for v in (rate, force))
    n = stop // many
    if np.mean(~known) > MISSING or n < FEWEST * SHORTER:
        return None
    rate, force = np.where(known, lasts[:stop] * rate, 0.0), np.where(shown, force, np.nan)
    parts = (v[: n * many].reshape(n, many, 3).mean(axis=1) for v in (rate, force))
    return *parts, many * recording.sample_period


def _fitted(short: Means, up: np.ndarray, bias: np.ndarray, span: float) -> Underway:
    """The start by the means, in axes that are about level where ``up`` (3,) is upwards; ``bias``
    (3,) rad/s was taken off the rates, and ``SHORTER`` of the means are over ``span`` s.
    """
    means = short.longer()
    size, level = float(np.linalg.norm(means.force.mean(axis=0))), np.linalg.svd(up[None])[2][1:]
    up = up / np.linalg.norm(up)
    design = _design(means, size, level, up)
    prior = np.diag(np.repeat([TILT_STD, BIAS_STD, SCALE_STD], [2, 3, 3]) ** 2)
    expected = np.concatenate([np.zeros(2), -bias, np.zeros(3)])
    left = (means.force @ level.T).ravel() - design @ expected
    known = np.kron(size**2 * _walk(means.angle), np.eye(2)) + design @ prior @ design.T
    whole = cho_factor(known + _pushed(known, left, span))
    weight = cho_solve(whole, design @ prior).T
    at = expected + weight @ left
    variance = np.diag(prior - weight @ design @ prior)
    fine = _design(short, size, level, up)
    pushes = (short.force @ level.T).ravel() - fine @ at
    gyro = np.kron(size**2 * _walk(short.angle), np.eye(2))
    tilted = up + level.T @ at[:2]
    return Underway(
        len(means.force) * span,
        size * tilted / np.linalg.norm(tilted),
        float(np.sqrt(np.mean(variance[:2]))),
        bias + at[2:5],
        np.sqrt(variance[2:5]),
        _push_std(pushes, fine @ weight, gyro),
    )


def _push_std(pushes: np.ndarray, fitted: np.ndarray, gyro: np.ndarray) -> float:
    """m/s^2; of the ``pushes`` (2 m,) that the fit has left of the shorter means, less what the
    errors of the gyro, of the covariance ``gyro``, are expected to leave there.

    The fit took ``fitted`` (2 m, 2 k) times the longer means.
    """
    count, n = fitted.shape[1] // 2, len(pushes)
    longer = np.kron(np.eye(count), np.full((1, SHORTER), 1 / SHORTER))
    leaves = np.eye(n) - fitted @ np.kron(longer, np.eye(2))
    square = max(pushes @ pushes - np.sum((leaves @ gyro) * leaves), 0.0)
    return float(np.sqrt((square + DRAWN * PUSH_STD**2) / (n + DRAWN)))


def _design(means: Means, size: float, level: np.ndarray, up: np.ndarray) -> np.ndarray:
    """How the means along ``level`` (2, 3) change by the tilt (2,) in rad, the bias (3,) and the
    scale factors (3,): (2 k, 8). Gravity of ``size`` m/s^2 turns with the axes, g up x angle.
    """
    across = size * level @ np.cross(up, np.eye(3)).T
    tilt = np.broadcast_to(size * np.eye(2), (len(means.force), 2, 2))
    parts = tilt, across @ means.bias, across @ means.scale
    return np.concatenate(parts, axis=2).reshape(-1, 8)


def _walk(angle: np.ndarray) -> np.ndarray:
    """The covariance (k, k) in rad^2 of what a gyro's errors that walk make of the means of an
    axis.
    """
    step = RATE_NOISE**2 * angle
    middle = np.cumsum(step) - step / 2
    # A walk's mean over a span has a third of the span's step, less a half until the middle.
    return np.minimum.outer(middle, middle) - np.diag(step / 6)


def _pushed(known: np.ndarray, left: np.ndarray, span: float) -> np.ndarray:
    """The covariance (2 k, 2 k) of pushes that last and of what velocities at the ends make of
    means over ``span`` s, beside the ``known`` one, by what is ``left`` (2 k,) in all.

    It is the mean by how likely each is.
    """
    rows = np.arange(len(left) // 2)
    apart = np.abs(rows[:, None] - rows)
    lasts = np.kron(np.exp(-apart * span / LASTS), np.eye(2))
    ends = np.kron((2.0 * (apart == 0) - (apart == 1)) / span**2, np.eye(2))
    off = []
    for velocity in VELOCITIES:
        scale, axes = eigh(known + velocity**2 * ends, lasts)
        variance = scale + PUSHES[:, None] ** 2
        off.append(np.sum(np.log(variance) + (left @ axes) ** 2 / variance, axis=1) / 2)
    prior = DRAWN * (np.log(PUSHES) + PUSH_STD**2 / PUSHES**2 / 2)
    likely = np.exp(np.min(off + prior) - (off + prior))
    likely /= likely.sum()
    pushes, velocities = likely.sum(axis=0) @ PUSHES**2, likely.sum(axis=1) @ VELOCITIES**2
    return pushes * lasts + velocities * ends
