"""One pass over a log: its samples by sensor, its times, and the findings of its quality."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from pyimu.characterization.samples import KINDS, Collector, Samples
from pyimu.characterization.store import Store
from pyimu.errors import Finding, UserError
from pyimu.model.part import AXES
from pyimu.recording.clock import Clock
from pyimu.recording.log import Log
from pyimu.recording.quality.in_pieces import Inspector
from pyimu.recording.recording import Recording

TWO_RATES = 0.01
"""Share of a log at another rate beyond which it cannot be characterised as one."""

PIECE = 1 << 18
"""Rows that are read at a time: few enough to stay in a processor's cache from one look at them to
the next."""

REPEATED = 0.01
"""Share of rows without a time of their own beyond which the times are too coarse."""

Say = Callable[[str, float | None], None]
"""Hears what is being done, and which share of it is done, or None."""


@dataclass(frozen=True)
class LogSamples:
    """The samples of a log by sensor, its ``rows``, its ``duration`` [s], and the findings."""

    sensors: Mapping[str, Samples]
    rows: int
    duration: float
    findings: tuple[Finding, ...]


def read_samples(source: Recording | Log, name: str, store: Store, say: Say) -> LogSamples:
    """Read a log piece by piece and keep its samples in the store.

    ``name`` is that of the log in errors. Raises UserError where its times are too coarse or of two
    rates.
    """
    collectors = {k: Collector(k, store) for k in KINDS if k in source.groups}
    inspector, clock, rows, first, last = Inspector(), Clock(source.cadence), 0, np.nan, np.nan
    for piece, share in _pieces(source):
        say(f"reading {source.name}", share)
        inspector.add(piece)
        clock.add(piece.time)
        for collector in collectors.values():
            collector.add(piece)
        first, last, rows = piece.time[0] if rows == 0 else first, piece.time[-1], rows + len(piece)
    sensors = {k: s for k, c in collectors.items() if (s := c.result()) is not None}
    # A recording made from arrays has no findings of its times; a log has them from its reading.
    known = {f.kind for f in source.findings}
    of_times = [f for f in clock.findings() if f.kind not in known]
    lost = _without_samples(collectors, sensors, rows)
    findings = (*source.findings, *of_times, *inspector.findings(), *lost)
    _check_times(name, findings, rows)
    return LogSamples(sensors, rows, float(last - first), findings)


def _pieces(source: Recording | Log) -> Iterator[tuple[Recording, float]]:
    """The pieces of a log, with the share of it that has then been read."""
    if isinstance(source, Log):
        yield from source.pieces(PIECE)
        return
    for a in range(0, len(source), PIECE):
        piece = source.slice(a, a + PIECE)
        if len(source) > PIECE:
            piece = _with_cadence_of(source, piece)
        yield piece, min((a + PIECE) / len(source), 1.0)


def _with_cadence_of(whole: Recording, piece: Recording) -> Recording:
    return replace(piece, period=whole.cadence.period, longest=whole.cadence.longest)


def _without_samples(
    collectors: Iterable[str], sensors: Mapping[str, Samples], rows: int
) -> list[Finding]:
    """A finding ``no_samples`` for each axis that the log has a column of, but no samples."""
    return [
        Finding("no_samples", f"{k}_{axis}", rows)
        for k in collectors
        for i, axis in enumerate(AXES)
        if k not in sensors or i in sensors[k].absent
    ]


def _check_times(name: str, findings: Iterable[Finding], rows: int) -> None:
    """Raise UserError where the findings of the times do not let a log be characterised."""
    for f in findings:
        if f.kind == "repeated_time" and f.count > REPEATED * (rows + f.count):
            raise UserError(
                f"{name}: {f.count:,} of {rows + f.count:,} rows have the time of the row before: "
                "the time stamps are too coarse, "
                "as of float32 or a slow clock; write them in float64 or integers, with at least "
                "two steps a sample"
            )
        if f.kind == "two_rates" and f.count > TWO_RATES * rows:
            d = f.detail
            raise UserError(
                f"{name}: two sample rates, {d['rate']:.6g} Hz and, from {d['first']:.6g} s on, "
                f"{d['other_rate']:.6g} Hz; "
                "give each a log of its own"
            )
