"""Dates and times of day in words of digits: ``2024-02-01T12:00:00.010Z``, ``12:00:00,010``.

A date that ends with its year may have its day first or its month: of ``2/1/2024 12:00:00`` the
time of day alone counts, and of ``Wed Dec 22 21:09:46 2021`` and ``01-Feb-2024 12:00:00.010``.
Phones write milliseconds behind a third colon, ``12:00:00:010``, cameras frames or hundredths,
``12:00:00:24``, spreadsheets AM or PM behind the time, and pandas' spans the days before it, ``0
days 00:00:00.010``. Spreadsheets show times with parts of a second without their hours,
``59:59.9``, and MATLAB spans with their unit, ``0.01 sec``. Programs write both without signs,
``20240201_120000_010``.

And those that Parquet files and data frames hold as such, with spans of time.
"""

from __future__ import annotations

import re

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

_WEEKDAY = "(?:Mon|Tue|Wed|Thu|Fri|Sat|Sun)"
_MONTH = "(?:Jan|Feb|Mar|Apr|May|Jun|Jul|Aug|Sep|Oct|Nov|Dec)"

_PATTERN = (
    r"^\s*(?:(?P<year>\d{4})[-/](?P<month>\d{1,2})[-/](?P<day>\d{1,2})[T ]\s*"
    r"|\d{1,2}[-/.]\d{1,2}[-/.](?:\d{4}|\d{2})[T ]\s*"
    rf"|{_WEEKDAY} {_MONTH} +\d{{1,2}} |\d{{1,2}}-{_MONTH}-\d{{4}} "
    r"|(?P<days>\d{1,5}) days? )?"
    r"(?:(?P<hour>\d{1,2}):(?P<minute>\d{2}):(?P<second>\d{2})"
    r"(?:[.,](?P<part>\d{1,9})\d*|:(?P<thousandths>\d{3})|:(?P<frames>\d{2}))?"
    r"|(?P<span>\d+(?:\.\d+)?(?:[eE][-+]?\d+)?) (?P<unit>sec|min|hr)"
    r"|(?P<minutes>\d{1,3}):(?P<of_minute>\d{2})[.,](?P<of_second>\d{1,9}))"
    r"(?:\s*(?P<noon>[AaPp])\.?[Mm]\.?)?"
    r"\s*(?:Z|UTC|(?P<zone>[-+]\d{2}:?\d{2})| \d{4})?\s*$"
)

_RUN_TOGETHER = re.compile(
    r"^\s*((?:19|20)\d{2})(0[1-9]|1[0-2])(0[1-9]|[12]\d|3[01])[-_ T]?"
    r"([01]\d|2[0-3])([0-5]\d)([0-5]\d)(?:[._]?(\d{1,9}))?\s*$"
)
"""A date and a time without signs between them, ``20240201120000.010``."""

_PARTED = r"\1-\2-\3T\4:\5:\6.\g<7>0"

DAY, HOUR = 86400, 3600
"""s."""

NEARLY = 0.99
"""Part of half a day by which times on a dial of twelve hours fall, from 12:59 to 1:00."""

FRAMES = (24, 25, 30, 48, 50, 60, 100)
"""Frames a second of cameras; what counts further are hundredths."""

LEAST_FRAMES = 10
"""Different ones that tell how many there are: of few the largest need not be there."""


def is_clock_time(cell: str) -> bool:
    """Whether a cell is a time of day, or that behind a date."""
    return re.match(_PATTERN, _RUN_TOGETHER.sub(_PARTED, cell)) is not None


class ClockTimes:
    """Dates and times of day in s since the midnight before the first of them, piece by piece.

    So two files of one day have one clock. A time of day that falls by more than half a day is one
    of the day after, one that falls by nearly that much is on a dial of twelve hours, and one
    without its hour is one of the hour after.
    """

    def __init__(self) -> None:
        self._first_day: int | None = None
        self._days = 0.0
        self._last: float | None = None
        self._frames: int | None = None

    def add(self, cells: pa.Array) -> np.ndarray:
        """Seconds (n,) of texts, NaN where one is missing or none."""
        found = pc.extract_regex(_parted(cells), _PATTERN)
        field = {name: found.field(k) for k, name in enumerate(_names(found))}
        known = ~np.asarray(pc.is_null(found))
        clock = ("hour", "minute", "second", "minutes", "of_minute")
        hour, minute, second, minutes, of_minute = (_whole(field[n], known) for n in clock)
        hour = _of_the_day(hour, field["noon"])
        parts = pc.binary_join_element_wise(
            *(pc.fill_null(field[name], "") for name in ("part", "thousandths", "of_second")), ""
        )
        digits = pc.utf8_rpad(parts, width=9, padding="0")
        seconds = hour * HOUR + (minute + minutes) * 60 + second + of_minute
        seconds = seconds - _zone(field["zone"], known) + _spans(field["span"], field["unit"])
        frames = _whole(field["frames"], known)
        if self._frames is None and frames.any():
            several = len(np.unique(frames[known])) >= LEAST_FRAMES
            self._frames = next(n for n in FRAMES if n > frames.max()) if several else FRAMES[-1]
        seconds = seconds + frames / (self._frames or 1)
        days = _days(field, known) + _whole(field["days"], known)
        if known.any() and self._first_day is None:
            at = int(np.flatnonzero(known)[0])
            self._first_day = int(days[at])
        # Whole seconds and their parts apart: a sum of both is rounded once.
        times = (days - (self._first_day or 0)) * DAY + seconds + 1e-9 * _whole(digits, known)
        if not np.any(_whole(field["year"], known)):
            shown = HOUR if np.any(np.asarray(pc.fill_null(field["of_second"], "")) != "") else DAY
            times = self._going_on(times, known, shown)
        return np.where(known, times, np.nan)

    def _going_on(self, times: np.ndarray, known: np.ndarray, shown: int) -> np.ndarray:
        """The ``times`` (n,), of which is told what is within ``shown`` s: an hour, or a day."""
        seen = times[known]
        if not len(seen):
            return times
        steps = np.diff(seen, prepend=seen[0] if self._last is None else self._last)
        falls = (steps < -shown / 2).astype(float)
        falls[(steps >= -DAY / 2) & (steps < NEARLY * -DAY / 2)] = 0.5
        days = self._days + np.cumsum(falls)
        self._last, self._days = float(seen[-1]), float(days[-1])
        times = times.copy()
        times[known] = seen + shown * days
        return times


def _parted(cells: pa.Array) -> pa.Array:
    """Texts, of which those of digits alone have the signs of a date and a time between them."""
    if not len(cells) or ":" in (next((c for c in cells.to_pylist() if c), ":")):
        return cells
    return pc.replace_substring_regex(
        cells, _RUN_TOGETHER.pattern, _PARTED.replace(r"\g<7>", r"\7")
    )


def is_clock(kind: pa.DataType) -> bool:
    """Whether a column of this ``kind`` holds dates with times, times of day or spans of time."""
    tests = (pa.types.is_timestamp, pa.types.is_time, pa.types.is_duration)
    return any(test(kind) for test in tests)


class Stamps:
    """Columns of a ``kind`` that ``is_clock`` in s, piece by piece.

    A date counts from the midnight before the first, as in ``ClockTimes``.
    """

    def __init__(self) -> None:
        self._origin: int | None = None

    def add(self, cells: pa.Array) -> np.ndarray:
        """Seconds (n,), NaN where one is missing."""
        ticks = _TICKS[cells.type.unit]
        known = ~np.asarray(pc.is_null(cells))
        wide = cells.cast(pa.int32()) if pa.types.is_time32(cells.type) else cells
        whole = pc.fill_null(wide.cast(pa.int64()), 0).to_numpy(zero_copy_only=False)
        if self._origin is None and known.any():
            dated = pa.types.is_timestamp(cells.type)
            first = int(whole[np.flatnonzero(known)[0]])
            self._origin = first - first % (DAY * ticks) if dated else 0
        return np.where(known, (whole - (self._origin or 0)) / ticks, np.nan)


_TICKS = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}
"""Ticks of a second."""


def _names(found: pa.Array) -> list[str]:
    return [found.type.field(k).name for k in range(found.type.num_fields)]


def _whole(texts: pa.Array, known: np.ndarray) -> np.ndarray:
    """Whole numbers (n,), 0 where there is none."""
    filled = pc.fill_null(texts, "0")
    filled = pc.if_else(pc.equal(filled, ""), "0", filled)
    return np.where(known, filled.cast(pa.int64()).to_numpy(zero_copy_only=False), 0)


def _of_the_day(hour: np.ndarray, noon: pa.Array) -> np.ndarray:
    """Hours (n,) of the day of those on a dial, before or after ``noon`` where it says A or P."""
    half = pc.utf8_upper(pc.fill_null(noon, ""))
    after = np.asarray(pc.equal(half, "P"))
    return np.where(np.asarray(pc.equal(half, "")), hour, hour % 12 + 12 * after)


def _zone(texts: pa.Array, known: np.ndarray) -> np.ndarray:
    """s by which the zones are ahead of UTC."""
    plain = pc.replace_substring(pc.fill_null(texts, ""), ":", "")
    plain = pc.if_else(pc.equal(plain, ""), "+0000", plain)
    hhmm = _whole(pc.replace_substring(plain, "+", ""), known)
    return np.sign(hhmm) * (np.abs(hhmm) // 100 * 3600 + np.abs(hhmm) % 100 * 60)


SPANS = {"sec": 1.0, "min": 60.0, "hr": 3600.0}
"""s in the units behind MATLAB's spans of time."""


def _spans(numbers: pa.Array, units: pa.Array) -> np.ndarray:
    """s (n,) of spans of time, 0 where there is none."""
    values = pc.if_else(pc.equal(filled := pc.fill_null(numbers, ""), ""), "0", filled)
    seconds = values.cast(pa.float64()).to_numpy(zero_copy_only=False)
    size = [SPANS.get(unit, 0.0) for unit in pc.fill_null(units, "").to_pylist()]
    return seconds * np.array(size)


def _days(field: dict[str, pa.Array], known: np.ndarray) -> np.ndarray:
    """Days since 1970-01-01 of the dates, 0 where there is none."""
    year, month, day = (_whole(field[n], known) for n in ("year", "month", "day"))
    months = (year - 1970) * 12 + np.maximum(month, 1) - 1
    first = months.astype("datetime64[M]").astype("datetime64[D]").astype(np.int64)
    return np.where(year > 0, first + day - 1, 0)
