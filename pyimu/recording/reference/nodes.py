"""The samples that an attitude was interpolated from along shortest arcs, or its angles along
lines, as a position is.

Between two of them its rate is constant, and jumps at each: the interpolation, not the motion. The
samples lie between the rows: by how much of either arc's rate the step that holds one has.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from scipy.fft import next_fast_len, rfft
from scipy.spatial.transform import Rotation, Slerp

from pyimu.recording.recording import Recording, at_own_times
from pyimu.recording.reference import close_nodes, spline_nodes

LEAST = 16
"""Samples that must be seen."""

LINE, BY_CHANCE = 0.01, 30.0
"""Share of their power that the flags of a constant rate have in one line, at least, if they keep
a rhythm, and the same times their number: of what has none, the strongest line has some ten over
their number. Jumps that are a hundred rows apart have fifty lines, each of a fiftieth."""

STANDS = 1e-12
"""rad or m; a smaller step is rounding."""

ROUNDS = 3

JUMP = 10.0
"""Times the changes that are none: by so much a rate must jump to show where."""

REGULAR = 0.05
"""The meetings lie on an even grid to this part of its spacing."""

HOLDS = 0.95
"""Share of the changes of rate between two samples of the grid that must be as good as none."""

LINES, ALIKE = 8, 0.8
"""Lines that are tried, as strong as the strongest but for this factor."""

CLOSE = 0.05
"""A sample of the grid so near to a row, in rows, counts on either side of it."""


SEQUENCES = ("ZYX", "XYZ")
"""In which the angles may turn that were joined along lines."""

NOTHING = 0.05
"""Share of what arcs leave of the rows, of which lines leave less where angles were joined so."""

Met = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Times (k,) of samples, the rows (k,) before them, and how much further (k, d) they are."""

Meet = Callable[[np.ndarray, np.ndarray], Met | None]
"""What finds these among rows at times (n,) with steps (n - 1, d) between them."""

Own = tuple[np.ndarray, Rotation]
"""Times (k,) and attitudes of samples."""


def own_samples(source: Recording) -> Recording:
    """The reference with the samples of ``ref_q`` that its rows were interpolated from, where they
    were along shortest arcs, roll, pitch and yaw along lines, or every second to tenth row, joined
    by a spline; else as it is.
    """
    known = np.flatnonzero(np.isfinite(source.ref_q).all(axis=1))
    if len(known) < 4 * LEAST:
        return source
    time = source.time[known]
    attitude = Rotation.from_quat(source.ref_q[known], scalar_first=True)
    steps = (attitude[:-1].inv() * attitude[1:]).as_rotvec()
    if _is_held(steps):
        return source
    far = _joined(_met_far, time, steps, attitude)
    splined = spline_nodes.every(time, attitude) if far is None and _is_even(time) else None
    if splined is not None:
        rows = known[splined[0] :: splined[1]]
        return at_own_times(source, source.time[rows], ref_q=source.ref_q[rows])
    found = far or _joined(close_nodes.met, time, steps, attitude)
    if found is None:
        return source
    at, own = found
    return at_own_times(source, at, ref_q=own.as_quat(scalar_first=True))


def _joined(meet: Meet, time: np.ndarray, steps: np.ndarray, attitude: Rotation) -> Own | None:
    """The samples that are met along arcs; those of angles where lines between them leave hardly
    anything of what arcs do.
    """
    met, best, least = meet(time, steps), None, np.inf
    if met is not None:
        best = met[0], attitude[met[1]] * Rotation.from_rotvec(met[2])
        least = NOTHING * _left(time, attitude, best[0], Slerp(*best))
    for sequence in SEQUENCES:
        own, left = _along_lines(meet, time, attitude, sequence)
        if own is None or left >= least:
            continue
        if left < NOTHING * _left(time, attitude, own[0], Slerp(*own)):
            best, least = own, left
    return best


def _along_lines(
    meet: Meet,
    time: np.ndarray,
    attitude: Rotation,
    sequence: str,
) -> tuple[Own | None, float]:
    """The samples between which the angles of a ``sequence`` lie on lines, and what lines between
    them leave of the rows.
    """
    angles = np.unwrap(attitude.as_euler(sequence), axis=0)
    met = meet(time, np.diff(angles, axis=0))
    if met is None:
        return None, np.inf
    at, row, further = met
    nodes = angles[row] + further

    def lines(t: np.ndarray) -> Rotation:
        columns = [np.interp(t, at, column) for column in nodes.T]
        return Rotation.from_euler(sequence, np.column_stack(columns))

    return (at, lines(at)), _left(time, attitude, at, lines)


def _along_arcs(met: Met, attitude: Rotation) -> Own:
    at, row, further = met
    return at, attitude[row] * Rotation.from_rotvec(further)


def _left(
    time: np.ndarray, attitude: Rotation, at: np.ndarray, curve: Callable[[np.ndarray], Rotation]
) -> float:
    """Median rad of what a curve through the samples ``at`` some times leaves of the rows."""
    inside = (time >= at[0]) & (time <= at[-1])
    return float(np.median((curve(time[inside]).inv() * attitude[inside]).magnitude()))


def own_places(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times (k,) and values (k, d) that ``values`` (n, d) at ``time`` (n,), all known, were
    interpolated from along lines, where they were; else as they are.
    """
    found = _met(time, np.diff(values, axis=0)) if len(time) >= 4 * LEAST else None
    if found is None:
        return time, values
    at, row, further = found
    return at, values[row] + further


def _met(time: np.ndarray, steps: np.ndarray) -> Met | None:
    """The samples behind rows at ``time`` (n,) with ``steps`` (n - 1, d) between them; None where
    there are none.
    """
    if _is_held(steps):
        return None
    return _met_far(time, steps) or close_nodes.met(time, steps)


def _met_far(time: np.ndarray, steps: np.ndarray) -> Met | None:
    """The same of samples between which there are two rows at least."""
    step = np.diff(time)
    rate = steps / step[:, None]
    rate[step > 1.5 * np.median(step)] = np.nan
    grid = _grid(time, rate)
    if grid is None:
        return None
    at, row = _placed(time, grid)
    # The step before that which holds a sample belongs to the arc that ends at it.
    good = np.isfinite(rate[row - 1]).all(axis=1) & np.isfinite(rate[row]).all(axis=1)
    at, row = at[good], row[good]
    return at, row, rate[row - 1] * (at - time[row])[:, None]


def _is_even(time: np.ndarray) -> bool:
    """Whether times (n,) have no gap."""
    step = np.diff(time)
    return bool(step.max() < 1.5 * np.median(step))


def _is_held(steps: np.ndarray) -> bool:
    """Whether values were repeated until the next one came: beside a step there is none."""
    none = np.linalg.norm(steps, axis=1) <= STANDS
    beside = np.append(none[1:], True) | np.append(True, none[:-1])
    return bool(np.mean(beside[~none]) > 0.5) if not none.all() else False


def _grid(time: np.ndarray, rate: np.ndarray) -> tuple[float, float] | None:
    """First time [s] and spacing [s] of the samples behind rows at ``time`` (n,) with the mean
    rates (n - 1, 3) between them; None where there are none.
    """
    change = np.linalg.norm(np.diff(rate, axis=0), axis=1)
    seen = np.isfinite(change)
    if np.count_nonzero(seen) < 4 * LEAST:
        return None
    low, high = np.quantile(change[seen], (0.05, 0.99))
    least = low ** (2 / 3) * high ** (1 / 3)
    same = change <= least
    for rough in _rhythms(time, same, seen):
        grid: tuple[float, float] | None = rough
        for _ in range(ROUNDS):
            grid = _refined(time, rate, grid, JUMP * least) if grid else None
        if grid and _explains(time, change, seen, grid):
            return _widest(time, change, seen, grid)
    return None


def _widest(
    time: np.ndarray, change: np.ndarray, seen: np.ndarray, grid: tuple[float, float]
) -> tuple[float, float]:
    """The grid, or every second or third of its places where the rate changes at these alone."""
    first, spacing = grid
    at = seen & _holds_one(time, grid)
    for n, k in ((n, k) for n in (2, 3) for k in range(n)):
        wider = first + k * spacing, n * spacing
        kept = at & _holds_one(time, wider)
        if kept.any() and (at & ~kept).any():
            jumps, others = (np.quantile(change[m], 0.75) for m in (kept, at & ~kept))
            if JUMP * others < jumps:
                return _widest(time, change, seen, wider)
    return grid


def _holds_one(time: np.ndarray, grid: tuple[float, float]) -> np.ndarray:
    """Marks (n - 2,) of the changes of the rate between whose rows a sample of a grid lies."""
    first, spacing = grid
    close = CLOSE * float(np.median(np.diff(time)))
    begin, end = (np.floor((t - first) / spacing) for t in (time[:-2] - close, time[2:] + close))
    return begin != end


def _rhythms(time: np.ndarray, same: np.ndarray, seen: np.ndarray) -> Iterator[tuple[float, float]]:
    """First times and spacings that the samples may have between which changes (n - 2,) are the
    ``same``: the strongest lines in the spectrum of these flags, where any stands out.

    Flags of rows that keep step with the samples have harmonics as strong.
    """
    row = float(np.median(np.diff(time)))
    place = np.rint((time[1:-1] - time[0]) / row).astype(int)
    flags = np.zeros(place[-1] + 1)
    flags[place[seen]] = same[seen] - np.mean(same[seen])
    size = next_fast_len(4 * len(flags), real=True)
    spectrum = rfft(flags, size)
    strength = np.abs(spectrum)
    strength[:LEAST] = 0.0
    strongest, power = strength.max(), np.sum(flags**2) * len(flags)
    least = max(LINE, BY_CHANCE / len(flags))
    for _ in range(LINES):
        best = int(np.argmax(strength))
        if strength[best] <= max(ALIKE * strongest, np.sqrt(least * power)):
            return
        frequency = best / (size * row)
        middle = -np.angle(spectrum[best]) / (2 * np.pi * frequency)
        yield float(time[0] + middle + 0.5 / frequency), 1 / frequency
        strength[max(best - LEAST, 0) : best + LEAST] = 0.0


def _refined(
    time: np.ndarray, rate: np.ndarray, grid: tuple[float, float], least: float
) -> tuple[float, float] | None:
    """The even grid through the times at which the rate jumps by ``least`` or more, near those of a
    rough grid; None where they do not lie on one.
    """
    at, row = _placed(time, grid)
    before, inside, after = rate[row - 1], rate[row], rate[np.minimum(row + 1, len(rate) - 1)]
    jump = before - after
    power = np.sum(jump**2, axis=1)
    share = np.sum((inside - after) * jump, axis=1) / np.where(power > 0, power, np.nan)
    with np.errstate(invalid="ignore"):
        clear = (power > least**2) & (np.abs(share - 0.5) < 0.6)
    found = (time[row] + share * (time[row + 1] - time[row]))[clear]
    if len(found) < LEAST:
        return None
    number = np.rint((at[clear] - grid[0]) / grid[1])
    for _ in range(2):
        spacing, first = np.polyfit(number, found, 1)
        off = np.abs(found - first - spacing * number)
        near = off <= np.median(off) * 5
        found, number = found[near], number[near]
    regular = len(found) >= LEAST and np.median(off) < REGULAR * spacing
    return (float(first), float(spacing)) if regular else None


def _explains(
    time: np.ndarray, change: np.ndarray, seen: np.ndarray, grid: tuple[float, float]
) -> bool:
    """Whether the rate has changes (n - 2,) where samples of a grid lie and hardly any elsewhere;
    these are two rows apart at least, or no arc is seen.
    """
    if grid[1] < 2 * float(np.median(np.diff(time))):
        return False
    at = _holds_one(time, grid)
    free, others = seen & ~at, seen & at
    if not free.any() or not others.any():
        return False
    # Beside a sample that lies at a row itself two changes of three are none as well.
    jumps = np.quantile(change[others], 0.75)
    return bool(JUMP * np.quantile(change[free], HOLDS) < jumps)


def _placed(time: np.ndarray, grid: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Times (k,) of the grid from the second row to the last but one, and the rows (k,) before."""
    first, spacing = grid
    low, high = (int(np.ceil((t - first) / spacing)) for t in (time[1], time[-1]))
    at = first + spacing * np.arange(low, high)
    return at, np.searchsorted(time, at, side="right") - 1
