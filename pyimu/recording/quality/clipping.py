"""Clipped samples."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.special import bdtrc

from pyimu.errors import Finding
from pyimu.recording.quality.resolution import resolution
from pyimu.recording.quality.scatter import scatter

PLATEAU = 0.01
"""Clipped samples lie within this part of the distance from the median to the extreme."""


PILE_UP = 4.0
"""A clipped column has so many times more samples in the plateau than in an equal band below it."""


QUIET = 0.25
"""Inside a plateau the noise is below this part of the noise elsewhere: what is clipped has no
noise."""


LEAST_CLIPPED = 5
"""Fewer samples in a plateau are never called clipped."""


BY_CHANCE = 1e-4
"""Probability that a column whose largest values are no limit visits one as often."""

DEPTHS = (0.5, 0.75, 0.9)
"""Shares of the way from the extreme to the median in which other values are counted: few lie near
the extreme of what is pushed seldom, and of many even the nearest tell."""

LEAST_TOUCHES = 3
"""Fewer visits of an extreme are never called a limit."""

STEPS = 63
"""Steps of a converter below an extreme: a smooth reversal visits them seven times as often."""

ALL_UNSEEN = 3.0
"""Of so many expected, none is seen once in twenty times (Poisson)."""


def clipping_level(values: np.ndarray) -> tuple[float | None, float | None]:
    """(low, high): the levels at which ``values`` (n,) are clipped, None for a side that is not.

    Clipped samples pile up at the extreme, follow each other, and lack the noise of all others.
    They need not be equal: a correction for temperature or cross-axis sensitivity after the
    clipping moves them a little, so the level is their median.
    """
    plateaus = [_plateau(values, sign) for sign in (-1, 1)]
    return tuple(None if not p.any() else float(np.median(values[p])) for p in plateaus)


def touched_level(values: np.ndarray) -> tuple[float | None, float | None]:
    """(low, high): the values at which ``values`` (n,) end that come too often for an extreme, None
    for a side that has none.

    A limit that single samples touch makes no plateau. But two extremes of a motion are the same to
    the last digit as seldom as two other values are, and those are counted (``DEPTHS``). Samples
    that hold a value are one visit. What was corrected by other axes after the clipping has no
    equal values.
    """
    sides = (-1, 1)
    return tuple(s * values[np.nanargmax(s * values)] if _ends(s * values) else None for s in sides)


def _ends(values: np.ndarray) -> bool:
    """Whether the largest of ``values`` (n,) is visited too often for an extreme."""
    visits = values[np.isfinite(values) & np.append(True, values[1:] != values[:-1])]
    if len(visits) < LEAST_CLIPPED:
        return False
    levels, counts = np.unique(visits, return_counts=True)
    if counts[-1] < LEAST_TOUCHES:
        return False
    down = levels[-1] - levels
    # Where a turn reverses smoothly its coarse extreme is visited often, and the steps below it
    # are as well, by the root of how many they are.
    near = (down > 0) & (down < (STEPS + 0.5) * resolution(visits))
    if counts[-1] <= counts[near].sum():
        return False
    depth = down / max(levels[-1] - np.median(visits), np.finfo(float).tiny)
    chances = [_by_chance(int(counts[-1]), counts[:-1][depth[:-1] < d]) for d in DEPTHS]
    return len(DEPTHS) * min(chances) < BY_CHANCE


def _by_chance(ties: int, others: np.ndarray) -> float:
    """The probability of ``ties`` visits or more of an extreme, by the visits of each of the
    ``others`` near it: two of them are equal as often as their pairs are, and of values that
    become rarer towards the extreme those there are no more alike.
    """
    n = int(others.sum())
    equal, pairs = (others * (others - 1) / 2).sum(), n * (n - 1) / 2
    return float(bdtrc(ties - 2, n + ties - 1, min((equal + ALL_UNSEEN) / max(pairs, 1.0), 1.0)))


def clipped(values: np.ndarray) -> np.ndarray:
    """Mask (n,) of the samples at a clipping level."""
    return _plateau(values, -1) | _plateau(values, 1)


def clipping_findings(name: str, values: np.ndarray) -> Iterator[Finding]:
    for sign, side in ((-1, "low"), (1, "high")):
        plateau = _plateau(values, sign)
        if plateau.any():
            yield Finding(
                "clipping",
                name,
                int(plateau.sum()),
                {"side": side, "level": float(np.median(values[plateau]))},
            )


def _plateau(values: np.ndarray, sign: int) -> np.ndarray:
    """Mask of the samples clipped on one side, all False where none are."""
    v, none = sign * values, np.zeros(len(values), bool)
    if np.count_nonzero(np.isfinite(v)) < LEAST_CLIPPED:
        return none
    top = np.nanmax(v)
    # The median, which takes long, is at least the smallest: of most columns this is enough.
    if np.count_nonzero(v >= top - PLATEAU * (top - np.nanmin(v))) < LEAST_CLIPPED:
        return none
    width = PLATEAU * (top - np.nanmedian(v))
    inside = v >= top - width
    below = np.count_nonzero((v >= top - 2 * width) & ~inside)
    count = np.count_nonzero(inside)
    if width <= 0 or count < LEAST_CLIPPED or count <= PILE_UP * below:
        return none
    if below == 0 and count <= PILE_UP * _at_next_level(v, inside, width):
        return none
    deep = _within(inside)
    if not deep.any():
        return none
    curvature = np.abs(np.diff(v, 2))
    # What lies at the other extreme may be as quiet.
    low = np.nanmin(v)
    elsewhere = ~(deep | _within(v <= low + PLATEAU * (np.nanmedian(v) - low)))
    quiet = QUIET * scatter(curvature[elsewhere], 0.25)
    return inside if np.median(curvature[deep]) < quiet else none


def _within(rows: np.ndarray) -> np.ndarray:
    """Marks (n - 2,) of the rows of which those on either side are such ``rows`` (n,), too."""
    return rows[:-2] & rows[1:-1] & rows[2:]


def _at_next_level(v: np.ndarray, inside: np.ndarray, width: float) -> int:
    """How many samples have the largest value that is not ``inside`` a plateau, or are within its
    ``width`` below that and between others that are, too.

    Where a converter's steps are wider than the plateau, the band below it is empty whatever the
    sensor does: a pile is one against the samples of the next step. A bias that was taken out
    since, as by temperature, leaves those of a step unequal.
    """
    rest = v[~inside & np.isfinite(v)]
    if not len(rest):
        return 0
    near = v >= rest.max() - width
    stays = np.concatenate([[False], _within(near), [False]]) & ~inside
    return int(np.count_nonzero((v == rest.max()) | stays))
