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

from pyimu.errors import Finding
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.place import verticals
from pyimu.identification.fit.trial import SETTLE, Trial, marked
from pyimu.identification.reference.above import with_gyro_above
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.numerics.columns import unexplained
from pyimu.numerics.laws import chi2

DRIFTS = "reference_heading_drifts"
"""The finding of a reference whose heading drifts."""

BLOCK = 0.5
"""s; means over so long are compared: within longer ones a body in a hand leans to and fro, and of
shorter ones an attitude's noise is the larger part."""

SPACINGS = (160.0, 80.0, 40.0, 20.0, 10.0)
"""s between the instants at which the drift is found, lines between them."""

CHANCE = 1e-6
"""Probability by which chance may explain as much as a drift does beside biases of all axes of the
body that change as slowly, and as these do beside it for them to be there."""

LEANS = 0.03
"""Share of the power of a drift that must not be that of biases: a body that leans by ten degrees
to and fro. Of one that leans less a drift would be the small difference of large ones."""

FEWEST, MOST = 4, 64
"""Blocks for each instant, and instants, at least, and instants at most."""


def with_steady_heading(trial: Trial) -> Trial:
    """The trial of a gyro with the rate of its reference less what its heading drifts; as it is
    where none is seen.
    """
    axes_known = len(trial.axes) == 3 and trial.reference == "attitude"
    if trial.kind != "gyro" or not axes_known:
        return trial
    # What shaking makes of smoothed attitudes is slow, too.
    seen = _Blocks(with_gyro_above(trial))
    found = None if not seen.enough else seen.likeliest()
    if found is None:
        return trial
    drift = found(trial.time)
    u = copied(trial.u)
    u[:, OWN[trial.kind]] = trial.u[:, OWN[trial.kind]] - drift[:, None] * seen.vertical
    inside = marked(trial.segments, len(trial.time))
    size = float(np.sqrt(np.mean(drift[inside] ** 2)))
    said = Finding(DRIFTS, trial.kind, 1, {"level": size})
    return replace(trial, u=u, findings=(*trial.findings, said))


class _Blocks:
    """Means of sensor and reference over blocks, and what is left of the sensor's beside its bias,
    its gains, two derivatives of the motion, as a clock and a bandwidth make, and what stays the
    same along each direction of gravity.
    """

    def __init__(self, trial: Trial) -> None:
        rows = max(round(BLOCK / trial.h), 1)
        self.vertical = up = verticals(trial.u[:, COLUMNS["attitude"]])
        own = trial.u[:, OWN[trial.kind]]
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
        self.beside = np.column_stack([self.base, up])

    def likeliest(self) -> Callable[[np.ndarray], np.ndarray] | None:
        """The drift [rad/s] at times [s]; None where none is seen."""
        first, last = self.time[0], self.time[-1]
        best, chosen = 0.0, None
        for spacing in SPACINGS:
            count = int((last - first) / spacing) + 1
            if not FEWEST <= count <= MOST or len(self.time) < FEWEST * count:
                continue
            at = np.linspace(first, last, count)
            hats = np.array([np.interp(self.time, at, e) for e in np.eye(count)]).T
            biases, drift = _biases(hats), _along(hats, self.up)
            if _apart(drift, hats) < LEANS:
                return None
            both = self._gain(self.beside, biases + drift)
            gain = both - self._gain(self.beside, biases)
            if gain > _by_chance(count) and gain - count > best:
                best = gain - count
                alone = both - self._gain(self.beside, drift) < _by_chance(3 * count)
                chosen = at, drift + ([] if alone else biases)
        if chosen is None:
            return None
        at, columns = chosen
        # What the reference shows too much the sensor shows too little.
        found = -self._fitted(self.base, columns)[0][: len(at)]
        return lambda time: np.interp(time, at, found)

    def _gain(self, beside: np.ndarray, columns: list[np.ndarray]) -> float:
        """nat that columns explain of the sensor's beside others (m, k), on all axes."""
        _, left, rest = self._fitted(beside, columns)
        return float(0.5 * self.y.size * np.log(left / rest))

    def _fitted(
        self, beside: np.ndarray, columns: list[np.ndarray]
    ) -> tuple[np.ndarray, float, float]:
        """Coefficients of columns (m, 3) beside others (m, k), of each axis by itself, and the
        squares that are left without and with them.
        """
        basis, _ = np.linalg.qr(beside)
        left, *made = (unexplained(basis, v).ravel() for v in (self.y, *columns))
        stack = np.column_stack(made)
        found = np.linalg.lstsq(stack.T @ stack, stack.T @ left)[0]
        rest = left - stack @ found
        return found, float(left @ left), float(rest @ rest)


def _by_chance(count: int) -> float:
    """nat that so many columns explain by chance at most."""
    return 0.5 * float(chi2.isf(CHANCE, count))


def _biases(hats: np.ndarray) -> list[np.ndarray]:
    """What biases that change as slowly are, on each axis of the body."""
    return [c for e in np.eye(3) for c in _along(hats, np.tile(e, (len(hats), 1)))]


def _apart(drift: list[np.ndarray], hats: np.ndarray) -> float:
    """Share of the power of a drift, in the mean, that no bias which changes as slowly has; none
    where nothing of it shows, as of a gyro or a reference that stands still.
    """
    basis, _ = np.linalg.qr(hats)
    left = sum(float(np.sum(unexplained(basis, c) ** 2)) for c in drift)
    power = sum(float(np.sum(c**2)) for c in drift)
    return left / power if power > 0 else 0.0


def _along(hats: np.ndarray, axis: np.ndarray) -> list[np.ndarray]:
    """What a drift that is one at an instant, about an axis (m, 3), is on each axis (m, 3)."""
    return [h[:, None] * axis for h in hats.T]


def _means(values: np.ndarray, starts: list[int], rows: int) -> np.ndarray:
    """Means (m, k) of values (n, k) over so many rows from each start on."""
    sums = np.vstack([np.zeros(values.shape[1]), np.cumsum(values, axis=0)])
    at = np.array(starts)
    return (sums[at + rows] - sums[at]) / rows
