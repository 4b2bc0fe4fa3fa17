"""A sensor, or the body that cameras track, that turned in its mount once while the log ran.

What the reference then shows lies in other axes from one instant on: y = R (1 + theta x H(t - t0)),
which no effect of a sensor does. One that were taken for it would follow time and motion together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.identification.fit.columns import band_time, in_band
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.trial import Trial, marked
from pyimu.identification.reference.moving import in_own_band, moving_rows, turned_onto
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.recording.clock import runs

LEAST = float(np.radians(0.3))
"""rad; a turn below is no more than what a mount gives."""

SHARE = 0.03
"""Of what the reference leaves, in one mounting, that a second one must explain: a little of it may
be of any shape, for what is left of measured logs is no white noise."""

LIKELIER = 50.0
"""nat that it must gain beyond a step of the bias, which is a sensor's, at its best instant."""

PURE = 0.7
"""Share of what any change of the gain at that instant gains, that a turn must gain: a scale factor
that changes with time is no mounting."""

UNSURE = 4.0
"""nat by which an instant may be less likely than the best one, and still be the right one."""

BESIDE = 0.5
"""s before and after the slip that are left out: it takes its time."""

FEWEST = 64
"""Rows of the band on either side of a slip."""


def with_one_mounting(trial: Trial) -> Trial:
    """The trial of a gyro with its reference, from the instant on at which the mount slipped, in
    the axes from before it; as it is where none did.
    """
    axes_known = len(trial.axes) == 3 and trial.reference == "attitude"
    if trial.kind != "gyro" or not axes_known or not trial.free_rotation:
        return trial
    slip = _slip(trial)
    if slip is None or slip.angle < LEAST:
        return trial
    u, late = copied(trial.u), trial.time > slip.middle
    own = COLUMNS["rate"], COLUMNS["angular_acceleration"], OWN[trial.kind]
    for at in own:
        u[:, at] = np.where(late[:, None], trial.u[:, at] @ slip.turn, trial.u[:, at])
    known = marked(trial.segments, len(trial.time))
    known &= (trial.time < slip.first - BESIDE) | (trial.time > slip.last + BESIDE)
    detail = {"angle": slip.angle, "first": slip.first, "last": slip.last}
    found = Finding("mount_slipped", trial.kind, 1, detail)
    return replace(trial, u=u, segments=runs(known), findings=(*trial.findings, found))


@dataclass(frozen=True)
class _Slip:
    """A slip between ``first`` and ``last`` s, after which reference @ ``turn`` (3, 3) is what it
    was before.
    """

    first: float
    last: float
    turn: np.ndarray

    @property
    def middle(self) -> float:
        return 0.5 * (self.first + self.last)

    @property
    def angle(self) -> float:
        return float(Rotation.from_matrix(self.turn).magnitude())


def _slip(trial: Trial) -> _Slip | None:
    band = in_own_band(trial)
    seen = moving_rows(band)
    time = band_time(band)[seen]
    x, y = (in_band(band, v)[seen] for v in (trial.u[:, OWN[trial.kind]], trial.y))
    if len(x) < 3 * FEWEST:
        return None
    known = np.column_stack([np.ones(len(x)), x])
    if np.linalg.det(np.linalg.lstsq(known, y)[0][1:]) <= 0.0:
        return None  # Mirrored: in no mounting do the two belong together.
    q, _ = np.linalg.qr(known)
    left = y - q @ (q.T @ y)
    turns = np.stack([np.cross(x, e) for e in np.eye(3)], axis=2)
    gains = np.einsum("mi,jk->mjik", x, np.eye(3)).reshape(len(x), 3, 9)
    biases = np.broadcast_to(np.eye(3), (len(x), 3, 3))
    power = float(np.sum(left**2))
    taken, by_bias = _taken(left, q, turns), _taken(left, q, biases)
    best = int(np.argmax(taken))
    if taken[best] < SHARE * power or taken[best] < PURE * _taken(left, q, gains, best)[0]:
        return None
    nats = -0.5 * left.size * np.log1p(-np.minimum(taken, 0.999 * power) / power)
    bias = -0.5 * left.size * np.log1p(-min(by_bias.max(), 0.999 * power) / power)
    if nats[best] < bias + LIKELIER:
        return None
    likely = time[np.flatnonzero(nats > nats[best] - UNSURE)]
    first, last = float(likely.min()), float(likely.max())
    before, after = (
        turned_onto(x[m] - x[m].mean(axis=0), y[m] - y[m].mean(axis=0))
        for m in (time < first, time > last)
    )
    return _Slip(first, last, after @ before.T)


def _taken(
    left: np.ndarray, q: np.ndarray, columns: np.ndarray, only: int | None = None
) -> np.ndarray:
    """Squares that ``columns`` (m, 3, k), from each row on, take off what is ``left`` (m, 3) beside
    the orthonormal ``q`` (m, p), fitted anew: of each row, or of one; zero near the ends.

    What a step has beside q is itself less its projection, so that sums from the row on are enough
    (Frisch and Waugh 1933).
    """
    m, _, k = columns.shape
    rows = slice(FEWEST, m - FEWEST) if only is None else slice(only, only + 1)
    score = _from_here(np.einsum("mi,mik->mk", left, columns))[rows]
    gram = _from_here(np.einsum("mij,mik->mjk", columns, columns))[rows]
    across = _from_here(np.einsum("mp,mik->mpik", q, columns))[rows].reshape(len(score), -1, k)
    own = gram - across.transpose(0, 2, 1) @ across
    inverse = np.linalg.pinv(own, rcond=1e-9, hermitian=True)
    found = np.einsum("mj,mjk,mk->m", score, inverse, score)
    return found if only is not None else np.pad(found, FEWEST)


def _from_here(values: np.ndarray) -> np.ndarray:
    """Sums of each row and all that follow."""
    return np.cumsum(values[::-1], axis=0)[::-1]
