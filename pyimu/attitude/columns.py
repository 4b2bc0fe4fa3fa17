"""What the attitude filter takes from a recording beside its samples.

The part that stands for an unknown one, and columns with their defaults.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from pyimu.attitude.filter.compensation import noise_of
from pyimu.attitude.filter.tolerances import bias_walk
from pyimu.attitude.filter.variables import UNKNOWN_LATITUDE
from pyimu.attitude.rest import Rest
from pyimu.block.parameters import number
from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE, WALK, WHITE, read_off
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS
from pyimu.recording.quality.clipping import clipping_level
from pyimu.recording.recording import Recording

NOMINAL_K = 3e-5
"""rad/s/sqrt(s); rate random walk of a gyro of whose wander nothing is known. A consumer's flickers
at 5 to 10 deg/h, which is as much in 10 s to a minute."""

NOMINAL_MOTION_BIAS = 1.6e-3
"""rad/s; the setting ``motion_bias`` for such a gyro: in motion its bias is another than at rest by
what its model lacks. On recordings 02, 11 and 26 of BROAD it is another by 0.9e-3 itself
(``pyimu.attitude.filter.turning``). From 1e-3 to 2.5e-3 their headings drift by the same to 2 % in
motion, and so is the inclination of all recordings (``benchmarks/attitude_real.py``)."""

NOMINAL_RATE_NOISE = 0.8e-3
"""sqrt(s); the setting ``rate_noise`` for such a gyro: axes off by a percent, and its timing, for
turns of the order of 0.03 s. What its scale factors make of the attitude ``NOMINAL_SCALE_STD``
has. The inclination of recordings 02, 07, 09 and 26 of BROAD is best from 0.6e-3 to 0.8e-3, and no
more off than is claimed."""

PART_RATE_NOISE = 1.6e-3
"""sqrt(s); the same beside the part of a real sensor, whose scale factors count as calibrated: it
is the least with which the inclination is no more than 1.3 times off what is claimed, squared, on
recordings 02, 11 and 26 of BROAD."""

NOMINAL_SCALE_STD = 0.02
"""1; standard deviation of the scale factor of such a gyro's axis, the setting ``scale_std``. The
MPU-6050's is allowed +-3 % at 25 degC and 2 % over temperature (product specification
PS-MPU-6000A-00 rev. 3.4, section 6.1), each evenly: together 2.1 %. Other consumer parts have the
same +-3 %."""

NOMINAL_AXES_STD = 0.02
"""rad; the setting ``axes_std`` of unknown sensors: a bias of the accelerometer of 20 mg, or axes
that are off by a degree. The MPU-6050's are allowed +-2 % of another axis, evenly 0.012 for either
triad, and +-50 mg before it is calibrated (PS-MPU-6000A-00 rev. 3.4, sections 6.1 and 6.2). Between
0.01 and 0.03 it makes little difference."""

NOISIER = 2.0
"""A specimen's noise may be so many times what its part declares; beyond, what shakes it at rest
is an engine."""

CLEARLY = 1.25
"""Times its part's noise above which a sensor is noisier: 300 samples scatter by a twentieth."""

AS_FAR = 0.8
"""Share of the largest sample below which a level is no end of a sensor's range, offsets and all:
were it taken for one, every sample beyond it would count as lost."""

LEAST_WARMING = 1.0
"""s; in less no part warms, what changes is noise of its thermometer."""

HEADING_STD = 0.035
"""rad; of a recorded heading that comes without a standard deviation."""


def nominal_part(recording: Recording, rest: Rest) -> Part:
    """A part that knows of its sensors their white noise at rest, and where they are clipped."""
    (white, density), (walk, strength) = WHITE, WALK
    gyro = {white: {density: rest.rate_density}, walk: {strength: NOMINAL_K}}
    accel = {white: {density: rest.force_density}}
    return Part(
        "nominal",
        1 / recording.sample_period,
        Sensor("gyro", gyro | _clipped(recording.gyro)),
        Sensor("accel", accel | _clipped(recording.accel)),
    )


def wandering(part: Part, warming: float = 0.0) -> Part:
    """The part, with the nominal rate random walk where it says nothing of its gyro's wander.

    To its own comes what the bias of a specimen does while it warms, which the part's tolerances
    allow; ``warming`` K/sqrt(s) is the walk of the temperature.
    """
    walk, strength = WALK
    own = part.gyro.values.get(walk, {}).get(strength, np.zeros(3))
    if not wanders(part):
        own = np.full(3, NOMINAL_K)
    whole = np.hypot(own, bias_walk(part, warming))
    return (
        part.with_sensor(part.gyro.with_values(walk, **{strength: whole})) if whole.any() else part
    )


def wanders(part: Part) -> bool:
    """Whether the part says how its gyro's bias wanders."""
    laws = [e.law for e in part.gyro.effects if e.law is not None]
    return any(law.walk or law.markov for law in laws)


def motion_bias(part: Part | None) -> float:
    """rad/s; the setting ``motion_bias`` for a part that does not say how its gyro's bias wanders,
    or for an unknown one.
    """
    return 0.0 if part is not None and wanders(part) else NOMINAL_MOTION_BIAS


def warming(recording: Recording) -> float:
    """K/sqrt(s); the strength of a random walk by which the temperature changes as it is recorded.

    The largest that any span shows, in steps of two: over a span s it has changed by its strength
    times the root of s.
    """
    if recording.temperature is None:
        return 0.0
    rows = np.flatnonzero(np.isfinite(recording.temperature))
    spans = 2 ** np.arange(int(np.log2(max(len(rows), 1))))
    found = [0.0]
    for span in spans.tolist():
        off = np.diff(recording.temperature[rows[::span]])
        seconds = (recording.time[rows[-1]] - recording.time[rows[0]]) * span / len(rows)
        if seconds >= LEAST_WARMING and len(off):
            found.append(float(np.sqrt(np.mean(off**2) / seconds)))
    return max(found)


def warmer(recording: Recording, part: Part) -> float:
    """K; root mean square of the recorded temperature against that of no thermal error."""
    if recording.temperature is None:
        return 0.0
    known = recording.temperature[np.isfinite(recording.temperature)]
    return float(np.sqrt(np.mean((known - origin(part)) ** 2))) if len(known) else 0.0


def informed(part: Part, recording: Recording, rest: Rest) -> Part:
    """The part as the filter takes it over a recording.

    Where it says nothing of its gyro's wander it has the nominal one, and that of its tolerances as
    the temperature is recorded. The samples of a real sensor also show its white noise at ``rest``,
    where the part has none or clearly less: a sensor with less noise than it has would never be
    still. And they show where they pile up, at a level that the part does not say: beyond it no
    sample says how far the body turned.
    """
    part = wandering(part, warming(recording))
    if not of_a_sensor(part):
        return part
    for sensor, own in ((part.gyro, rest.rate_density), (part.accel, rest.force_density)):
        part = part.with_sensor(_noisy(sensor, own, recording.sample_period, rest.seen))
    effect, parameter = read_off(CATALOGUE.values(), "ceiling")
    for sensor, values in ((part.gyro, recording.gyro), (part.accel, recording.accel)):
        for seen in _clipped(values).values():
            known = sensor.values.get(effect, {}).get(parameter, np.zeros(3))
            limits = [np.where(v > 0, v, np.inf) for v in (known, seen[parameter])]
            least = np.minimum(*limits)
            limit = np.where(np.isfinite(least), least, 0.0)
            part = part.with_sensor(sensor.with_values(effect, **{parameter: limit}))
    return part


def _noisy(sensor: Sensor, shown: np.ndarray, period: float, at_rest: bool) -> Sensor:
    """The sensor with white noise of the root density (3,) that its samples have ``shown``, where
    it has none of its own, or clearly less than they have ``at_rest``.
    """
    white, parameter = WHITE
    if not any(e.law is not None and e.law.white is not None for e in sensor.effects):
        return sensor.with_values(white, **{parameter: shown})
    known = noise_of(sensor, ca.SX(ca.DM(sensor.p)), period).white
    own = np.array(ca.evalf(known), dtype=float).ravel()
    more = np.where(shown > CLEARLY * own, np.minimum(shown, NOISIER * own), own)
    if not at_rest or np.array_equal(more, own):
        return sensor
    declared = sensor.values.get(white, {}).get(parameter, np.zeros(3))
    density = np.sqrt(declared**2 + more**2 - own**2)
    return sensor.with_values(white, **{parameter: density})


def of_a_sensor(part: Part) -> bool:
    """Whether somebody measured or quoted the figures of the part's gyro, or leaves them to data.

    A part without sources is what a program made of it.
    """
    return bool(part.estimate) or any(kind == "gyro" for kind, *_ in part.notes)


def rate_noise(part: Part | None) -> float:
    """sqrt(s); the setting ``rate_noise`` for a part, or for an unknown one.

    The part of a real sensor leaves out of the rate in motion as much as is left out without it:
    how scale factors change with rate and temperature, axes, the sensor's timing. The parts by
    ``close`` of recordings 02, 11 and 26 of BROAD have scale factors that differ by 0.3 % from the
    slow logs to the fast ones. It is not added where the part itself has such noise.
    """
    if part is None:
        return NOMINAL_RATE_NOISE
    known = any(e.law is not None and e.law.needs("x") for e in part.gyro.effects)
    return PART_RATE_NOISE if of_a_sensor(part) and not known else 0.0


def scale_std(part: Part | None) -> float:
    """1; the setting ``scale_std`` beside a part's tolerances: that of an unknown gyro where there
    is no part.

    A part that says nothing of its scale factor is taken as calibrated: many are, and those that
    are not have a tolerance in their data sheets.
    """
    return NOMINAL_SCALE_STD if part is None else 0.0


def axes_std(part: Part | None) -> float:
    """rad; the setting ``axes_std`` for a part without tolerances, or for an unknown one.

    Nobody measures it: to the accelerometer its bias is a tilt, and each triad has axes of its own.
    """
    unknown = part is None or (of_a_sensor(part) and not part.tolerances)
    return NOMINAL_AXES_STD if unknown else 0.0


def latitude_of(recording: Recording, latitude: float | None) -> float:
    """``latitude`` in rad, else the recording's median, else ``UNKNOWN_LATITUDE``.

    Raises UserError beyond -pi/2 to pi/2.
    """
    column, whose = getattr(recording, "latitude", None), "latitude"
    if latitude is None:
        if column is None or not np.isfinite(column).any():
            return UNKNOWN_LATITUDE
        latitude = float(np.median(column[np.isfinite(column)]))
        whose = f"{recording.name}: column latitude"
    if not abs(number(whose, latitude)) <= np.pi / 2:
        raise UserError(f"{whose} is {latitude} rad, expected -pi/2 to pi/2")
    return float(latitude)


def temperature_of(recording: Recording, part: Part) -> np.ndarray | float:
    """The recorded temperature (n,) in degC.

    Without one, the temperature at which the part has no thermal error.
    """
    if recording.temperature is not None:
        return recording.temperature
    return origin(part)


def origin(part: Part) -> float:
    """The temperature in degC at which the part has no thermal error."""
    origins = (s for s in part.gyro.slots if s.definition.reference and s.unit == "degC")
    found = (part.gyro.values[s.effect][s.parameter] for s in origins)
    return float(next(found, SIGNALS["temperature"].start[0]))


def extra_column(recording: Recording, part: Part, signal: str) -> np.ndarray | None:
    """The column (n, ...) of a further input, None where there is none.

    Raises UserError where an effect of the part depends on it.
    """
    column = getattr(recording, signal, None)
    if column is None and signal in part.signals:
        raise UserError(
            f"{recording.name}: no column {signal} [{SIGNALS[signal].unit}], on which the errors "
            f"of {part.name} depend"
        )
    return column


def _clipped(values: np.ndarray | None) -> dict[str, dict[str, np.ndarray]]:
    """The saturation of a triad (n, 3) whose samples pile up at a level, else nothing."""
    if values is None:
        return {}
    levels = (
        [abs(level) for level in clipping_level(column) if _is_range(level, column)]
        for column in values.T
    )
    limit = np.array([min(level, default=0.0) for level in levels])
    effect, parameter = read_off(CATALOGUE.values(), "ceiling")
    return {effect: {parameter: limit}} if limit.any() else {}


def _is_range(level: float | None, column: np.ndarray) -> bool:
    """Whether a ``level`` at which the samples of a ``column`` (n,) pile up may be the end of the
    sensor's range: that goes as far the other way.
    """
    if level is None:
        return False
    return abs(level) >= AS_FAR * np.max(np.abs(column[np.isfinite(column)]))


def recorded_heading(recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Heading (n,) and its standard deviation (n,) in rad, NaN where there is none."""
    n = len(recording.time)
    if getattr(recording, "heading", None) is None:
        return np.full(n, np.nan), np.full(n, np.nan)
    std = getattr(recording, "heading_std", None)
    return recording.heading, np.full(n, HEADING_STD) if std is None else std


def recorded_age(recording: Recording) -> np.ndarray:
    """How many s (n,) before its row each recorded heading was true; 0 where that is not said.

    Raises UserError for an age below zero.
    """
    age = getattr(recording, "heading_age", None)
    if age is None:
        return np.zeros(len(recording.time))
    age = np.nan_to_num(age)
    if age.min() < 0:
        row = int(np.argmin(age))
        raise UserError(
            f"{recording.name}: heading_age is {age[row]:g} s at {recording.time[row]:g} s, "
            "expected 0 or more"
        )
    return age
