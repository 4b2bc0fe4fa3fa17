"""Rows in which all axes of a sensor show the sample of the row before once more.

A logger that reads a sensor before it has a new sample finds the last one there. Where it reads at
even times, these rows tell the sensor's own rate: its samples come one in so many rows, and of them
none is lost. Where it does not, nobody knows whether a sample was repeated or lost.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding

FEW = 1e-3
"""Share of repeats below which they do not matter: N grows by as much."""

BY_CHANCE = 0.3
"""Part of the repeats that chance may make, where samples are rounded, for them to be told."""

WINDOW, WINDOWS = 512, 16
"""Rows of a window in which new samples are counted, and of how many windows there are at least."""

LEAST = 64
"""Rows of a window, fewer than which a count that is off by one counts for too much."""

LOST = 0.03
"""Share of a sensor's samples up to which they may be lost between rows: N is too large by half of
it. Most of the repeats make up for none that was lost then."""

PIECE = 1 << 20
"""Rows of a piece."""


@dataclass(frozen=True)
class Repeats:
    """The ``rows`` (k,) that repeat the one before; their ``share`` of all, less what chance makes;
    and the rows from one new sample to the next, ``every``, None where they come unevenly.
    """

    rows: np.ndarray
    share: float
    every: float | None

    def finding(self, name: str, samples: int) -> Finding:
        """``held_samples`` of a sensor that is slower than its log, else ``repeated_samples``."""
        if self.every is not None:
            return Finding("held_samples", name, samples, {"rows": self.every})
        return Finding("repeated_samples", name, len(self.rows), {"first_row": int(self.rows[0])})


def repeats(
    columns: Sequence[np.ndarray], segments: Sequence[tuple[int, int]], hung: np.ndarray
) -> Repeats | None:
    """The repeats of the axes ``columns`` (each (n,)) within ``segments``, without those that are
    ``hung`` (k,); None where there are no more than matters or chance makes.
    """
    columns, n = [c for c in columns if len(c) and np.ptp(c) > 0], len(columns[0]) if columns else 0
    if len(columns) < 2:
        return None
    found, chance = _together(columns, segments)
    found = np.setdiff1d(found, hung, assume_unique=True)
    if len(found) < FEW * n or BY_CHANCE * len(found) < chance * n:
        return None
    new = np.ones(n, dtype=bool)
    new[found] = False
    share = len(found) / n - chance
    lost = _lost(new[np.setdiff1d(np.arange(n), hung)] if len(hung) else new)
    return Repeats(found, share, 1 / (1 - share) if lost <= min(LOST, share / 2) else None)


def _lost(new: np.ndarray) -> float:
    """Share of a sensor's samples that were lost between rows, of which (n,) some are ``new``.

    Where a row was late and the next in time, a sample is lost and another stands there twice. Each
    such pair puts the count of new samples in its window off by one, so that the variance of the
    counts is their number; of a sensor read at even times a count is off by less than one. Taken
    from window to window, for a rate may wander.
    """
    length = min(len(new) // WINDOWS, WINDOW)
    if length < LEAST:
        return 1.0
    counts = new[: len(new) // length * length].reshape(-1, length).sum(axis=1)
    return float(np.mean(np.diff(counts) ** 2)) / 2 / float(counts.mean())


def _together(
    columns: Sequence[np.ndarray], segments: Sequence[tuple[int, int]]
) -> tuple[np.ndarray, float]:
    """The rows (k,) in which all repeat, and how probable one is by chance.

    Axes repeat independently where rounding makes them. How often one does is told where another
    does not.
    """
    found, each, others = [np.empty(0, int)], np.zeros(len(columns)), np.zeros(len(columns))
    rows = 0
    for first, same in _same(columns, segments):
        all_of_them = same.all(axis=0)
        found.append(first + np.flatnonzero(all_of_them))
        rows += same.shape[1]
        each += np.sum(same & ~all_of_them, axis=1)
        for k in range(len(columns)):
            others[k] += np.sum(np.delete(same, k, axis=0).all(axis=0))
    return np.concatenate(found), float(np.prod(each / np.maximum(rows - others, 1)))


def _same(
    columns: Sequence[np.ndarray], segments: Sequence[tuple[int, int]]
) -> Iterator[tuple[int, np.ndarray]]:
    """By piece the number of its first sample, and whether axes repeat (len(columns), k)."""
    for start, stop in segments:
        for a in range(start + 1, stop, PIECE):
            b = min(a + PIECE, stop)
            pieces = (np.array(c[a - 1 : b]) for c in columns)
            yield a, np.array([c[1:] == c[:-1] for c in pieces])
