"""Characterise logs: one pass over the samples, then one sensor after the other from what was kept
of them on disk.

Exact, whatever the length of a log: the samples are kept as they are in temporary files, and the
deviations of each column are those of one sum over all of it. In memory at a time are a piece of
the log, the spectrum's windows, and what is mapped of one column.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from pyimu.characterization.allan.pooled import longest
from pyimu.characterization.channel import LEAST, compensated, noise_of
from pyimu.characterization.evidence import evidence
from pyimu.characterization.rest import motion
from pyimu.characterization.result import (
    Channel,
    Characterization,
    LogResult,
    Overview,
    SensorResult,
)
from pyimu.characterization.samples import CHUNK, KINDS, Collector, Samples
from pyimu.characterization.spectrum.lines import Line, find_lines, searched_range
from pyimu.characterization.spectrum.psd import SpectrumAccumulator, window_length
from pyimu.characterization.store import Store
from pyimu.characterization.temperature.fit import ThermalFit, fit_thermal
from pyimu.errors import Finding, UserError
from pyimu.model.part import AXES
from pyimu.recording.clock import Clock
from pyimu.recording.log import Log, open_log
from pyimu.recording.names import distinct_names
from pyimu.recording.quality.in_pieces import Inspector
from pyimu.recording.recording import Recording
from pyimu.report.figures import BINS
from pyimu.report.numbers import joined

TWO_RATES = 0.01
"""Share of a log at another rate beyond which it cannot be characterised as one."""

REPEATED = 0.01
"""Share of rows without a time of their own beyond which the times are too coarse."""

Say = Callable[[str, float | None], None]
Source = Recording | Log | str | os.PathLike


def characterize(
    recording: Source | Sequence[Source],
    level: float = 0.95,
    say: Say = lambda text, share=None: None,
) -> Characterization:
    """What one log, or several of one part at rest, say of the sensor's noise, its temperature
    effect and the quality of the samples.

    ``recording`` is a recording, a log opened by ``open_log``, or a file, or several of these.
    ``level`` is the probability of all intervals; ``say(text, share)`` hears what is being done and
    which share of it, or None. The result's ``report()`` is for reading, ``part()`` for
    ``pyimu.build`` and ``pyimu.close``; ``pyimu.write_characterization`` writes pages.

    Raises UserError where no channel can be characterised: too few samples, all constant, two
    sample rates, or not at rest.
    """
    if not 0 < level < 1:
        raise UserError(f"level {level:g}: must lie between 0 and 1")
    sources = (
        [recording]
        if isinstance(recording, (Recording, Log, str, os.PathLike))
        else list(recording)
    )
    if not sources:
        raise UserError("no log to characterise")
    opened = [open_log(Path(s)) if isinstance(s, (str, os.PathLike)) else s for s in sources]
    logs: list[LogResult] = []
    for source, name in zip(opened, distinct_names(opened), strict=True):
        logs.append(_log(source, name, level, _origin(logs), say))
    return Characterization(tuple(logs), level)


def _origin(logs: Sequence[LogResult]) -> float | None:
    """The temperature at which the bias is given, one for all logs: that of the first with one."""
    return next((c.thermal.T0 for log in logs for c in log.channels if c.thermal is not None), None)


def _log(source: Recording | Log, name: str, level: float, T0: float | None, say: Say) -> LogResult:
    with Store() as store:
        sensors, rows, duration, findings = _read(source, store, say)
        _check_times(name, findings, rows)
        wrapped = {f.column for f in findings if f.kind == "wrapped"}
        findings = (*findings, *(f for s in sensors.values() for f in motion(s, wrapped)))
        results = {k: _sensor(name, s, wrapped, level, T0, store, say) for k, s in sensors.items()}
        if not any(c.noise for r in results.values() for c in r.channels):
            raise UserError(_nothing(name, results))
        warm = tuple(
            Finding(
                "warm_up",
                c.name,
                round(3 * c.warm_up.tau / r.h),
                {"amplitude": c.warm_up.amplitude, "time_constant": c.warm_up.tau},
            )
            for r in results.values()
            for c in r.channels
            if c.warm_up
        )
        return LogResult(
            name, rows, duration, results, (*findings, *warm), evidence(findings, sensors)
        )


def _read(
    source: Recording | Log, store: Store, say: Say
) -> tuple[dict[str, Samples], int, float, tuple[Finding, ...]]:
    """The samples by sensor, the number of rows, the time that they span in s, and the findings."""
    collectors = {k: Collector(k, store) for k in KINDS if k in source.groups}
    inspector, clock, rows, first, last = Inspector(), Clock(source.cadence), 0, np.nan, np.nan
    for piece, share in _pieces(source):
        say(f"reading {source.name}", share)
        inspector.add(piece)
        clock.add(piece.time)
        for collector in collectors.values():
            collector.add(piece)
        first, last, rows = piece.time[0] if rows == 0 else first, piece.time[-1], rows + len(piece)
    found = {k: s for k, c in collectors.items() if (s := c.result()) is not None}
    lost = [
        Finding("no_samples", f"{k}_{axis}", rows)
        for k, c in collectors.items()
        for i, axis in enumerate(AXES)
        if k not in found or i in found[k].absent
    ]
    # A recording that was not read knows nothing of its times.
    of_times = [
        f for f in clock.findings() if f.kind not in {known.kind for known in source.findings}
    ]
    return (
        found,
        rows,
        float(last - first),
        (*source.findings, *of_times, *inspector.findings(), *lost),
    )


def _pieces(source: Recording | Log) -> Iterator[tuple[Recording, float]]:
    if isinstance(source, Log):
        yield from source.pieces(CHUNK)
        return
    for a in range(0, len(source), CHUNK):
        piece = source.slice(a, a + CHUNK)
        yield (
            piece if len(source) <= CHUNK else _of(source, piece),
            min((a + CHUNK) / len(source), 1.0),
        )


def _of(whole: Recording, piece: Recording) -> Recording:
    """The piece with the cadence of the whole."""
    return replace(piece, period=whole.cadence.period, longest=whole.cadence.longest)


def _check_times(name: str, findings: Iterable[Finding], rows: int) -> None:
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


def _nothing(name: str, results: dict[str, SensorResult]) -> str:
    reasons = list(dict.fromkeys(c.reason for r in results.values() for c in r.channels))
    return (
        f"{name}: no channel can be characterised: "
        f"{joined(reasons) or 'every row has a missing cell'}"
    )


def _sensor(
    name: str,
    samples: Samples,
    wrapped: set[str],
    level: float,
    T0: float | None,
    store: Store,
    say: Say,
) -> SensorResult:
    say(f"{name}: {samples.kind}, spectrum", None)
    spectrum = _spectrum(samples, say)
    lines = find_lines(spectrum)
    channels = []
    for axis in range(3):
        own = tuple(v for v in lines if v.column == axis)
        column = f"{samples.kind}_{AXES[axis]}"
        reason = _reason(samples, axis, column in wrapped)
        channels.append(
            _channel(f"{name}: {column}", column, samples, axis, reason, own, level, T0, store, say)
        )
    used = len(longest(samples.stretches))
    return SensorResult(
        samples.kind,
        samples.h,
        len(samples),
        len(samples.stretches),
        used,
        samples.longest,
        spectrum.result(),
        tuple(channels),
        searched_range(spectrum),
    )


def _reason(samples: Samples, axis: int, wrapped: bool) -> str:
    """Why a channel cannot be characterised; empty where it can."""
    column = samples.columns[axis]
    if axis in samples.absent:
        return samples.absent[axis]
    if samples.longest < LEAST:
        return f"{samples.longest} samples without gap are too few, at least {LEAST} are needed"
    if np.all(column == column[0]):
        return "it is constant"
    return "its integers wrapped around, unwrap them first" if wrapped else ""


def _spectrum(samples: Samples, say: Say) -> SpectrumAccumulator:
    spectrum, done = SpectrumAccumulator(samples.h, window_length(samples.longest)), 0
    for start, stop in samples.stretches:
        for a in range(start, stop, CHUNK):
            b = min(a + CHUNK, stop)
            spectrum.add(np.column_stack([c[a:b] for c in samples.columns]))
            done += b - a
            say(f"{samples.kind}: spectrum", done / len(samples))
        spectrum.end_segment()
    return spectrum


def _channel(
    label: str,
    name: str,
    samples: Samples,
    axis: int,
    reason: str,
    lines: tuple[Line, ...],
    level: float,
    T0: float | None,
    store: Store,
    say: Say,
) -> Channel:
    column, noise, warm_up = samples.columns[axis], None, None
    thermal, thermal_reason = (None, reason) if reason else _thermal(samples, axis, level, T0)
    if not reason:
        try:
            say(f"{label}: temperature and warm-up", None)
            rest, warm_up = compensated(samples, axis, thermal, store)
            noise = noise_of(
                samples, axis, rest, lines, level, store, lambda text: say(f"{label}: {text}", None)
            )
        except UserError as error:
            reason, warm_up = str(error), None
    mean = np.nan if axis in samples.absent else float(np.mean(column))
    return Channel(
        name, mean, _overview(samples, axis), noise, reason, lines, thermal, thermal_reason, warm_up
    )


def _thermal(
    samples: Samples, axis: int, level: float, T0: float | None
) -> tuple[ThermalFit | None, str]:
    if samples.blocks is None:
        return None, "the log has no temperature"
    try:
        return fit_thermal(samples.blocks, axis, level, T0), ""
    except UserError as error:
        return None, str(error)


def _overview(samples: Samples, axis: int) -> Overview:
    edges = np.unique(np.linspace(0, len(samples), min(BINS, len(samples)) + 1).astype(int))
    column, spans = samples.columns[axis], list(itertools.pairwise(edges))
    if axis in samples.absent:
        column = np.full(len(samples), np.nan)
    low, mean, high = (
        np.array([f(column[a:b]) for a, b in spans]) for f in (np.min, np.mean, np.max)
    )
    return Overview(np.array([samples.time[(a + b) // 2] for a, b in spans]), low, mean, high)
