"""Gyro and accelerometer of a foreign log that no name tells, found by their numbers."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence

import numpy as np

from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.clock_column import array_of, rises
from pyimu.recording.guess.first_rows import Numbers
from pyimu.recording.guess.guessed import Proposal
from pyimu.recording.guess.numbers import force_unit, middle, rate_unit, resting_size
from pyimu.recording.naming.name import Name, named
from pyimu.recording.naming.triads import are_alike, others

MOST = 40
"""Columns without names among which sensors are looked for."""

UNIT_LENGTH = 0.02
"""By how much the length of a quaternion of few digits may be off one."""

EXACT = 1e-5
"""No sensor at rest stays so near to one: what does is written so, such as an attitude at rest."""

SAME_SIZE = 1e-3
"""By how much the size of a direction of few digits may differ from row to row."""

TURNED = 0.5
"""How far a vector of one size must go, as a part of it, for its size to be no sensor's: whoever
turns an accelerometer shakes it too."""

TURNS, STEADY = 0.95, 0.1
"""How long the mean direction of a vector is at most that turns, by some 18 deg and more, and by
how much its length may scatter meanwhile."""

Picked = list[tuple[int, Name]] | None
"""Positions and names of the three columns of a vector."""


def by_numbers(
    found: Proposal,
    reader: Reader,
    numbers: Numbers,
    period: float | None,
    away: Container[int],
) -> dict[str, Picked]:
    """The accelerometer's three columns by the size of gravity, the gyro's by how it turns; none of
    those ``away``.
    """
    time = {g.cell for g in found.guesses}
    at = [k for k in numbers.positions if reader.header[k] not in time and k not in away]
    names = [named(cell) for cell in reader.header]
    at = _of_one_length(reader, at, time)
    if len(at) > MOST:
        found.notes.append(f"{len(at)} columns are too many to be told by their numbers")
    if not 3 <= len(at) <= MOST:
        return {"accel": None, "gyro": None}
    table = numbers.of(at).reshape(-1, len(at))
    column = {k: table[:, i] for i, k in enumerate(at)}
    moving = [k for k in at if np.nanmin(column[k]) < np.nanmax(column[k])]
    # One that never changes numbers the sensor: between vectors it is an axis of none.
    at = moving if len(moving) >= 6 else at
    runs = [at[i : i + 3] for i in range(len(at) - 2) if at[i + 2] - at[i] == 2]
    runs = [run for run in runs if are_alike([names[k] for k in run])]
    if not runs:
        return {"accel": None, "gyro": None}
    away = _unit_fours(found, reader, column)
    away |= {k for k, numbers_of_it in column.items() if rises(numbers_of_it)}
    runs = [run for run in runs if not set(run) & away]
    values = {tuple(run): np.column_stack([column[k] for k in run]) for run in runs}
    like = [run for run in values if force_unit(values[run]).fits]
    away |= _directions(found, reader, values, like)
    values = {run: v for run, v in values.items() if not set(run) & away}
    like = [run for run in like if run in values]
    # Beside three that move one that does not is no axis of a force: another channel's, or a flag.
    whole = {k for run in values if set(run) <= set(moving) for k in run}
    like = [run for run in like if set(run) <= set(moving) or not set(run) & whole]
    if not like:
        _without_sign(found, reader, values)
        return {"accel": None, "gyro": None}
    home = {array_of(cell) for cell in time}
    like.sort(key=lambda r: (array_of(reader.header[r[0]]) not in home, _scatter(values[r])))
    apart = {k: i for i, k in enumerate(at)}
    accel, gyro = _belonging(reader, values, like, apart, period)
    _others(found, reader, like, accel)
    picked: dict[str, Picked] = {"accel": [(k, names[k]) for k in accel], "gyro": None}
    if gyro is not None:
        picked["gyro"] = [(k, names[k]) for k in gyro]
    found.notes.append("accelerometer and gyro were told by their numbers alone: look at them")
    return picked


def _of_one_length(reader: Reader, at: list[int], time: Container[str]) -> list[int]:
    """The positions ``at`` of columns as long as the time is, or else as the longest."""
    if not reader.crowded or not at:
        return at
    rows = {k: reader.count(k) or 0 for k in at}
    own = [reader.count(k) or 0 for k, cell in enumerate(reader.header) if cell in time]
    return [k for k in at if rows[k] == max(own or rows.values())]


def _belonging(
    reader: Reader,
    values: Mapping[tuple[int, ...], np.ndarray],
    like: Sequence[tuple[int, ...]],
    apart: Mapping[int, int],
    period: float | None,
) -> tuple[tuple[int, ...], tuple[int, ...] | None]:
    """The accelerometer among those ``like`` one, best first, and the gyro that turns its gravity.

    Where none is seen to, the gyro is the first vector that is like no force, and of several forces
    the one nearest before it is the accelerometer: a table of several units has each by itself.
    """
    several = []
    forces = {k for run in _apart(like) for k in run}
    for accel in like:
        home = {array_of(reader.header[accel[0]])}
        rest = [run for run in values if not set(run) & set(accel)]
        rest = [run for run in rest if abs(apart[run[0]] - apart[accel[0]]) % 3 == 0]
        rest.sort(key=lambda run: array_of(reader.header[run[0]]) not in home)
        guesses = {run: rate_unit(values[run], values[accel], period) for run in rest}
        for run, guess in guesses.items():
            if guess.unit is not None and "gravity" in guess.why:
                return accel, run
        rest = [run for run in rest if not set(run) & forces]
        if rest:
            fast = (run for run in rest if guesses[run].unit is not None)
            several.append((accel, next(fast, rest[0])))
    if not several:
        return like[0], None
    return min(several, key=lambda pair: abs(apart[pair[0][0]] - apart[pair[1][0]]))


def _apart(like: Sequence[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Those of the vectors, best first, that share no column with a better one."""
    found: list[tuple[int, ...]] = []
    for run in like:
        if not any(set(run) & set(better) for better in found):
            found.append(run)
    return found


def _others(
    found: Proposal, reader: Reader, like: Sequence[tuple[int, ...]], accel: tuple[int, ...]
) -> None:
    """Note the vectors that are an accelerometer by their numbers as well."""
    for run in sorted(_apart([accel, *like])):
        if run != accel:
            cells = ", ".join(reader.header[k] for k in run)
            found.notes.append(f"{cells} may be the accel, too")


def _without_sign(
    found: Proposal, reader: Reader, values: Mapping[tuple[int, ...], np.ndarray]
) -> None:
    """Note the first vector of counts that may be a force's and have no sign."""
    for run, vector in values.items():
        if middle(vector) is not None:
            cells = ", ".join(reader.header[k] for k in run)
            found.notes.append(f"{cells} may be the accel: {force_unit(vector).why}")
            return


def _directions(
    found: Proposal,
    reader: Reader,
    values: Mapping[tuple[int, ...], np.ndarray],
    like: Sequence[tuple[int, ...]],
) -> set[int]:
    """Positions in those of the vectors ``like`` a force that keep one size however they turn.

    So does the direction of gravity that a phone's filter makes; that it is left out is noted.
    """
    away: set[int] = set()
    for run in like:
        if not set(run) & away and _is_direction(values[run]):
            away |= set(run)
            cells = ", ".join(reader.header[k] for k in run)
            found.notes.append(
                f"{cells} are left out: they turn and keep their size, as the direction of gravity "
                "that a filter makes does; an accelerometer is shaken too"
            )
    return away


def _is_direction(vector: np.ndarray) -> bool:
    known = vector[np.all(np.isfinite(vector), axis=1)]
    size = np.linalg.norm(known, axis=1)
    middle = float(np.median(size)) if len(size) else 0.0
    steady = bool(middle) and float(np.max(np.abs(size - middle))) < SAME_SIZE * middle
    return steady and float(np.max(np.ptp(known, axis=0))) > TURNED * middle


def _unit_fours(found: Proposal, reader: Reader, column: Mapping[int, np.ndarray]) -> set[int]:
    """Positions in any four neighbouring columns that are a quaternion by their numbers.

    That they are left out goes into the notes: which of them is w nobody knows.
    """
    away: set[int] = set()
    for k in column:
        four = [k + i for i in range(4)]
        if set(four) <= column.keys() and not set(four) & away:
            if _is_quaternion(np.column_stack([column[i] for i in four])):
                away |= set(four)
                cells = [reader.header[i] for i in four]
                found.notes.append(
                    f"{', '.join(cells)} are left out: their squares add up to 1, as those of an "
                    "attitude do (ref_q_w, ref_q_x, ref_q_y, ref_q_z)"
                )
                for where, axes in (("first", "wxyz"), ("last, as of ROS", "xyzw")):
                    lines = (f'"{c}" = "ref_q_{a} [1]"' for c, a in zip(cells, axes, strict=True))
                    found.notes.append(f"with the scalar {where}: {', '.join(lines)}")
    return away


def _is_quaternion(four: np.ndarray) -> bool:
    """Whether four columns (n, 4) are of length one in every row in which they have any.

    So is an accelerometer at rest, in g, beside a gyro: three columns are of length one then.
    """
    known = four[np.all(np.isfinite(four), axis=1) & np.any(four != 0, axis=1)]
    if not len(known):
        return False
    off, *of_three = (
        float(np.max(np.abs(np.linalg.norm(some, axis=1) - 1.0)))
        for some in (known, known[:, :3], known[:, 1:])
    )
    return off < EXACT or (off < UNIT_LENGTH and all(three > 3 * off for three in of_three))


def missing(
    found: Proposal,
    group: str,
    reader: Reader,
    numbers: Numbers,
    picked: dict[str, Picked],
    period: float | None,
    named_ones: Sequence[int],
) -> Picked:
    """The vector of ``group`` that no name tells, beside the others, where its numbers tell it.

    A vector that may be it is noted else.
    """
    force = None if picked["accel"] is None else numbers.of([p for p, _ in picked["accel"]])
    taken = [p for known in picked.values() if known is not None for p, _ in known]
    names = [named(cell) for cell in reader.header]
    for at in others(reader.header, [*taken, *named_ones]):
        if not set(at) <= set(numbers.positions):
            continue
        values = numbers.of(at)
        guess = force_unit(values) if group == "accel" else rate_unit(values, force, period)
        cells = ", ".join(reader.header[k] for k in at)
        if guess.fits and (group == "accel" or "gravity" in guess.why):
            found.notes.append(f"{cells} were taken for the {group} by their numbers alone")
            return [(k, names[k]) for k in at]
        found.notes.append(f"{cells} are left out: they may be the {group} ({guess.why})")
    return None


def keeps_its_size(vector: np.ndarray) -> bool:
    """Whether a vector (n, 3) turns far and stays as long as it is, as gravity does in a hand."""
    known = vector[np.isfinite(vector).all(axis=1)]
    size = np.linalg.norm(known, axis=1)
    if not len(known) or not size.all():
        return False
    straight = float(np.linalg.norm((known / size[:, None]).mean(axis=0)))
    return straight < TURNS and float(np.std(size) / np.mean(size)) < STEADY


def _scatter(force: np.ndarray) -> float:
    """Relative scatter of the size of a vector: of the specific force at rest it is small."""
    size = np.linalg.norm(force, axis=1)
    return float(np.nanstd(size) / (resting_size(force) or 1.0))
