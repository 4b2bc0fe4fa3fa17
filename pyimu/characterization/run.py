"""Characterise logs: ``pyimu.characterize``.

A log is read in one pass; then one sensor after the other is characterised from what was kept of
the samples on disk. That is exact, whatever the length of a log: the samples are kept as they are
in temporary files, and the deviations of each column are those of one sum over all of it. In memory
at a time are a piece of the log, the windows of the spectrum, and what is mapped of one column.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from pyimu.characterization.allan.moments import TERMS
from pyimu.characterization.evidence import evidence
from pyimu.characterization.handled import of_what_is_left, without_ends
from pyimu.characterization.log_samples import Say, read_samples
from pyimu.characterization.noise.coefficients import Coefficient, mean_coefficient
from pyimu.characterization.outcome import LogResult, SensorResult, Summary
from pyimu.characterization.repeats import without_repeats
from pyimu.characterization.result import Characterization
from pyimu.characterization.sensor import SensorAnalysis
from pyimu.characterization.shocks import without_shocks
from pyimu.characterization.store import Store
from pyimu.display.silent import silent
from pyimu.errors import Finding, UserError
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.numerics.threads import on_one_thread
from pyimu.recording.companions import interpolated
from pyimu.recording.log import Given, Log, is_one, open_log, recording_of
from pyimu.recording.names import distinct_names
from pyimu.recording.recording import Recording
from pyimu.report.numbers import joined

if TYPE_CHECKING:
    from pyimu.characterization.magnetometer.estimate import MagnetometerFit

Source = Log | Given


@on_one_thread
def characterize(
    recording: Source | Sequence[Source],
    level: float = 0.95,
    say: Say = silent,
    part: str | os.PathLike | Part | None = None,
) -> Characterization:
    """Characterise a sensor at rest: its noise, its temperature effect, the quality of its samples.

    Of a log that turns about all axes and has a magnetometer, that is calibrated: hard and soft
    iron, and how its axes lie against the accelerometer's.

    ``recording`` is one log of a part, or several: a recording, a log opened by ``open_log``, a
    file, or a data frame. ``level`` is the probability of all intervals; ``say(text, share)`` hears
    what is being done and which share of it, or None. ``part`` is a data sheet, a built-in part or
    a TOML file, that the result is shown beside. The result's ``report()`` is for reading, its
    ``part()`` for ``pyimu.build`` and ``pyimu.close``; its ``write(folder)`` writes a page, data
    and the part.

    Raises UserError where no channel can be characterised, because they have too few samples or are
    constant, and where the times of a log are too coarse or of two sample rates.
    """
    if not 0 < level < 1:
        raise UserError(f"level {level:g}: must lie between 0 and 1")
    sources = [recording] if is_one(recording) else list(recording)
    if not sources:
        raise UserError("no log to characterise")
    given = None if part is None else find_part(part)
    opened = [_opened(s) for s in sources]
    logs: list[LogResult] = []
    for source, name in zip(opened, distinct_names(opened), strict=True):
        logs.append(_log(source, name, level, _origin(logs), say))
    return Characterization(tuple(logs), level, _summaries(logs, level), given)


def _opened(source: Source) -> Recording | Log:
    """A file is read in pieces, for it may be larger than memory."""
    if isinstance(source, Log):
        return source
    return open_log(source) if isinstance(source, (str, os.PathLike)) else recording_of(source)


def _origin(logs: Iterable[LogResult]) -> float | None:
    """The temperature T0 [degC] of all logs: that of the first with an effect of temperature."""
    return next((c.thermal.T0 for log in logs for c in log.channels if c.thermal is not None), None)


def _log(source: Recording | Log, name: str, level: float, T0: float | None, say: Say) -> LogResult:
    with Store() as store:
        read = read_samples(source, name, store, say)
        wrapped = {f.column for f in read.findings if f.kind == "wrapped"}
        fresh, found = without_repeats(read.sensors, read.findings, store)
        moving = [f for s in fresh.values() for f in s.motion(wrapped)]
        sensors, handled = without_ends(fresh, wrapped) if moving else (fresh, [])
        known, moving = tuple(found), [] if handled else moving
        if handled:
            known = tuple(of_what_is_left(known, sensors))
        # Raw counts in a false unit look like motion.
        moves = bool(moving) and not any(f.kind == "counts" for f in read.findings)
        # What moves has no rest that a shock could stand out of.
        sensors, shocks = (sensors, []) if moving else without_shocks(sensors, wrapped)
        unlike = set(sensors) if moves else interpolated(known)
        results = {
            kind: SensorAnalysis(
                name, samples, wrapped, kind in unlike, level, T0, store, say
            ).result()
            for kind, samples in sensors.items()
        }
        if not any(c.noise for r in results.values() for c in r.channels):
            raise UserError(_nothing(name, results))
        findings = (*known, *handled, *moving, *shocks)
        shown = evidence(findings, read.sensors)
        findings = (*findings, *_warm_ups(results.values()))
        field = _magnetometer(source, moving, say)
        return LogResult(name, read.rows, read.duration, results, findings, shown, *field)


def _magnetometer(
    source: Recording | Log, moving: Iterable[Finding], say: Say
) -> tuple[MagnetometerFit | None, str]:
    """The calibration of the magnetometer of a log that turns, and why there is none."""
    turns = any(f.column.startswith("gyro") for f in moving)
    if not turns or not {"mag", "gyro", "accel"} <= set(source.groups):
        return None, ""
    from pyimu.attitude.run import run as attitude
    from pyimu.characterization.magnetometer.estimate import magnetometer_fit

    say(f"magnetometer of {source.name}", None)
    whole = source.read() if isinstance(source, Log) else source
    try:
        return magnetometer_fit(whole, attitude(whole, magnetometer=False, smooth=True)), ""
    except UserError as error:
        return None, str(error)


def _warm_ups(sensors: Iterable[SensorResult]) -> list[Finding]:
    """A finding ``warm_up`` for each channel that has one; ``count`` samples until it is over."""
    return [
        Finding(
            "warm_up",
            c.name,
            round(3 * c.warm_up.tau / s.h),
            {"amplitude": c.warm_up.amplitude, "time_constant": c.warm_up.tau},
        )
        for s in sensors
        for c in s.channels
        if c.warm_up
    ]


def _nothing(name: str, results: Mapping[str, SensorResult]) -> str:
    reasons = list(dict.fromkeys(c.reason for r in results.values() for c in r.channels))
    return (
        f"{name}: no channel can be characterised: "
        f"{joined(reasons) or 'every row has a missing cell'}"
    )


def _summaries(logs: Iterable[LogResult], level: float) -> dict[tuple[str, str], Summary]:
    """The coefficients over all logs, by (channel, letter)."""
    found: dict[tuple[str, str], list[Coefficient]] = {}
    for log in logs:
        for channel in log.channels:
            for term in TERMS if channel.noise else "":
                found.setdefault((channel.name, term), []).append(channel.noise.fit[term])
    return {key: Summary(*mean_coefficient(each, level), len(each)) for key, each in found.items()}
