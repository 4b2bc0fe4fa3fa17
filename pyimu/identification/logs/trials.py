"""The trials of a sensor: its logs, each beside what its reference says."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.trial import HELD_OUT, Trial
from pyimu.identification.reference.above import with_gyro_above, with_sensor_above
from pyimu.identification.reference.align import aligned
from pyimu.identification.reference.belongs import misfit
from pyimu.identification.reference.clock import rebanded
from pyimu.identification.reference.filter_left import with_filter_left
from pyimu.identification.reference.heading_drifts import with_steady_heading
from pyimu.identification.reference.place import (
    at_the_sensor,
    headed,
    is_borne_out,
    is_differentiated,
    quietened,
)
from pyimu.identification.reference.quiet_rate import with_quiet_rate
from pyimu.identification.reference.slipped_mount import with_one_mounting
from pyimu.identification.reference.struck import as_struck
from pyimu.identification.reference.turned import with_mounting
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.course import has_course
from pyimu.recording.rest import is_at_rest

BAND_SHARE = 0.75
"""Share of the band in which gyro and derived reference agree that is used: at its edge a tenth of
the power is noise."""

SHORTEST = 64
"""Rows of a log below which nothing can be said of it."""

Together = tuple[list[Trial], list[Trial]]
"""Trials of the logs to fit, and of those to judge by."""


def aligned_trials(
    sensor: Sensor,
    make: Callable,
    logs: list[Recording],
    others: list[Recording],
    latitude: float | None,
    lines: bool = True,
    known: Mapping[str, Clock] = MappingProxyType({}),
    may_be_late: bool = True,
) -> Together:
    """Trials of ``logs`` and ``others`` that ``make`` makes, the references on the sensor's clock;
    one that seems to drift a little has its line where ``lines`` are wanted. ``known`` are clocks
    that another sensor showed, by log; a lag in common is the clocks' where the sensor is not one
    that ``may_be_late``.
    """

    def trial(r: Recording) -> Trial | None:
        static = is_at_rest(r)
        if sensor.kind == "accel":
            return make(r, static, latitude)
        return make(r, latitude) if static or has_reference(r) else None

    fitted = [t for t in map(trial, logs) if t is not None and t.count >= SHORTEST]
    apart = [t for t in map(trial, others) if t is not None and t.count >= SHORTEST]
    clocked = list(with_mounting(aligned(fitted, apart, sensor, lines, known, may_be_late)))
    clocked = [with_steady_heading(with_one_mounting(t)) for t in clocked]
    return clocked[: len(fitted)], clocked[len(fitted) :]


def clocks_of(together: Together) -> dict[str, Clock]:
    """By log the clocks that trials have had taken out."""
    trials = (t for some in together for t in some)
    return {t.name: t.clock for t in trials if t.clock is not None and t.clock.taken_out}


def prepared(fitted: list[Trial], apart: list[Trial], others: bool) -> Together:
    """The trials to fit and to judge by, through one band; where there are no ``others`` to judge
    by, the last part of each log is.
    """
    fitted, apart = ([_of_place(t) for t in ts] for ts in (fitted, apart))
    bands = [t.band_hz for t in fitted if t.band_hz is not None]
    if bands:
        band = BAND_SHARE * float(np.median(bands))
        fitted, apart = (
            [with_quiet_rate(as_struck(replace(t, band_hz=band))) for t in ts]
            for ts in (fitted, apart)
        )
    differentiated = filter(is_differentiated, (*fitted, *apart))
    if not all(is_borne_out(t) and not misfit([t]) for t in differentiated):
        return [], []
    if others:
        return fitted, apart
    halves = [(a, b) for a, b in (t.split(HELD_OUT) for t in fitted) if a.count >= SHORTEST // 2]
    return [a for a, _ in halves], [b for _, b in halves if b.count]


def _of_place(trial: Trial) -> Trial:
    """The trial with its force as it acts in the world of its attitudes; one that was given is
    taken as the sensor's where it may be.
    """
    if is_differentiated(trial):
        return with_filter_left(quietened(rebanded(with_sensor_above(headed(trial)))))
    return at_the_sensor(with_gyro_above(trial))


def has_reference(recording: Recording) -> bool:
    direct = (recording.ref_rate, recording.ref_q, recording.ref_heading, recording.ref_force)
    given = any(v is not None for v in direct) or recording.reference is not None
    return given or has_course(recording)
