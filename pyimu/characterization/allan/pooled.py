"""Records with gaps: the stretches between them, and Allan deviations and their moments pooled over
the stretches.

A difference that would reach over a gap is not made. Each stretch gives its own overlapping
estimate, and the pooled one is their mean weighted by the number of their differences, which is
what one sum over all of them would be. Stretches are taken to be independent: for noise with a
long memory that makes the weights less than the best, and the estimate no less right.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from pyimu.characterization.allan.deviation import overlapping_deviation
from pyimu.characterization.allan.moments import AllanMoments, moments

FEW, MOST = 40, 4000
"""Up to so many stretches are used as they are; of more, up to the second, the ends are cut so that
there are few different lengths."""

LADDER = 2 ** (1 / 8)
"""Ratio of the lengths that stretches are cut to: moments take as long for a short one as for a
day, and are made once for each."""

SHORTEST = 0.01
"""A stretch is used from this share of the longest on."""


def longest(found: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """The stretches that are used: the ``MOST`` longest of those that are at least ``SHORTEST`` as
    long as the longest, in the order of time.
    """
    if not found:
        return []
    size = [b - a for a, b in found]
    order = sorted(range(len(found)), key=lambda i: -size[i])[:MOST]
    used = [found[i] for i in sorted(order) if size[i] >= SHORTEST * max(size)]
    return used if len(used) <= FEW else [(a, a + _cut(b - a, max(size))) for a, b in used]


def _cut(length: int, whole: int) -> int:
    """The next length below, of those that fall from ``whole`` by ``LADDER``."""
    steps = math.ceil(math.log(whole / length) / math.log(LADDER) - 1e-9)
    return max(int(whole / LADDER**steps), 1)


def differences(m: np.ndarray, lengths: Sequence[int]) -> np.ndarray:
    """How many overlapping differences each stretch gives (s, t), for cluster sizes ``m`` (t,)."""
    return np.maximum(np.array(lengths)[:, None] - 2 * np.asarray(m) + 1, 0)


def pooled_deviation(
    pieces: Sequence[np.ndarray], m: np.ndarray, deviation=overlapping_deviation, order: int = 2
) -> np.ndarray:
    """Deviation (t,) of all the ``pieces`` (n_i,) together at cluster sizes ``m`` (t,), of which
    ``order`` must fit into the longest.
    """
    m = np.asarray(m)
    total, count = np.zeros(len(m)), np.zeros(len(m))
    for piece in pieces:
        fits = order * m <= len(piece)
        if fits.any():
            terms = len(piece) - order * m[fits] + 1
            total[fits] += terms * deviation(piece, m[fits]) ** 2
            count[fits] += terms
    return np.sqrt(total / count)


@lru_cache(maxsize=8)
def pooled_moments(m: tuple[int, ...], lengths: tuple[int, ...]) -> AllanMoments:
    """Moments of the pooled Allan variances at cluster sizes ``m``, for stretches of these lengths
    in samples.
    """
    sizes = np.array(m)
    if len(lengths) == 1:
        return moments(sizes, lengths[0])
    alike = Counter(lengths)
    share = differences(sizes, list(alike)) / differences(sizes, lengths).sum(axis=0)
    t, design = len(sizes), None
    products, sums = np.zeros((4, 4, t, t)), np.zeros((4, t, t))
    for weight, (n, count) in zip(share, alike.items(), strict=True):
        fits = np.flatnonzero(2 * sizes <= n)
        if len(fits):
            one, both = moments(sizes[fits], n), np.ix_(fits, fits)
            pair = count * np.outer(weight[fits], weight[fits])
            products[(slice(None), slice(None), *both)] += pair * one.products
            sums[(slice(None), *both)] += pair * one.sums
            design = one.design if design is None or len(one.design) > len(design) else design
    return AllanMoments(sizes.astype(float), design, products, sums)


@lru_cache(maxsize=8)
def freedom_parts(
    m: tuple[int, ...], lengths: tuple[int, ...]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """``design`` (t, 5), and the diagonals ``products`` (t, 4, 4) and ``sums`` (t, 4), of the
    moments of each size by itself.
    """
    each = [pooled_moments.__wrapped__((k,), tuple(n for n in lengths if n >= 2 * k)) for k in m]
    return (
        np.concatenate([e.design for e in each]),
        np.array([e.products[:, :, 0, 0] for e in each]),
        np.array([e.sums[:, 0, 0] for e in each]),
    )


def equivalent_freedom(m: np.ndarray, lengths: Sequence[int], squares: np.ndarray) -> np.ndarray:
    """Equivalent degrees of freedom (t,), 2 mean^2 / variance, of each Allan variance where the
    noise has these squares (5,).

    ``squares`` are those of the coefficients for a sample period of one. A term of flicker or of a
    random walk makes the long clusters depend on each other more than white noise does; a ramp,
    which is no noise, does not count.
    """
    design, products, _ = freedom_parts(tuple(int(k) for k in m), tuple(int(n) for n in lengths))
    noise = squares[:4]
    mean = design[:, :4] @ noise
    return mean**2 / np.einsum("i,j,tij->t", noise, noise, products)
