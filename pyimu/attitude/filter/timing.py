"""When a sensor's samples were taken: the effects that make it late, and those of its clock.

A sample that is late by d holds the motion of d ago, without an error. It is not changed: the
filter estimates the attitude of that instant, and its outputs are turned on over d (a unit) or
brought to the rows that they belong to (a log). That also serves for the lags, to the second order
in the motion's frequency times d: their inverses, y + tau dy/dt and the like, would amplify the
noise of a sample without bound as the lag grows.

A sample is turned by as the mean rate of the period that it ends. Where a part says how late its
gyro is, that is against the rate of an instant, y(t) = x(t - d); period times such rates adds up to
the turn until half a period after the last one (the midpoint rule). Of a gyro of which nothing is
said the delay is taken for that half period, as of the mean rate of a period.
"""

from __future__ import annotations

from collections.abc import Iterable

import casadi as ca

from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor


def coefficients(sensor: Sensor, p, effect: str) -> dict[str, ca.SX]:
    """The coefficients of an effect out of the sensor's parameters ``p``, each as a column."""
    found: dict[str, list] = {}
    for i, slot in enumerate(sensor.slots):
        if slot.effect == effect:
            found.setdefault(slot.parameter, []).append(p[i])
    return {name: ca.vertcat(*values) for name, values in found.items()}


def clock_error(sensor: Sensor, p):
    """The relative error of a sensor's clock: its sample k was taken (1 + it) k periods after the
    start. 0 where no effect has one.
    """
    return sum(e.clock(**coefficients(sensor, p, e.name)) for e in sensor.effects if e.clock)


def timed(sensor: Sensor) -> tuple[Effect, ...]:
    """The effects of a sensor that count as a delay.

    A gyro's lag that has an inverse keeps it. What that does to the noise does not add up: the
    angle of y + tau dy/dt is that of y and tau y. In an accelerometer it would hide when the body
    is quasi-static.
    """
    return tuple(e for e in sensor.effects if e.delay and not (e.invertible and _turns(sensor)))


def tells_instant(gyro: Sensor) -> bool:
    """Whether a part says how late its gyro is: by a delay, or a lag that is undone."""
    return any(e.delay for e in gyro.effects)


def _turns(sensor: Sensor) -> bool:
    """Whether what a sensor measures is integrated to the attitude."""
    return sensor.kind == "gyro"


def untimed(sensor: Sensor) -> Sensor:
    """The sensor without the effects that count as a delay."""
    late = timed(sensor)
    return sensor.without(*(e.name for e in late)) if late else sensor


def own_coefficients(whole: Sensor, part: Sensor, p):
    """Those of the parameters ``p`` of a ``whole`` sensor that a ``part`` of its effects has."""
    if len(part.slots) == len(whole.slots):
        return p
    at = {s.name: i for i, s in enumerate(whole.slots)}
    return ca.vertcat(ca.SX(0, 1), *[p[at[s.name]] for s in part.slots])


def latency(sensor: Sensor, p):
    """s; by how much a sensor's samples are late, the mean of its axes. 0 where nothing makes them
    so.
    """
    return _delay(sensor, p, timed(sensor))


def _delay(sensor: Sensor, p, effects: Iterable[Effect]):
    delays = [e.delay(**coefficients(sensor, p, e.name)) for e in effects]
    return sum(ca.sum1(d) / d.numel() for d in map(ca.SX, delays))


def estimate_latency(gyro: Sensor, p, h):
    """s; by how much the estimate is late after a sample of the gyro, of period ``h`` s.

    Where the sample's instant is known, the estimate's is half a period later, so that this can be
    below zero. A lag that is undone is known, too.
    """
    said = _delay(gyro, p, (e for e in gyro.effects if e.delay))
    return ca.if_else(said > 0, latency(gyro, p) - h / 2, 0)
