"""Which column of a foreign log is its time, and in which unit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.recording.counter import Unwrapped
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.first_rows import Numbers
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.guess.numbers import SECONDS, STATED, UnitGuess, time_unit
from pyimu.recording.naming.name import Name, named
from pyimu.recording.naming.words import COUNTERS, INERTIAL, NUMBERS, TRUTHS

CLOCK = UnitGuess("s", "dates or times of day, in seconds of the first day")
"""Of a column of them."""

ROUNDED = ", and no time: sheets round long numbers so (1.71E+12), export it with all its digits"
"""What is said of a time that stands still."""

SELDOM = 0.1
"""Share of the steps of a time that may go the other way."""


def add_time(found: Proposal, reader: Reader, numbers: Numbers, rate: float | None) -> float | None:
    """Add the time, or else the ``rate``; gives the sample period [s] where it is known."""
    names = [named(cell) for cell in reader.header]
    clocks = {k for k, cell in enumerate(reader.header) if cell in reader.clocks}
    at = [k for k in numbers.positions if names[k].is_time and not set(names[k].words) & TRUTHS]
    at = at or sorted(clocks)
    at = at or _rising(reader, numbers)
    candidates: list[tuple[int, np.ndarray, UnitGuess]] = []
    disordered: list[tuple[int, np.ndarray, UnitGuess]] = []
    for k in at:
        values = Unwrapped(*SECONDS.values()).add(numbers.of([k]))
        if not (names[k].is_time or k in clocks) and _are_numbers(names[k], values):
            found.notes.append(f"{reader.header[k]} counts the rows, and is no time")
        elif rises(values) or (names[k].is_time or k in clocks) and _mean_rate(values) is not None:
            guess = CLOCK if k in clocks else _time_guess(names[k], values)
            candidates.append((k, values, guess))
        elif (names[k].is_time or k in clocks) and _is_out_of_order(values):
            values = np.sort(values)  # reading says in which row it falls
            guess = CLOCK if k in clocks else _time_guess(names[k], values)
            disordered.append((k, values, guess))
        elif names[k].is_time and len(values) > 1 and np.all(values == values[0]):
            found.notes.append(f"{reader.header[k]} is {values[0]:.6g} in every row{ROUNDED}")
    candidates = candidates or disordered
    if not candidates:
        found.rate = rate or reader.rate
        return None if found.rate is None else 1 / found.rate
    k, values, guess = min(
        candidates,
        key=lambda c: (
            c[2].unit is None,
            reader.crowded and not INERTIAL & set(names[c[0]].words),
            bool(COUNTERS & set(names[c[0]].words)),
            _unevenness(c[1]),
            "stamp" not in names[c[0]].words,
            "date" not in c[2].why,
        ),
    )
    for other, _, its in candidates:
        if other != k:
            found.notes.append(f"{reader.header[other]} may be the time, too ({its.why})")
    found.add([Guess(reader.header[k], "time", guess.unit, guess.why, guess.value)])
    one = STATED.get(guess.unit or "", 0.0) * (guess.value or 1.0)
    if not rises(values):  # whole seconds, say, which reading divides among their rows
        period = one / (_mean_rate(values) or 1.0)
    else:
        period = _period(values) * one
    return period if 1e-6 <= period <= 1e3 else None


def _rising(reader: Reader, numbers: Numbers) -> list[int]:
    """Positions of columns that no name calls a time and that rise as one: among the first two, or
    the last of a table, or of each array in a file of several.
    """
    first = [k for k in numbers.positions[:2] if rises(numbers.of([k]))]
    if first:
        return first
    ends = {array_of(reader.header[k]): k for k in numbers.positions} if reader.crowded else {}
    return [k for k in ends.values() or numbers.positions[-1:] if _is_even(numbers.of([k]))]


def array_of(cell: str) -> str:
    """The array of a file of arrays whose column a ``cell`` is; of a table's it is none."""
    return cell.rpartition("[")[0]


def _mean_rate(values: np.ndarray) -> float | None:
    """Rows a second by times [s] that stand still for many rows, None where they fall or stay."""
    known = values[np.isfinite(values)]
    span = float(known[-1] - known[0]) if len(known) > 1 else 0.0
    return (len(known) - 1) / span if span > 0 and np.all(np.diff(known) >= 0) else None


def _is_even(values: np.ndarray) -> bool:
    """Whether numbers rise in even steps: behind the samples stands their time, or their count."""
    step = np.diff(values.astype(float))
    return rises(values) and float(np.ptp(step)) < SELDOM * float(np.median(step))


def _is_out_of_order(values: np.ndarray) -> bool:
    """Whether times seldom fall, or seldom rise: those of rows that were sorted by something else,
    or of several logs, one behind the other. What is called ``t`` and does both is none.
    """
    step = np.diff(values[np.isfinite(values.astype(float))])
    step = step[step != 0]
    falls = float(np.mean(step < 0)) if len(step) else 0.0
    return 0 < falls < SELDOM or falls > 1 - SELDOM


def rises(values: np.ndarray) -> bool:
    step = np.diff(values[np.isfinite(values.astype(float))])
    return len(step) > 1 and bool(np.all(step >= 0)) and bool(np.mean(step > 0) > 0.5)


def _are_numbers(name: Name, values: np.ndarray) -> bool:
    """Whether values that nobody calls a time number the rows, by the name or as they are; dates
    that stand in the index of a frame do not.
    """
    dated = rises(values) and "date" in time_unit(values).why
    return bool(NUMBERS & set(name.words)) and not dated or _counts_rows(values)


def _counts_rows(values: np.ndarray) -> bool:
    return len(values) > 1 and bool(np.all(np.diff(values.astype(float)) == 1))


def _period(values: np.ndarray) -> float:
    step = np.diff(values[np.isfinite(values)])
    return float(np.median(step[step > 0]))


def _unevenness(values: np.ndarray) -> float:
    """Scatter of the steps in periods, in powers of 1.3: of two clocks that of the sensor is the
    finer one.
    """
    step = np.diff(values[np.isfinite(values)]).astype(float)
    with np.errstate(over="ignore", invalid="ignore"):
        scatter = float(np.std(step) / max(np.median(step), 1e-300))
    known = scatter if np.isfinite(scatter) else np.finfo(float).max  # steps of 1e308
    return round(np.log(max(known, 1e-6)) / np.log(1.3))


def _time_guess(name: Name, values: np.ndarray) -> UnitGuess:
    """The stated unit, but where its rate is none that a sensor has."""
    seen = time_unit(values)
    if name.clock not in STATED:
        return seen
    rate = 1 / (_period(values) * STATED[name.clock])
    if 1e-3 <= rate <= 1e6:
        return UnitGuess(name.clock, f"the header says {name.said}; {rate:.5g} Hz")
    return replace(seen, why=f"{seen.why} (the header says {name.said}: {rate:.3g} Hz)")
