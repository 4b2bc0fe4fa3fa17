"""Other readings of a triad's axes, and which of them span by span is clearly the better one."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np
from scipy.special import stdtr

from pyimu.recording.columns import XYZ

BY_CHANCE = 1e-6
"""Probability that a reading is believed that is no better than the stated one."""

TINY = 1e-30
"""A scatter below which all are alike; that of a magnetic field in T^2 is small."""


def changed(matrix: np.ndarray) -> float:
    """How much a signed permutation (3, 3) changes: a swap of two axes as much as one sign."""
    return np.count_nonzero(np.diag(matrix) == 0) / 2 + np.count_nonzero(matrix < 0)


def _signed_permutations() -> np.ndarray:
    """All matrices (48, 3, 3) that swap axes and turn their signs, those of few changes first."""
    orders, signs = permutations(range(3)), list(product((1.0, -1.0), repeat=3))
    found = [np.eye(3)[list(o)] * np.array(s)[:, None] for o in orders for s in signs]
    return np.array(sorted(found, key=changed))


READINGS = _signed_permutations()
"""(48, 3, 3), times the stated columns the right ones; the first is the identity."""


def clearly_less(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether the scatters ``one`` (m,) are smaller than ``other`` (m,), by more than chance.

    Student's t of the logarithms of their ratios, span by span: so one of a shock decides nothing.
    """
    ratios = np.log(np.maximum(other, TINY) / np.maximum(one, TINY))
    if len(ratios) < 3 or not ratios.std() > 0:
        return False
    t = ratios.mean() / (ratios.std(ddof=1) / np.sqrt(len(ratios)))
    return bool(stdtr(len(ratios) - 1, t) > 1 - BY_CHANCE)


def likely(scatters: np.ndarray, without: np.ndarray, costs: np.ndarray) -> list[int]:
    """Which of c readings may be the right one by their ``scatters`` (c, m) in m spans.

    Those than which none is clearly better, the cheapest by their ``costs`` (c,) first, of equal
    ones that of the least scatter. So the stated one, if that costs nothing, is the first unless
    another is clearly better. None where the best explains nothing: where the scatter is not
    clearly less than ``without`` any (m,).
    """
    sizes = np.sum(np.log(np.maximum(scatters, TINY)), axis=1)
    best = scatters[np.argmin(sizes)]
    if not clearly_less(best, without):
        return []
    left = [i for i, own in enumerate(scatters) if not clearly_less(best, own)]
    return sorted(left, key=lambda i: (costs[i], sizes[i]))


def reading_named(axes: str) -> np.ndarray:
    """The matrix (3, 3) of which ``named`` gives this text."""
    return next(matrix for matrix in READINGS if named(matrix) == axes)


def named(matrix: np.ndarray) -> str:
    """What the stated columns are by a reading, as "x is -y"; those that stay are left out."""
    said = []
    for right, row in zip(XYZ, matrix, strict=True):
        column = int(np.argmax(np.abs(row)))
        sign = "-" if row[column] < 0 else ""
        if sign or XYZ[column] != right:
            said.append(f"{right} is {sign}{XYZ[column]}")
    return ", ".join(said)
