"""Where a body that looks still gains a speed that no window shows: a creep begins or ends there.

A shove of a few tenths of a second is lost in the noise of single samples, and the speed that it
leaves is not: it is the sum of the force, less the mean of what is before and after. Its error is
that of white noise, and of a force that does not come back to what it was.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.ins.noise import Noise
from pyimu.ins.pushes import SETTLED, STEADY_GATE
from pyimu.numerics.laws import chi2
from pyimu.recording.clock import runs

SETTLES = 0.005
"""m/s; speed that a body may have by which it settles after a stop. Assumed."""

CREEP = 0.05
"""m/s; of what creeps, at most. Assumed."""

LENGTHS = (0.3, 0.45, 0.7, 1.0, 1.5, 2.2)
"""s; of a shove. Of a longer one a force that changes while a body rests hides as much."""

BESIDE = 0.5
"""s; of what stays at a force before and after a shove, at least."""

QUIET = 0.25
"""Quantile of the gains of all windows that tells their noise, where that is more than white (a
sensor's own low-pass, its flicker): few of them hold a shove."""

EXPECTED = float(chi2.ppf(QUIET, 1))


def shoved(
    force: np.ndarray, still: np.ndarray, noise: Noise, period: float
) -> tuple[np.ndarray, Noise]:
    """Marks (n,) of the shoves in what looks ``still`` (n,), by the ``force`` (n, 3) m/s^2, one
    sample a ``period`` s; and the noise as speeds that are gained at rest show it.
    """
    found: list[tuple[float, int, int]] = []
    sizes = [np.ones(3)]
    for rows in sorted({max(1, round(length / period)) for length in LENGTHS}):
        parts = [
            (start, *_gains(force[start:stop], noise.force, rows, period))
            for start, stop in runs(still)
        ]
        if not parts:
            continue
        begins = np.concatenate([start + at for start, at, _, _ in parts])
        gain, variance = (np.concatenate([part[i] for part in parts]) for i in (2, 3))
        if not len(begins):
            continue
        shown = np.quantile(gain**2 / variance, QUIET, axis=0) / EXPECTED
        sizes.append(np.maximum(shown, 1.0))
        variance = variance * sizes[-1]
        off = np.sum(gain**2 / variance, axis=1)
        seen = off > STEADY_GATE + 3 + SETTLES**2 / variance.mean(axis=1)
        found += zip(off[seen], begins[seen], [rows] * int(seen.sum()), strict=True)
    marks = np.zeros(len(still), dtype=bool)
    for _, begin, rows in sorted(found, reverse=True):
        # The window that shows it best holds most of a shove, and not its first and last moments.
        whole = slice(begin - rows // 4, begin + rows + rows // 4)
        if not marks[whole].any():
            marks[whole] = True
    return marks & still, replace(noise, force=noise.force * np.sqrt(np.median(sizes, axis=0)))


def _gains(
    force: np.ndarray, std: np.ndarray, rows: int, period: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The first rows (k,) of windows of so many ``rows`` in a stretch of ``force`` (n, 3), what the
    velocity gains over each (k, 3) m/s, and the variances (k, 3) of that.
    """
    n, least, far = len(force), max(rows, round(BESIDE / period)), round(SETTLED / period)
    at = np.arange(least, n - rows - least + 1)
    if not len(at):
        return at, np.zeros((0, 3)), np.zeros((0, 3))
    sums = np.vstack([np.zeros(3), np.cumsum(force - force.mean(axis=0), axis=0)])
    first, last = np.maximum(at - far, 0), np.minimum(at + rows + far, n)
    counts = np.stack([at - first, last - at - rows])[..., None]
    before = (sums[at] - sums[first]) / counts[0]
    after = (sums[last] - sums[at + rows]) / counts[1]
    gain = period * (sums[at + rows] - sums[at] - rows * (before + after) / 2)
    few = std**2 * np.sum(1 / counts, axis=0)
    white = period**2 * rows * (std**2 + rows * few / 4)
    # Where in the window it changes is not known: half of it before or after, three sigmas.
    changed = np.maximum((after - before) ** 2 - few, 0.0)
    return at, gain, white + (rows * period / 2) ** 2 * changed / 9
