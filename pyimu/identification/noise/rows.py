"""The residual of one axis of one log at the sample rate, with what its noise may depend on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.identification.fit.columns import in_band, residual
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import LogState, reference_input
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

BRIDGED = 4
"""Rows that may be missing in a row and are put in between their neighbours for a spectrum."""

MOST_BRIDGED = 2e-3
"""Share of the rows that may be; more of them would take as much off the white noise."""

CLEARLY = 5.0
"""Times the reference's noise that a motion must have for a row's to be known to a fifth."""

CHANGES = 0.25
"""Steps by which a rounded value changes where it does; between samples of its own it is drawn."""

SHORTEST = 256
"""Rows of a stretch without gap that gives a spectrum."""


@dataclass(frozen=True)
class Rows:
    """Residual ``r`` (n,) of one axis at ``time`` (n,) s, sampled every ``h`` s where nothing is
    missing; ``x`` (n,) is the axis's own input and ``slope`` (n,) its rate, ``rounded`` (n,) the
    variance of what rounding did to a row of the reference and not to the one before.

    The first ``fitted`` rows were fitted, those after them held out. ``averaged`` says that each is
    the mean over ``h`` s. ``rate`` (n, 3) rad/s is how fast the sensor turns, where that is asked.
    """

    time: np.ndarray
    r: np.ndarray
    x: np.ndarray
    slope: np.ndarray
    h: float
    fitted: int
    averaged: bool = False
    rounded: np.ndarray | None = None
    rate: np.ndarray | None = None

    @property
    def steps(self) -> np.ndarray:
        """Seconds (n,) from the row before, zero for the first."""
        return np.diff(self.time, prepend=self.time[:1])

    def seen(self) -> Rows:
        """The rows that were fitted."""
        n = self.fitted
        each = self.time[:n], self.r[:n], self.x[:n], self.slope[:n]
        rounded, rate = (None if v is None else v[:n] for v in (self.rounded, self.rate))
        return Rows(*each, self.h, n, rounded=rounded, rate=rate)

    def means(self, seconds: float) -> Rows:
        """Means over so many seconds of rows, as rows of their own."""
        m = max(1, round(seconds / self.h))
        whole = len(self.r) // m * m
        each = (self.time, self.r, self.x, self.slope)
        time, r, x, slope = (v[:whole].reshape(-1, m).mean(axis=1) for v in each)
        rate = self.rate
        if rate is not None:
            rate = rate[:whole].reshape(-1, m, 3).mean(axis=1)
        return Rows(time, r, x, slope, self.h * m, self.fitted // m, True, rate=rate)

    def stretches(self) -> list[np.ndarray]:
        """The residual of each stretch that is long enough, single missing rows put in."""
        apart = np.rint(self.steps / self.h).astype(int)
        missing = int(np.sum(apart[(apart > 1) & (apart <= BRIDGED + 1)] - 1))
        most = BRIDGED + 1 if missing <= MOST_BRIDGED * len(self.r) else 1
        edges = [0, *np.flatnonzero(apart > most).tolist(), len(self.r)]
        out = []
        for a, b in zip(edges[:-1], edges[1:], strict=True):
            at = np.cumsum(apart[a:b]) - apart[a] if b > a else apart[:0]
            if b - a >= SHORTEST:
                out.append(np.interp(np.arange(at[-1] + 1), at, self.r[a:b]))
        return out


def rows_of(fit: Fit, held: tuple[Trial, ...]) -> dict[int, list[Rows]]:
    """By axis the rows of each log, the held-out end of a fitted log behind its fitted rows."""
    out: dict[int, list[Rows]] = {}
    fitted = {t.name: t for t in fit.trials}
    ends = {t.parent: t for t in held if t.parent is not None and fitted[t.parent].precedes(t)}
    for trial in fit.trials:
        made = _columns(fit.sensor, trial, fit.states[trial.name])
        count = len(made)
        end = ends.get(trial.name)
        if end is not None:
            state, rest = held_state(fit, end)
            # The bias that suits the fitted rows is one with the walk here.
            made = np.concatenate([made, _columns(fit.sensor, rest, state)])
        for i in trial.axes:
            out.setdefault(i, []).append(_axis(made, i, trial.h, count))
    for trial in (t for t in held if ends.get(t.parent) is not t):
        state, rest = held_state(fit, trial)
        made = _columns(fit.sensor, rest, state)
        for i in rest.axes:
            out.setdefault(i, []).append(_axis(made, i, rest.h, 0))
    return out


def _columns(sensor: Sensor, trial: Trial, state: LogState) -> np.ndarray:
    """Time, residual, own signal, its rate, what rounding did to it, and the angular rate (m, 16)
    of the rows that count.
    """
    u, own = reference_input(trial, state), OWN[trial.kind]
    rate = COLUMNS[KINDS[trial.kind].own_rate]
    moves = _moves(trial, u[:, own])
    x, slope = (np.where(moves, u[:, c], 0.0) for c in (own, rate))
    values = (trial.time[:, None], residual(sensor, trial, state), x, slope)
    return in_band(
        trial, np.column_stack((*values, _rounded(trial, u[:, own]), u[:, COLUMNS["rate"]]))
    )


def _rounded(trial: Trial, x: np.ndarray) -> np.ndarray:
    """Variance (n, 3) of what is new in the rounding of a measured reference ``x`` (n, 3): a digit
    that stays keeps its error, one that changes has another, which is even over a step.
    """
    steps = np.array(trial.digits)
    changes = np.abs(np.diff(x, axis=0, prepend=x[:1])) > CHANGES * steps
    return np.where(changes, steps**2 / 12.0, 0.0)


def _moves(trial: Trial, x: np.ndarray) -> np.ndarray:
    """The axes (3,) on which a signal (n, 3) is more than noise of the reference: that is in the
    residual, too, and would make it look as if it grew with the signal.
    """
    if trial.noise is None:
        return np.ones(3, dtype=bool)
    shown, noise = (in_band(trial, v).std(axis=0) for v in (x, trial.noise))
    return shown > CLEARLY * noise


def _axis(made: np.ndarray, i: int, h: float, fitted: int) -> Rows:
    columns = (0, 1 + i, 4 + i, 7 + i, 10 + i)
    time, r, x, slope, rounded = (np.ascontiguousarray(made[:, c]) for c in columns)
    digits = rounded if rounded.any() else None
    return Rows(time, r, x, slope, h, fitted, rounded=digits, rate=made[:, 13:])
