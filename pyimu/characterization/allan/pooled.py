"""Allan deviations of a record with gaps, pooled over its segments, and their moments.

No difference reaches over a gap. Each segment gives its own overlapping estimate, and the pooled
one is their mean weighted by the number of their differences, which is what one sum over all
differences would be. Segments are taken to be independent: for noise with a long memory the weights
are then not the best ones, but the estimate is no less right.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np

from pyimu.characterization.allan.deviation import overlapping_deviation
from pyimu.characterization.allan.moments import RAMP, AllanMoments, moments

Deviation = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Rates (n,) and cluster sizes (t,) to deviations (t,)."""

Segment = tuple[int, int]
"""Rows from start to stop (excluded) without gap."""

FEW, MOST = 40, 4000
"""Up to ``FEW`` segments are used as they are. Of more, up to ``MOST``, the ends are cut so that
there are few different lengths."""

LADDER = 2 ** (1 / 8)
"""Ratio of the lengths that segments are cut to. Moments are made once for each length, and take
as long for a short one as for a day."""

SHORTEST = 0.01
"""A segment is used from this share of the longest on."""


def used_segments(segments: Sequence[Segment]) -> list[Segment]:
    """The segments from which deviations are made, in the order of time.

    They are the ``MOST`` longest of those that are at least ``SHORTEST`` as long as the longest;
    where they are more than ``FEW``, their ends are cut.
    """
    if not segments:
        return []
    size = [b - a for a, b in segments]
    order = sorted(range(len(segments)), key=lambda i: -size[i])[:MOST]
    used = [segments[i] for i in sorted(order) if size[i] >= SHORTEST * max(size)]
    return used if len(used) <= FEW else [(a, a + _cut(b - a, max(size))) for a, b in used]


def _cut(length: int, whole: int) -> int:
    """The next length below, of those that fall from ``whole`` by the factor ``LADDER``."""
    steps = math.ceil(math.log(whole / length) / math.log(LADDER) - 1e-9)
    return max(int(whole / LADDER**steps), 1)


def differences(m: np.ndarray, lengths: Sequence[int]) -> np.ndarray:
    """Number (s, t) of overlapping differences of segments of ``lengths`` (s,) at sizes m (t,)."""
    return np.maximum(np.array(lengths)[:, None] - 2 * np.asarray(m) + 1, 0)


def pooled_deviation(
    records: Sequence[np.ndarray],
    m: np.ndarray,
    deviation: Deviation = overlapping_deviation,
    order: int = 2,
) -> np.ndarray:
    """Deviation (t,) of the ``records`` (n_i,) together, each the rates of one segment.

    ``deviation`` is one of ``allan.deviation``, ``order`` the clusters that it takes in a row;
    so many of each of the sizes ``m`` (t,) must fit into the longest record.
    """
    m = np.asarray(m)
    total, count = np.zeros(len(m)), np.zeros(len(m))
    for rates in records:
        fits = order * m <= len(rates)
        if fits.any():
            terms = len(rates) - order * m[fits] + 1
            total[fits] += terms * deviation(rates, m[fits]) ** 2
            count[fits] += terms
    return np.sqrt(total / count)


@lru_cache(maxsize=8)
def pooled_moments(
    m: tuple[int, ...], lengths: tuple[int, ...], times: tuple[float, ...] = ()
) -> AllanMoments:
    """Moments at cluster sizes ``m`` of Allan variances pooled over segments of these lengths.

    ``times`` are those of ``moments``.
    """
    sizes = np.array(m)
    if len(lengths) == 1:
        return moments(sizes, lengths[0], times)
    alike = Counter(lengths)
    share = differences(sizes, list(alike)) / differences(sizes, lengths).sum(axis=0)
    t, k, design = len(sizes), 4 + len(times), None
    products, sums = np.zeros((k, k, t, t)), np.zeros((k, t, t))
    for weight, (n, count) in zip(share, alike.items(), strict=True):
        fits = np.flatnonzero(2 * sizes <= n)
        if len(fits):
            one, both = moments(sizes[fits], n, times), np.ix_(fits, fits)
            pair = count * np.outer(weight[fits], weight[fits])
            products[(slice(None), slice(None), *both)] += pair * one.products
            sums[(slice(None), *both)] += pair * one.sums
            design = one.design if design is None or len(one.design) > len(design) else design
    return AllanMoments(sizes.astype(float), design, products, sums)


@lru_cache(maxsize=8)
def freedom_parts(
    m: tuple[int, ...], lengths: tuple[int, ...], times: tuple[float, ...] = ()
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The moments of each cluster size by itself.

    They are ``design`` (t, k), and the diagonals (t, k - 1, k - 1) of ``products`` and (t, k - 1)
    of ``sums``.
    """
    each = [
        pooled_moments.__wrapped__((k,), tuple(n for n in lengths if n >= 2 * k), times) for k in m
    ]
    return (
        np.concatenate([e.design for e in each]),
        np.array([e.products[:, :, 0, 0] for e in each]),
        np.array([e.sums[:, 0, 0] for e in each]),
    )


def equivalent_freedom(
    m: np.ndarray, lengths: Sequence[int], squares: np.ndarray, times: tuple[float, ...] = ()
) -> np.ndarray:
    """Equivalent degrees of freedom (t,), 2 mean^2 / variance, of pooled Allan variances.

    ``squares`` (k,) are those of the coefficients of the noise, for a sample period of one, with
    the variances of Gauss-Markov noise of correlation ``times`` behind those of the five terms.
    Flicker and a random walk make long clusters depend on each other more than white noise does; a
    ramp, which is no noise, does not count.
    """
    design, products, _ = freedom_parts(
        tuple(int(k) for k in m), tuple(int(n) for n in lengths), times
    )
    noise = np.delete(squares, RAMP)
    mean = np.delete(design, RAMP, axis=1) @ noise
    return mean**2 / np.einsum("i,j,tij->t", noise, noise, products)
