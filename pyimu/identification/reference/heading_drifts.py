"""A reference attitude whose heading drifts slowly, as that of cameras does which see no landmark
twice.

Its rate is wrong along the vertical of the world then, by what changes slowly, and in the axes of a
body that leans that is on each axis by as much as it leans: no bias of a sensor is. What of that
does not change is left out of the judgement: a drift that stays is as much as what follows gravity.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.trial import SETTLE, Trial, marked
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.numerics.laws import chi2

DRIFTS = "reference_heading_drifts"
"""The finding of a reference whose heading drifts."""

BLOCK = 2.0
"""s; means over so long are compared: an attitude's noise is in none of their sums."""

SPACINGS = (80.0, 40.0, 20.0, 10.0)
"""s between the instants at which the drift is found, lines between them."""

LIKELIER = 20.0
"""nat by which a drift about the vertical must be likelier than one of any axis of the body."""

CHANCE = 1e-6
"""Probability by which chance may explain as much."""

FEWEST = 4
"""Blocks for each instant, and instants, at least."""


def with_steady_heading(trial: Trial) -> Trial:
    """The trial of a gyro with the rate of its reference less what its heading drifts; as it is
    where none is seen.
    """
    axes_known = len(trial.axes) == 3 and trial.reference == "attitude"
    if trial.kind != "gyro" or not axes_known:
        return trial
    seen = _Blocks(trial)
    found = None if not seen.enough else seen.likeliest()
    if found is None:
        return trial
    drift = found(trial.time)
    u = copied(trial.u)
    u[:, OWN[trial.kind]] = trial.u[:, OWN[trial.kind]] - drift[:, None] * _up(trial)
    inside = marked(trial.segments, len(trial.time))
    size = float(np.sqrt(np.mean(drift[inside] ** 2)))
    said = Finding(DRIFTS, trial.kind, 1, {"level": size})
    return replace(trial, u=u, findings=(*trial.findings, said))


def _up(trial: Trial) -> np.ndarray:
    """The vertical (n, 3) in the axes of the reference's body."""
    attitude = np.array(trial.u[:, COLUMNS["attitude"]])
    attitude[~np.any(attitude, axis=1)] = [1.0, 0.0, 0.0, 0.0]
    return Rotation.from_quat(attitude, scalar_first=True).apply([0.0, 0.0, 1.0], inverse=True)


class _Blocks:
    """Means of sensor and reference over blocks, and what is left of the sensor's beside its bias,
    its gains, two derivatives of the motion, as a clock and a bandwidth make, and what stays the
    same along each direction of gravity.
    """

    def __init__(self, trial: Trial) -> None:
        rows = max(round(BLOCK / trial.h), 1)
        up, own = _up(trial), trial.u[:, OWN[trial.kind]]
        # At the ends of a segment a curve through attitudes is bent as it likes.
        inner = [(a + SETTLE, b - SETTLE) for a, b in trial.segments]
        starts = [s for a, b in inner for s in range(a, b - rows + 1, rows)]
        self.enough = len(starts) > FEWEST * FEWEST
        if not self.enough:
            return
        first = slopes(trial, own)
        signals = trial.time[:, None], own, up, trial.y, first, slopes(trial, first)
        time, x, up, y, *more = (_means(v, starts, rows) for v in signals)
        self.time, self.y = time[:, 0], y
        self.base = np.column_stack([np.ones(len(x)), x, *more])
        self.up = up @ np.linalg.lstsq(self.base, y)[0][1:4]
        self.beside, _ = np.linalg.qr(np.column_stack([self.base, up]))

    def likeliest(self) -> Callable[[np.ndarray], np.ndarray] | None:
        """The drift [rad/s] at times [s]; None where none is seen."""
        first, last = self.time[0], self.time[-1]
        best, chosen = 0.0, None
        for spacing in SPACINGS:
            count = int((last - first) / spacing) + 1
            if count < FEWEST or len(self.time) < FEWEST * count:
                continue
            at = np.linspace(first, last, count)
            hats = np.array([np.interp(self.time, at, e) for e in np.eye(count)]).T
            gain = self._gain(hats, self.up)
            least = 0.5 * float(chi2.isf(CHANCE, count))
            rival = max(self._gain(hats, np.tile(e, (len(hats), 1))) for e in np.eye(3))
            worth = gain - count
            if gain > least and gain - max(rival, 0.0) > LIKELIER and worth > best:
                best, chosen = worth, (at, hats)
        if chosen is None:
            return None
        at, hats = chosen
        basis, _ = np.linalg.qr(self.base)
        left = [_less(basis, v) for v in (self.y, *_columns(hats, self.up))]
        made = np.column_stack([v.ravel() for v in left[1:]])
        # What the reference shows too much the sensor shows too little.
        found = -np.linalg.lstsq(made, left[0].ravel())[0]
        return lambda time: np.interp(time, at, found)

    def _gain(self, hats: np.ndarray, axis: np.ndarray) -> float:
        """nat that a drift about an axis (m, 3) explains."""
        left = _less(self.beside, self.y)
        made = np.column_stack([_less(self.beside, c).ravel() for c in _columns(hats, axis)])
        rest = left.ravel() - made @ np.linalg.lstsq(made, left.ravel())[0]
        return float(0.5 * left.size * np.log(np.sum(left**2) / np.sum(rest**2)))


def _columns(hats: np.ndarray, axis: np.ndarray) -> list[np.ndarray]:
    """What a drift that is one at an instant, about an axis (m, 3), is on each axis (m, 3)."""
    return [h[:, None] * axis for h in hats.T]


def _less(basis: np.ndarray, values: np.ndarray) -> np.ndarray:
    """What of values (m, k) an orthonormal basis does not explain."""
    return values - basis @ (basis.T @ values)


def _means(values: np.ndarray, starts: list[int], rows: int) -> np.ndarray:
    """Means (m, k) of values (n, k) over so many rows from each start on."""
    sums = np.vstack([np.zeros(values.shape[1]), np.cumsum(values, axis=0)])
    at = np.array(starts)
    return (sums[at + rows] - sums[at]) / rows
