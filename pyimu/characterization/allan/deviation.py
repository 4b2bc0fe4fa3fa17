r"""Overlapping, Hadamard and modified Allan deviations of a record of rates.

They are exact, and the memory that they take is bounded. With S_k the sum of the first k of n
rates, and clusters of m samples (tau = m h, h the sample period),

    overlapping   sigma^2 = 1 / (2 m^2 (n - 2m + 1)) sum_j (S_{j+2m} - 2 S_{j+m} + S_j)^2
    Hadamard  sigma^2 = 1 / (6 m^2 (n - 3m + 1)) sum_j (S_{j+3m} - 3 S_{j+2m} + 3 S_{j+m} - S_j)^2
    modified  sigma^2 = 1 / (2 m^4 (n - 3m + 2))
                        sum_j (sum_{i=j}^{j+m-1} (S_{i+2m} - 2 S_{i+m} + S_i))^2

each over all the terms that the record has (Riley, NIST SP 1065, 2008, sections 5.2.4, 5.2.6 and
5.2.5; IEEE Std 952-2020, annex C; Hidalgo 2012 divides the first by n - 2m and leaves out its last
term). The sample period does not enter: deviations are in the unit of the rates.

Memory beside the data: S of one column, as much as that column in double precision, in memory or in
a mapped file. Time: the differences are made a tile at a time for all cluster sizes, so that short
clusters find their sums in the cache; processors share the tiles.

Error: a column's mean is subtracted first, and S is summed with compensation (Neumaier, Z. angew.
Math. Mech. 54 (1974), 39-51). The error of S is then that of storing it, at most u max|S| with u =
2^-53, and does not grow along the record. By the triangle inequality of the root mean square a
deviation is off by at most 10 u max|S| / m (storing S, and the differences) and some 10 u of
itself; the modified one, whose inner sum runs along the record, by another u sqrt(n) of itself.
In 1.4e7 samples of white noise max|S| is some 4000 of its deviations, which bounds the error at
m = 1 by 5e-12. Rounding is random, so the actual error is far smaller.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numba import njit

from pyimu.errors import UserError

TILE = 4096
"""Differences made at a time: the sums that they come from, 128 KiB at most, fit a core's cache."""


def octave_clusters(n: int, order: int = 2) -> np.ndarray:
    """Cluster sizes (t,) 1, 2, 4, ... of which ``order`` in a row fit into n samples."""
    return 2 ** np.arange(int(n // order).bit_length())


def log_clusters(n: int, points: int = 100, order: int = 2) -> np.ndarray:
    """``points`` cluster sizes (points,) from 1 to n / order, evenly spaced in the logarithm.

    The first ones are consecutive integers, where an even spacing would be below one.
    """
    largest, sizes = n // order, []
    for left in range(min(points, largest) - 1, -1, -1):
        last = sizes[-1] if sizes else 0.5
        sizes.append(max(int(last) + 1, round(last * (largest / last) ** (1 / (left + 1)))))
    return np.array(sizes, dtype=int)


def overlapping_deviation(
    rates: np.ndarray, clusters: np.ndarray, work: np.ndarray | None = None
) -> np.ndarray:
    """Overlapping Allan deviation, shape (t,) or (t, c), in the unit of the rates.

    ``rates`` is (n,) or (n, c), ``clusters`` (t,) are cluster sizes in samples. ``work`` (n + 1,)
    or longer is memory to work in, such as a mapped file for a very long record; None allocates it.
    Raises ValueError for a cluster size that is no whole number from 1 to n / 2, UserError where a
    rate is not finite.
    """
    return _deviation(rates, clusters, 2, 0, _allan_sums, work)


def hadamard_deviation(
    rates: np.ndarray, clusters: np.ndarray, work: np.ndarray | None = None
) -> np.ndarray:
    """Overlapping Hadamard deviation, in which a rate ramp does not appear.

    Arguments, shapes and errors are those of ``overlapping_deviation``; sizes go up to n / 3.
    """
    return _deviation(rates, clusters, 3, 0, _hadamard_sums, work)


def modified_deviation(
    rates: np.ndarray, clusters: np.ndarray, work: np.ndarray | None = None
) -> np.ndarray:
    """Modified Allan deviation, which tells quantization from flicker of the angle.

    Arguments, shapes and errors are those of ``overlapping_deviation``; sizes go up to (n + 1) / 3.
    """
    return _deviation(rates, clusters, 3, 1, _modified_sums, work)


def _deviation(
    rates: np.ndarray,
    clusters: np.ndarray,
    order: int,
    spare: int,
    sums: Callable,
    work: np.ndarray | None,
) -> np.ndarray:
    rates, m = np.asarray(rates), np.atleast_1d(clusters)
    if rates.ndim not in (1, 2):
        raise ValueError(f"rates have shape {rates.shape}, neither (n,) nor (n, c)")
    largest = (len(rates) + spare) // order
    if np.any(m != np.floor(m)) or np.any(m < 1) or np.any(m > largest):
        raise ValueError(
            f"cluster sizes must be whole numbers from 1 to {largest} for {len(rates)} samples"
        )
    m = m.astype(np.int64)
    columns = rates[:, None] if rates.ndim == 1 else rates
    # The same memory for all columns: fresh memory costs as much as what is done with it.
    variance = np.empty((len(m), columns.shape[1]))
    cumulative = np.empty(len(rates) + 1) if work is None else work[: len(rates) + 1]
    for c in range(columns.shape[1]):
        variance[:, c] = sums(_cumulative(columns[:, c], c, cumulative), m)
    return np.sqrt(variance).reshape(m.shape + rates.shape[1:])


def _cumulative(column: np.ndarray, c: int, out: np.ndarray) -> np.ndarray:
    """Fill ``out`` with the sums (n + 1,) of the first 0, 1, ..., n rates less their mean."""
    with np.errstate(invalid="ignore"):
        mean = np.mean(column, dtype=float)
    if not _fill_cumulative(column, mean, out):
        raise UserError(
            f"column {c + 1} of the rates: sample {np.flatnonzero(~np.isfinite(column))[0] + 1} is "
            "not finite; "
            "split the record at its gaps"
        )
    return out


@njit(cache=True, nogil=True)
def _fill_cumulative(x, mean, out):
    """Fill ``out`` with the running sum of x - mean; False where the sum is not finite."""
    total, lost = 0.0, 0.0
    out[0] = 0.0
    for k in range(len(x)):
        total, rounded = _two_sum(total, x[k] - mean)
        lost += rounded
        out[k + 1] = total + lost
    return np.isfinite(total)


@njit(cache=True, nogil=True)
def _two_sum(a, b):
    """The sum of a and b and its exact rounding error (Knuth).

    The errors are summed separately, so that the next sum need not wait for them.
    """
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def _allan_sums(s: np.ndarray, m: np.ndarray) -> np.ndarray:
    return _mean_squares(s, m, 2) / (2.0 * m**2)


def _hadamard_sums(s: np.ndarray, m: np.ndarray) -> np.ndarray:
    return _mean_squares(s, m, 3) / (6.0 * m**2)


def _mean_squares(s: np.ndarray, m: np.ndarray, order: int) -> np.ndarray:
    """Mean squares (t,) of the differences of ``order`` 2 or 3 of the sums ``s`` at distances m."""
    tiles = -(-len(s) // TILE)
    squares = np.zeros((tiles, len(m)))
    _shared(tiles, lambda first, last: _fill_squares(s, m, order, first, last, squares))
    return squares.sum(axis=0) / (len(s) - order * m)


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _shared(parts: int, work: Callable[[int, int], None]) -> None:
    """Call ``work(first, last)`` for contiguous shares of the parts, on all processors.

    Together the shares cover the parts 0 to ``parts`` - 1; each part is computed by itself, so that
    the results do not depend on the number of processors.
    """
    workers = min(processors(), parts)
    if workers == 1:
        work(0, parts)
        return
    edges = np.linspace(0, parts, 4 * workers + 1).astype(int)
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(work, edges[:-1], edges[1:]))


@njit(cache=True, nogil=True)
def _fill_squares(s, m, order, first, last, squares):
    """Fill the rows ``first`` to ``last`` - 1 of ``squares`` (tiles, t) with sums over tiles."""
    for tile in range(first, last):
        start = tile * TILE
        for i in range(len(m)):
            count = min(TILE, len(s) - order * m[i] - start)
            if count > 0:
                squares[tile, i] = (
                    _second_squares(s, start, m[i], count)
                    if order == 2
                    else _third_squares(s, start, m[i], count)
                )


# The sum of squares may be made in any order ("reassoc"), so that the compiler takes eight at a
# time. The differences may not: they are functions of their own, differences of neighbours first,
# which are alike, and whose difference loses nothing.


@njit(cache=True, nogil=True, fastmath={"reassoc"})
def _second_squares(s, start, m, count):
    total = 0.0
    a, b, c = (
        s[start : start + count],
        s[start + m : start + m + count],
        s[start + 2 * m : start + 2 * m + count],
    )
    for k in range(count):
        d = _second(a[k], b[k], c[k])
        total += d * d
    return total


@njit(cache=True, nogil=True, fastmath={"reassoc"})
def _third_squares(s, start, m, count):
    total = 0.0
    a, b = s[start : start + count], s[start + m : start + m + count]
    c, e = s[start + 2 * m : start + 2 * m + count], s[start + 3 * m : start + 3 * m + count]
    for k in range(count):
        d = _second(b[k], c[k], e[k]) - _second(a[k], b[k], c[k])
        total += d * d
    return total


@njit(cache=True, nogil=True)
def _second(a, b, c):
    return (c - b) - (b - a)


def _modified_sums(s: np.ndarray, m: np.ndarray) -> np.ndarray:
    squares = np.empty(len(m))
    _shared(len(m), lambda first, last: _fill_modified(s, m[first:last], squares[first:last]))
    return squares / (2.0 * m.astype(float) ** 4 * (len(s) - 3 * m + 1))


@njit(cache=True, nogil=True)
def _fill_modified(s, m, squares):
    """Fill ``squares`` (t,) with the sums of squares of the modified Allan variance.

    The inner sum moves on by a third difference of S. It moves through the whole record, so it and
    the sum of its squares are compensated, a tile at a time: within one, rounding does not add up.
    """
    for i in range(len(m)):
        n = m[i]
        z, lost = 0.0, 0.0
        for k in range(n):
            z += _second(s[k], s[k + n], s[k + 2 * n])
        total, missing = z * z, 0.0
        for start in range(0, len(s) - 3 * n, TILE):
            moved, squared = _moved(s, start, n, min(TILE, len(s) - 3 * n - start), z + lost)
            z, rounded = _two_sum(z, moved)
            lost += rounded
            total, rounded = _two_sum(total, squared)
            missing += rounded
        squares[i] = total + missing


@njit(cache=True, nogil=True)
def _moved(s, start, n, count, z):
    """How far the inner sum moves in ``count`` steps from ``z``, and the sum of its squares."""
    a, b = s[start : start + count], s[start + n : start + n + count]
    c, d = s[start + 2 * n : start + 2 * n + count], s[start + 3 * n : start + 3 * n + count]
    moved, squared = 0.0, 0.0
    for k in range(count):
        moved += _second(b[k], c[k], d[k]) - _second(a[k], b[k], c[k])
        squared += (z + moved) ** 2
    return moved, squared
