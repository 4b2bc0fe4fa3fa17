"""The heading by several methods in words and cells."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.heading.calibration import Calibration
from pyimu.heading.outcome import Outcome
from pyimu.heading.statistics import Statistics
from pyimu.heading.transfer import RateTransfer
from pyimu.report.numbers import MISSING, number, quantity, with_error, with_limits

HEAD = ("method", "mean [deg]", "std [deg]", "RMS [deg]", "RMS of all rows [deg]")

PAIRED_HEAD = ("difference of", "mean [deg]", "std [deg]")


def about(found: Outcome) -> str:
    """How many logs, how long, and what was calibrated by."""
    logs = found.recordings
    seconds = sum(float(r.time[-1] - r.time[0]) for r in logs)
    count = f"{len(logs)} logs" if len(logs) > 1 else logs[0].name
    start = found.settings["start_up"]
    by = "a known motion of its own" if start is None else f"the first {start:g} s"
    return (
        f"{count}, {seconds:.4g} s in all; calibrated by {by}; threshold "
        f"{number(np.degrees(found.settings['threshold']))} deg/s"
    )


def judged(found: Outcome) -> str:
    """What the errors are."""
    counts = {len(m.errors) for m in found.methods}
    if counts == {0}:
        return "no log has a reference of its heading: the methods have no errors to show"
    if max(counts) == 1:
        return (
            "one log gives one error of each method, that at its end: no mean over runs, and no "
            "interval; several logs give both"
        )
    return (
        "signed heading errors at the ends of the logs, estimate less reference, with 95 % "
        "intervals"
    )


def error_cells(s: Statistics, within: float) -> tuple[str, ...]:
    """Mean, standard deviation and RMS with their intervals, and the RMS of all rows, in deg."""
    return (
        _limits(s.mean, s.mean_interval),
        _limits(s.std, s.std_interval),
        _limits(s.rms, s.rms_interval),
        number(np.degrees(within)),
    )


def _limits(value: float, interval: tuple[float, float]) -> str:
    if not np.isfinite(value):
        return MISSING
    return with_limits(*np.degrees([value, *interval]))


def error_rows(found: Outcome) -> list[tuple[str, ...]]:
    return [(m.name, *error_cells(m.statistics, m.within)) for m in found.methods]


def paired_rows(found: Outcome) -> list[tuple[str, ...]]:
    """Paired differences, where there are several logs."""
    return [
        (f"{a} less {b}", _limits(s.mean, s.mean_interval), _limits(s.std, s.std_interval))
        for (a, b), s in found.differences.items()
    ]


CALIBRATION_HEAD = (
    "calibration of",
    "by",
    "scale factor s",
    "bias b",
    "condition",
    "reference late",
)


def calibration_rows(found: Outcome) -> list[tuple[str, ...]]:
    """One row for each calibration of the first log."""
    rows = []
    for m in found.methods:
        c = m.tracks[0].calibration
        if c is not None:
            rows.append((m.name, c.method, *_coefficients(c)))
    return rows


def _coefficients(c: Calibration) -> tuple[str, ...]:
    late = MISSING
    if c.late is not None:
        late = f"{with_error(1e3 * c.late, 1e3 * (c.late_std or 0.0))} ms"
    return (
        f"{with_error(100 * c.s, 100 * c.s_std)} %",
        f"{with_error(np.degrees(c.b0), np.degrees(c.b0_std))} deg/s",
        number(c.condition),
        late,
    )


def transfer_words(t: RateTransfer) -> str:
    return (
        f"gyro {t.axis} over {len(t.rate)} plateaus to {number(np.degrees(t.range))} deg/s: slope "
        f"error {with_error(100 * t.s, 100 * t.s_std)} %, asymmetry "
        f"{with_error(100 * t.asymmetry, 100 * t.asymmetry_std)} %, bias "
        f"{quantity(t.bias, 'rad/s')}, residual at most {number(t.worst)} % of the range"
    )


def remarks(found: Outcome) -> Iterator[str]:
    """What the reader should know."""
    yield judged(found)
    yield from found.notes
    for m in found.methods:
        for t in m.tracks[:1]:
            if t.filter is not None:
                share = float(np.mean(t.filter.at_rest))
                yield f"filter: at rest in {100 * share:.3g} % of the samples of {t.name}"
