"""A thousand million normals against the bell: ``python benchmarks/noise_statistics.py [DRAWS]``.

Tails out to five sigma and beyond, side by side, by the binomial distribution; 64 and 1024 equally
likely cells and 64 by 64 cells of neighbours by chi-square; Hermite moments. All p-values are
two-sided; the last line judges the smallest.
"""

import sys
from math import factorial, sqrt

import numpy as np
from numba import njit
from scipy import stats

from pyimu.block.normals import edges, normals

DRAWS = 10**9
CHUNK = 10**6
SEED, CHANNEL = 20_240_229, 1
FALSE_ALARM = 1e-3
CELLS, COARSE, PER_SIGMA, WIDTH, LAST = 1024, 64, 512, 0.25, 8.0
"""Fine and coarse cells; the grid, per sigma, from which a cell is looked up; the width of the
tails' bins and where they end."""
TAIL = np.sort([*np.arange(3.0, 6.51, WIDTH), edges()[1]])
"""Levels that are counted: a quarter of a sigma apart, and where the ziggurat's tail begins."""


def main() -> None:
    draws = int(float(sys.argv[1])) if len(sys.argv) > 1 else DRAWS
    beyond, pairs, fine, powers = _count(draws)
    p_values = _tails(beyond, draws) + _cells(fine, pairs) + _moments(powers / draws, draws)
    bound = FALSE_ALARM / len(p_values)
    print(
        f"smallest of {len(p_values)} p-values: {min(p_values):.2g}; one run in "
        f"{1 / FALSE_ALARM:.0f} has one below {bound:.1g}: "
        f"{'passed' if min(p_values) > bound else 'FAILED'}"
    )


def _count(draws: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Counts beyond each level by side (2, levels), of neighbours' cells (64, 64), of cells
    (1024,); sums of z to z^4 (4,).
    """
    borders = stats.norm.ppf(np.arange(CELLS + 1) / CELLS)
    lowest = np.searchsorted(borders, np.arange(-LAST, LAST, 1 / PER_SIGMA), side="right") - 1
    beyond, pairs = (
        np.zeros((2, len(TAIL)), dtype=np.int64),
        np.zeros((COARSE, COARSE), dtype=np.int64),
    )
    fine, powers = np.zeros(CELLS, dtype=np.int64), np.zeros(4)
    for first in range(1, draws + 1, CHUNK):
        z = normals(SEED, [CHANNEL], first, min(CHUNK, draws + 1 - first))[:, 0]
        powers += _tally(z, borders, lowest, TAIL, beyond, pairs, fine)
    return beyond, pairs, fine, powers


@njit(cache=True)
def _tally(z, borders, lowest, levels, beyond, pairs, fine):
    """Count one chunk into the tables; gives its sums of powers. Pairs do not overlap, so that
    they are independent.
    """
    sums, before = np.zeros(4), 0
    for k in range(len(z)):
        x = z[k]
        at = int((min(max(x, -LAST), LAST - 1e-9) + LAST) * PER_SIGMA)
        cell = lowest[at]
        while x >= borders[cell + 1]:
            cell += 1
        fine[cell] += 1
        if k % 2:
            pairs[before, cell * COARSE // CELLS] += 1
        before = cell * COARSE // CELLS
        if abs(x) > levels[0]:
            for i in range(len(levels)):
                beyond[int(x > 0), i] += abs(x) > levels[i]
        for i in range(4):
            sums[i] += x ** (i + 1)
    return sums


def _tails(beyond: np.ndarray, draws: int) -> list[float]:
    print(
        f"{draws:.3g} normals, seed {SEED}, channel {CHANNEL}\n{'level':>8} {'expected':>12} "
        f"{'below':>10} {'p':>7} {'above':>10} {'p':>7}"
    )
    out = []
    for level, counts in zip(TAIL, beyond.T):
        chance = stats.norm.sf(level)
        p = [stats.binomtest(int(c), draws, chance).pvalue for c in counts]
        print(
            f"{level:8.4f} {draws * chance:12.2f} {counts[0]:10d} {p[0]:7.3f} {counts[1]:10d} "
            f"{p[1]:7.3f}"
        )
        out += p
    return out + [_bins(side, counts, draws) for side, counts in zip(("below", "above"), beyond)]


def _bins(side: str, beyond: np.ndarray, draws: int) -> float:
    """The shape of one tail: what lies between neighbouring levels, as far as ten are expected, and
    beyond the last.
    """
    chance = stats.norm.sf(TAIL)
    used = draws * chance >= 10
    observed, expected = (-np.diff(np.append(c[used], 0)) for c in (beyond, draws * chance))
    chi2 = ((observed - expected) ** 2 / expected).sum()
    p = 2 * min(stats.chi2.sf(chi2, len(expected)), stats.chi2.cdf(chi2, len(expected)))
    print(
        f"bins of the tail {side}: chi-square {chi2:.1f} at {len(expected)} degrees of freedom, p "
        f"= {p:.3f}"
    )
    return p


def _cells(fine: np.ndarray, pairs: np.ndarray) -> list[float]:
    tables = {
        "1024 cells": fine,
        "64 cells": fine.reshape(COARSE, -1).sum(1),
        "64 x 64 cells of neighbours": pairs.ravel(),
    }
    out = []
    for name, counts in tables.items():
        chi2, p = stats.chisquare(counts)
        out.append(2 * min(p, 1 - p))
        print(
            f"{name}: chi-square {chi2:.1f} at {len(counts) - 1} degrees of freedom, p = "
            f"{out[-1]:.3f}"
        )
    return out


def _moments(m: np.ndarray, draws: int) -> list[float]:
    """Of n normals the k-th Hermite mean has variance k!/n."""
    hermite = (m[0], m[1] - 1, m[2] - 3 * m[0], m[3] - 6 * m[1] + 3)
    deviations = [h * sqrt(draws / factorial(k)) for k, h in enumerate(hermite, 1)]
    p = [2 * stats.norm.sf(abs(d)) for d in deviations]
    print(
        "Hermite means, in standard deviations:",
        ", ".join(f"{d:+.2f} (p = {q:.3f})" for d, q in zip(deviations, p)),
    )
    return p


if __name__ == "__main__":
    main()
