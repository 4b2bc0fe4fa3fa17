"""Quality of the raw samples, to be known before a model is blamed for its residual.

Every test looks at the measured samples alone, needs no reference and no model, and takes its
threshold from the column itself.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.clock import Clock
from pyimu.recording.columns import XYZ, column_names
from pyimu.recording.quality.clipping import clipped, clipping_findings
from pyimu.recording.quality.repeats import repeats
from pyimu.recording.quality.resolution import quantization_step
from pyimu.recording.quality.spikes import spikes, widened
from pyimu.recording.quality.stuck import LEAST_RUN, held_findings, hung_runs, stuck_findings
from pyimu.recording.quality.wraps import wrap_findings
from pyimu.recording.quality.zeroed import zeroed_findings
from pyimu.recording.recording import Recording
from pyimu.recording.turning import drawn
from pyimu.units import STANDARD_GRAVITY, ZERO_CELSIUS

WORKS = (-65.0, 175.0)
"""degC between which electronics is stored and works (the military range, and the hottest grade of
automotive parts, AEC-Q100)."""

NO_GRAVITY = "no_gravity"
"""The finding of forces without gravity."""

TOO_LARGE = {
    STANDARD_GRAVITY: ("g", "m/s^2"),
    100.0: ("m/s^2", "cm/s^2"),
    1000.0: ("g", "mg"),
}
"""Times gravity that forces show whose header says the first unit, and whose numbers are in the
second."""

WEIGHTLESS = 0.08
"""Of the Earth's gravity; the Moon's is 0.165, and a gravity of 1, of a log in g, is 0.102."""

FASTEST = np.radians(2100)
"""rad/s; the range of most gyros ends at 2000 deg/s, from which a scale factor is off by some
percent."""

SELDOM = 1e-3
"""Share of the samples up to which larger rates are spikes."""

STANDS = 0.2
"""m/s^2; standard deviation over a second of a force that stands still. Gravity turns through 1.0
at the rate ``ZERO_RATE``."""

ZERO_RATE = np.radians(20)
"""rad/s; initial tolerance of the output at rest of the worst of the consumer's gyros in
``pyimu/model/typical.toml``."""

MOST_SECONDS = 200
"""Seconds that are looked at for what a gyro shows at rest."""

NOISIEST = np.radians(0.15) / np.sqrt(2)
"""rad/sqrt(s); half as much again as the noisiest gyro of the built-in parts has, an ADXRS300 of
0.1 deg/s/sqrt(Hz) one-sided."""

SLOWEST = 0.02
"""s; in samples that are farther apart the noise of all of a gyro's bandwidth, 25 Hz or more, is
folded, and no more than that: it is no density."""

JITTER = 0.01
"""RMS deviation of the sample steps from their median, in periods, above which it is reported."""


def inspect(recording: Recording) -> tuple[Finding, ...]:
    """The findings from raw gyro and accelerometer samples and their times.

    ``zeroed``, ``constant_channel``, ``wrapped``, ``clipping``, ``stuck_samples``,
    ``held_samples``, ``spikes``, ``quantization_step`` for each column; ``repeated_samples`` and
    ``held_samples`` for each sensor; ``jitter``,
    ``gravity_down``, ``force_in_g``, ``force_unit``, ``no_gravity``, ``gyro_fast``,
    ``gyro_at_rest``, ``gyro_noisy`` and ``temperature_unit`` for the recording.
    """
    names, values = _channels(recording)
    zeroed = _zeroed(recording)
    silent = {name for f in zeroed for name in (f.column, *(f"{f.column}_{a}" for a in XYZ))}
    columns = [
        finding
        for name, column in zip(names, values.T)
        for finding in _column(name, np.ascontiguousarray(column), name in silent)
    ]
    columns += _repeats(recording, columns, silent)
    quiet, force = _resting_force(recording)
    of_gravity = (*_gravity_down(recording, force), *_force_in_g(quiet), *_force_unit(quiet))
    of_gravity += tuple(_no_gravity(quiet))
    warmth = _other_temperature(recording)
    sizes = (*_too_fast(recording), *_at_rest(recording), *of_gravity, *warmth)
    return (*zeroed, *columns, *_spikes(recording), *_jitter(recording), *sizes)


def force_findings(recording: Recording) -> tuple[Finding, ...]:
    """``force_in_g`` and ``force_unit`` alone, of the findings of ``inspect``."""
    quiet, _ = _resting_force(recording)
    return (*_force_in_g(quiet), *_force_unit(quiet))


def _resting_force(recording: Recording) -> tuple[np.ndarray, np.ndarray | None]:
    """The force (k, 3) of each of the quietest seconds, and its median (3,), None without one."""
    shows = recording.accel is not None and len(recording) > 1
    quiet = _quietest(recording) if shows else np.zeros((0, 3))
    return quiet, np.median(quiet, axis=0) if len(quiet) else None


def of_reading(recording: Recording) -> tuple[Finding, ...]:
    """What reading a log's file found; of the times of one that was made of arrays, the same."""
    if recording.path is not None or recording.findings:
        return recording.findings
    clock = Clock(recording.cadence)
    clock.add(recording.time)
    return tuple(clock.findings())


APART = 0.1
"""Part by which a log's rate may be off its part's: the clocks of such sensors keep theirs to some
percent (LSM6DSO, BMI270: 5 %)."""


def rate_of_part(recording: Recording, rate: float) -> list[Finding]:
    """That the part's sample rate [Hz] is another than the log's, where it is."""
    if abs(recording.sample_rate / rate - 1) <= APART:
        return []
    detail = {"rate": recording.sample_rate, "other_rate": rate}
    return [Finding("rate_of_part", "time", 1, detail)]


BEYOND = 1.02
"""Times a declared range that no sample of such a sensor reaches."""


def beyond_range(recording: Recording, limits: Mapping[str, np.ndarray]) -> list[Finding]:
    """The columns with samples beyond the range (3,) that a part declares of each group: the
    sensor that was logged was set to another. A range of zero is none.
    """
    found = []
    for group, limit in limits.items():
        values = getattr(recording, group)
        for i, name in enumerate("xyz") if values is not None else ():
            size = np.abs(values[:, i])
            count = int(np.sum(size > BEYOND * limit[i])) if limit[i] > 0.0 else 0
            if count:
                detail = {"largest": float(np.nanmax(size)), "declared": float(limit[i])}
                found.append(Finding("beyond_range", f"{group}_{name}", count, detail))
    return found


def _channels(recording: Recording) -> tuple[list[str], np.ndarray]:
    """Names and samples (n, columns) of the gyro and accelerometer columns."""
    present = [group for group in ("gyro", "accel") if getattr(recording, group) is not None]
    names = [f"{group}_{suffix}" for group in present for suffix in "xyz"]
    return names, np.hstack(
        [np.empty((len(recording), 0)), *(getattr(recording, group) for group in present)]
    )


def _zeroed(recording: Recording) -> list[Finding]:
    """The columns that are set to zero where they are small, or else the vectors that are."""
    found: list[Finding] = []
    for group in ("gyro", "accel"):
        values = getattr(recording, group)
        if values is not None:
            each = zip(column_names(group), values.T)
            own = [f for name, column in each for f in zeroed_findings(name, column)]
            found += own or zeroed_findings(group, values)
    return found


def _column(name: str, values: np.ndarray, zeroed: bool) -> Iterator[Finding]:
    known = values[np.isfinite(values)]
    if len(known) < LEAST_RUN:
        return
    if known.min() == known.max():
        yield Finding("constant_channel", name, len(known), {"value": float(known[0])})
        return
    wrapped = list(wrap_findings(name, values))
    yield from wrapped
    if not wrapped:  # the edge of a word is no level at which a sensor is clipped
        yield from clipping_findings(name, values)
    yield from stuck_findings(name, values, zeroed)
    yield from held_findings(name, values)
    step = quantization_step(values)
    if step is not None:
        yield Finding("quantization_step", name, len(known), {"step": step})


def _repeats(
    recording: Recording, columns: Iterable[Finding], zeroed: Container[str]
) -> Iterator[Finding]:
    """What the rows are of each sensor in which all its axes repeat the row before; that it is held
    is said once, of each axis where that shows it.
    """
    held = {f.column for f in columns if f.kind == "held_samples"}
    for group in ("gyro", "accel"):
        values, names = getattr(recording, group), column_names(group)
        if values is None or group in zeroed or any(name in zeroed for name in names):
            continue
        hung = [np.arange(a + 1, b) for v in values.T for a, b in hung_runs(v)]
        rows = np.unique(np.concatenate([np.empty(0, int), *hung]))
        found = repeats([*np.ascontiguousarray(values.T)], recording.segments, rows)
        if found is not None and not (found.every and held.intersection(names)):
            yield found.finding(group, len(values))


def _spikes(recording: Recording) -> Iterator[Finding]:
    names, values = _channels(recording)
    if not names:
        return
    found = spikes(values, recording.segments)
    for column, name in enumerate(names):
        v, rows = values[:, column], np.flatnonzero(found[:, column])
        at_limit = widened(widened(clipped(v))) if len(rows) else found[:, column]
        rows = rows[~at_limit[rows]]
        if len(rows):
            size = np.abs(v[rows] - (v[rows - 1] + v[rows + 1]) / 2)
            yield Finding(
                "spikes", name, len(rows), {"largest": float(size.max()), "first_row": int(rows[0])}
            )


def _jitter(recording: Recording) -> Iterator[Finding]:
    period = recording.sample_period
    step = np.concatenate([np.diff(recording.time[a:b]) for a, b in recording.segments])
    rms = float(np.sqrt(np.mean((step - step.mean()) ** 2))) if len(step) else 0.0
    if rms > JITTER * period:
        yield Finding("jitter", "time", len(step), {"rms": rms, "period": period})


def _too_fast(recording: Recording) -> Iterator[Finding]:
    """Rates beyond the range of most gyros: probably deg/s whose header says rad/s."""
    if recording.gyro is None:
        return
    size = np.abs(recording.gyro)
    fast = int(np.count_nonzero((size > FASTEST).any(axis=1)))
    if fast > SELDOM * len(size):
        yield Finding("gyro_fast", "gyro", fast, {"largest": float(np.nanmax(size))})


def _at_rest(recording: Recording) -> Iterator[Finding]:
    """What a gyro shows in seconds in which gravity stands still, and none does: a rate about a
    level axis that is larger than any bias, and more noise.
    """
    if recording.gyro is None or recording.accel is None:
        return
    seconds = _whole_seconds(recording, recording.accel, recording.gyro, most=MOST_SECONDS)
    force, still = seconds[:, :, :3].mean(axis=1), seconds[:, :, :3].std(axis=1)
    size = np.linalg.norm(force, axis=1)
    gravity = np.abs(size / STANDARD_GRAVITY - 1) < 0.1
    at_rest = gravity & (np.linalg.norm(still, axis=1) < STANDS)
    if not at_rest.any():
        return
    rate, count = seconds[at_rest, :, 3:], int(at_rest.sum())
    level = np.linalg.norm(np.cross(rate.mean(axis=1), force[at_rest]), axis=1) / size[at_rest]
    if np.median(level) > ZERO_RATE:
        yield Finding("gyro_at_rest", "gyro", count, {"value": float(np.median(level))})
    differences = np.diff(rate, axis=1).std(axis=1) / np.sqrt(2)
    period = min(recording.sample_period, SLOWEST)
    n = float(np.median(differences.max(axis=1)) * np.sqrt(period))
    if n > NOISIEST:
        yield Finding("gyro_noisy", "gyro", count, {"white_noise": n})


def _gravity_down(recording: Recording, rest: np.ndarray | None) -> Iterator[Finding]:
    """Gravity on -z at rest: probably a log in forward-right-down axes that nobody declared."""
    if recording.frame_declared or not _is_gravity(rest, STANDARD_GRAVITY):
        return
    if rest[2] < -0.8 * STANDARD_GRAVITY:
        yield Finding(
            "gravity_down",
            "accel_z",
            1,
            {f"accel_{suffix}": float(f) for suffix, f in zip("xyz", rest)},
        )


def _other_temperature(recording: Recording) -> Iterator[Finding]:
    """A temperature at which no electronics works, and which would be one in the other unit."""
    if recording.temperature is None or not np.isfinite(recording.temperature).any():
        return
    middle = float(np.nanmedian(recording.temperature))
    for offset, right in ((-ZERO_CELSIUS, "K"), (ZERO_CELSIUS, "degC")):
        least, most = WORKS
        if not least <= middle <= most and least <= middle + offset <= most:
            detail = {"median": middle, "as": right}
            yield Finding("temperature_unit", "temperature", 1, detail)


def _force_in_g(quiet: np.ndarray) -> Iterator[Finding]:
    """A gravity of 1 m/s^2 in half of forces (k, 3), whichever way up each is: probably a log in g
    whose header says m/s^2.
    """
    sizes = np.linalg.norm(quiet, axis=1)
    if len(sizes) and np.median(np.abs(sizes - 1.0)) < 0.1:
        detail = {"magnitude": float(np.median(sizes)), "stated": "m/s^2", "as": "g"}
        yield Finding("force_in_g", "accel", 1, detail)


def _force_unit(quiet: np.ndarray) -> Iterator[Finding]:
    """A gravity in forces (k, 3), whichever way up each is, that is too large by the factor between
    two units.
    """
    size = float(np.median(np.linalg.norm(quiet, axis=1))) if len(quiet) else 0.0
    for factor, (stated, right) in TOO_LARGE.items():
        if abs(size / factor / STANDARD_GRAVITY - 1) < 0.1:
            detail = {"magnitude": size, "stated": stated, "as": right}
            yield Finding("force_unit", "accel", 1, detail)


def _no_gravity(quiet: np.ndarray) -> Iterator[Finding]:
    """Less than the Moon's gravity in forces (k, 3), whichever way up each is: software took
    gravity away, as phones do.
    """
    size = float(np.median(np.linalg.norm(quiet, axis=1))) if len(quiet) else np.inf
    if size < WEIGHTLESS * STANDARD_GRAVITY:
        yield Finding(NO_GRAVITY, "accel", 1, {"magnitude": size})


def quietest_force(recording: Recording) -> np.ndarray | None:
    """The median specific force (3,) over the quietest tenth of the seconds.

    None where it is not gravity, to a tenth. A log need not be at rest for that.
    """
    quiet = _quietest(recording)
    force = np.median(quiet, axis=0) if len(quiet) else None
    return force if _is_gravity(force, STANDARD_GRAVITY) else None


def _is_gravity(force: np.ndarray | None, gravity: float) -> bool:
    return force is not None and abs(np.linalg.norm(force) - gravity) < 0.1 * gravity


def _quietest(recording: Recording) -> np.ndarray:
    """The mean force (k, 3) of each of the quietest seconds, none where no second has all its
    samples.
    """
    seconds = _whole_seconds(recording, recording.accel)
    if not len(seconds):
        return np.zeros((0, 3))
    spread = seconds.std(axis=1).sum(axis=1)
    return seconds[spread <= np.quantile(spread, 0.1)].mean(axis=1)


def _whole_seconds(
    recording: Recording, *groups: np.ndarray, most: int | None = None
) -> np.ndarray:
    """The ``groups`` (n, 3) side by side in the seconds (k, length, c) that have all their samples,
    of at ``most`` so many, evenly over the log.
    """
    length = max(4, min(round(recording.sample_rate), len(recording) // 10))
    count = len(recording) // length
    picked = slice(None) if most is None else drawn(count, most)
    parts = [v[: count * length].reshape(count, length, v.shape[1])[picked] for v in groups]
    seconds = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=2)
    return seconds[np.all(np.isfinite(seconds), axis=(1, 2))]
