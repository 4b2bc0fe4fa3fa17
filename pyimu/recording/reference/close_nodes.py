"""The samples that rows were interpolated from where few rows lie between two of them, or but one.

No rate is seen twice between two such samples, as ``nodes`` looks for. But each row's step is the
sum of the arcs that it overlaps, and there are more rows than arcs: on the right grid least squares
leave nothing of the steps, on any other they leave what is between.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.fft import next_fast_len, rfft
from scipy.linalg import solveh_banded

from pyimu.recording.clock import runs

SLOWEST, FASTEST = 0.3, 0.8
"""Samples to a row; with fewer ``nodes`` sees them, with more hardly anything is left to tell."""

LINES, STANDS_OUT = 6, 6.0
"""Lines of the spectrum that are tried, and the times of its median that they have at least."""

PHASES = 16
"""Places of the grid, over its spacing, that are tried first."""

SECTIONS = (400, 2000, 10_000, 50_000)
"""Rows in which the grid is found, then refined: its spacing is known the better the more."""

NOTHING = 0.02
"""Share of what other places of the grid leave of the steps, of which the right one leaves less."""

Found = tuple[np.ndarray, np.ndarray, np.ndarray]


def met(time: np.ndarray, steps: np.ndarray) -> Found | None:
    """The samples behind rows at ``time`` (n,) with ``steps`` (n - 1, d) between them: their times
    (k,), the rows (k,) before them, and how much further (k, d) they are; None where no grid
    explains the steps.
    """
    step = np.diff(time)
    row = float(np.median(step))
    even = (step < 1.5 * row) & np.isfinite(steps).all(axis=1)
    pieces = [(a, b) for a, b in runs(even) if b - a >= SECTIONS[0]]
    if not pieces:
        return None
    a, b = max(pieces, key=lambda p: p[1] - p[0])
    grid = _grid(time[a : b + 1], steps[a:b], row)
    if grid is None:
        return None
    found = [_samples(time, steps, piece, grid) for piece in pieces]
    at, rows, further = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return at, rows, further


def _grid(time: np.ndarray, steps: np.ndarray, row: float) -> tuple[float, float] | None:
    """First time [s] and spacing [s] of the samples behind rows without a gap."""
    middle = _liveliest(steps)
    for spacing in _spacings(time, steps, row):
        at = _about(middle, SECTIONS[0], len(steps))
        places = float(time[at.start]) + spacing * np.arange(PHASES) / PHASES
        left = [_left(time, steps, at, (p, spacing)) for p in places]
        usual, grid = float(np.median(left)), (float(places[int(np.argmin(left))]), spacing)
        for rows in (*SECTIONS, len(steps)):
            at = _about(middle, rows, len(steps))
            grid = _refined(time, steps, at, grid, row)
            if _left(time, steps, at, grid) > NOTHING * usual:
                break
        else:
            return grid
    return None


def _liveliest(steps: np.ndarray) -> int:
    """The middle of the ``SECTIONS[0]`` rows in which the rate changes most."""
    power = np.append(0.0, np.cumsum(np.sum(np.diff(steps, axis=0) ** 2, axis=1)))
    count = min(SECTIONS[0], len(power) - 1)
    return int(np.argmax(power[count:] - power[:-count])) + count // 2


def _about(middle: int, count: int, rows: int) -> slice:
    """So many of the rows, at most, about one of them."""
    first = max(0, min(middle - count // 2, rows - count))
    return slice(first, min(first + count, rows))


def _spacings(time: np.ndarray, steps: np.ndarray, row: float) -> Iterator[float]:
    """Spacings [s] that the samples may have, the widest first: how much the rate changes from row
    to row keeps their rhythm, or what sampling makes of it.
    """
    rate = steps / np.diff(time)[:, None]
    power = np.sum(np.diff(rate, axis=0) ** 2, axis=1)
    changes = np.log(power + 1e-12 * power.max(initial=0.0) + 1e-300)
    place = np.rint((time[1:-1] - time[0]) / row).astype(int)
    values = np.zeros(place[-1] + 1)
    values[place] = changes - changes.mean()
    size = next_fast_len(4 * len(values), real=True)
    strength = np.abs(rfft(values, size))
    strength[: len(strength) // 50] = 0.0
    least, rates = STANDS_OUT * float(np.median(strength)), set()
    for _ in range(LINES):
        best = int(np.argmax(strength))
        if strength[best] < least:
            break
        frequency = best / size
        rates |= {frequency, 1.0 - frequency}
        strength[max(best - 8, 0) : best + 8] = 0.0
    for frequency in sorted(rates):
        if SLOWEST < frequency < FASTEST:
            yield row / frequency


def _refined(
    time: np.ndarray, steps: np.ndarray, at: slice, grid: tuple[float, float], row: float
) -> tuple[float, float]:
    """The grid that leaves least of the steps of some rows, near a rough one."""
    first, spacing = grid
    number = np.rint((time[at.start] + time[at.stop - 1] - 2 * first) / (2 * spacing))
    middle, half = first + number * spacing, max(1.0, (at.stop - at.start) * row / spacing / 2)

    def left(p: np.ndarray) -> float:
        own = spacing + p[1] * row / half
        if own < 0.5 * spacing:  # a rough one is nearer: a search may go on to no spacing at all
            return np.inf
        return np.log(_left(time, steps, at, (middle + p[0] * row - number * own, own)) + 1e-300)

    simplex = np.array([[0.0, 0.0], [0.08, 0.0], [0.0, 0.08]])
    from scipy.optimize import minimize  # a twentieth of a second, and few logs need it

    found = minimize(left, simplex[0], method="Nelder-Mead", options={"initial_simplex": simplex})
    own = spacing + found.x[1] * row / half
    return float(middle + found.x[0] * row - number * own), float(own)


def _left(time: np.ndarray, steps: np.ndarray, at: slice, grid: tuple[float, float]) -> float:
    """Mean square of the steps of some rows that the arcs between the samples of a grid leave."""
    _, _, rest = _arcs(time[at.start : at.stop + 1], steps[at], grid)
    return float(np.mean(rest**2))


def _arcs(
    time: np.ndarray, steps: np.ndarray, grid: tuple[float, float]
) -> tuple[int, np.ndarray, np.ndarray]:
    """The number of the first arc of a grid, the mean rates (m, d) of all, and what they leave
    (n, d) of the steps.
    """
    first, spacing = grid
    number = np.floor((time - first) / spacing).astype(int)
    begin, end = number[:-1], np.minimum(number[1:], number[:-1] + 1)
    own = np.minimum(time[1:], first + spacing * (begin + 1)) - time[:-1]
    other = np.where(end > begin, np.diff(time) - own, 0.0)
    count, low = int(end.max()) - int(begin.min()) + 1, int(begin.min())
    i, j = begin - low, end - low
    gram = np.zeros((2, count))
    np.add.at(gram[1], i, own**2)
    np.add.at(gram[1], j, other**2)
    np.add.at(gram[0], j, own * other)
    gram[1] += 1e-9 * spacing**2
    right = np.zeros((count, steps.shape[1]))
    np.add.at(right, i, own[:, None] * steps)
    np.add.at(right, j, other[:, None] * steps)
    rates = solveh_banded(gram, right)
    return low, rates, steps - own[:, None] * rates[i] - other[:, None] * rates[j]


def _samples(
    time: np.ndarray, steps: np.ndarray, piece: tuple[int, int], grid: tuple[float, float]
) -> Found:
    """The samples within the rows of a piece without a gap."""
    a, b = piece
    low, rates, _ = _arcs(time[a : b + 1], steps[a:b], grid)
    first, spacing = grid
    numbers = np.arange(low + 1, low + len(rates))
    at = first + spacing * numbers
    inside = (at >= time[a + 1]) & (at <= time[b - 1])
    at, arc = at[inside], rates[numbers[inside] - 1 - low]
    row = np.searchsorted(time, at, side="right") - 1
    return at, row, arc * (at - time[row])[:, None]
