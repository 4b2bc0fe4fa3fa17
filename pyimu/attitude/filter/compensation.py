"""What a part's effects mean to its attitude filter: the sensors' errors undone, and the noise that
stays.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.attitude.filter.timing import (
    coefficients,
    estimate_latency,
    latency,
    own_coefficients,
    tells_instant,
    timed,
    untimed,
)
from pyimu.attitude.filter.variables import EXTRA_INPUTS
from pyimu.block.variables import Variable
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS
from pyimu.model.part import Part, input_variables
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS, Derived, vector
from pyimu.symbolic import quaternion

TRUE = ("rate", "specific_force")
"""What gyro and accelerometer measure."""

HORIZON = 100.0
"""s; over this time the random walks that stand for correlated noise grow as it does, where a
filter does not say another."""

SERIES = 1e-2
"""Cluster time over correlation time below which the series of the Allan variance is exact to
1e-6."""

Horizon = float | tuple[float, float]
"""s; over which white noise and random walk stand for correlated noise: its increment over the one
time is that of the walk, which is an upper bound; between the two times its Allan variance is
theirs."""

NEWTON = 2
"""Steps by which rate and force are found where the errors depend on signals that are made of them;
one step is exact where the errors are affine in rate and force."""

ROUNDS = 3
"""Rounds in which effects of differences are undone: what is left is the fourth power of their
share."""

RATES = 6
"""Numbers that the memory has of late samples: the rate, and its mean."""

SHORT = 1e-9
"""s; what is not late by more is not late."""

NOT_UNDONE = "not undone, and in no standard deviation but that of rounding"
"""What is said of the errors that the filter leaves in."""


def left_in(part: Part, retimed: bool = False, delayed: bool = False) -> tuple[str, ...]:
    """The errors of a part that its filter leaves in, as ``quantization of the gyro``.

    A delay or a lag is among them only where the estimate stays ``delayed``. The error of a clock
    is none where samples are ``retimed``.
    """
    left = []
    for s in (part.gyro, part.accel):
        late = {e.name for e in (() if delayed else timed(s))}
        late |= {e.name for e in s.effects if retimed and e.clock}
        left += [f"{name} of the {s.kind}" for name in s.left_in if name not in late]
    return tuple(left)


# Compensation


@dataclass(frozen=True)
class Compensation:
    """The effects of a ``part`` solved for its inputs, sample by sample, with the memory that they
    and the derived signals need.
    """

    part: Part
    now: bool = True

    @property
    def structure(self) -> tuple:
        """All that the equations depend on: the coefficients of the effects are parameters."""
        part = self.part
        return part.gyro.effects, part.accel.effects, part.sample_rate, self.now

    @property
    def shows_now(self) -> bool:
        """Whether the estimate is not of now, and what is shown of it shall be."""
        return self.now and tells_instant(self.part.gyro)

    @property
    def gyro(self) -> Sensor:
        """The part's gyro less what counts as a delay."""
        return untimed(self.part.gyro)

    @property
    def accel(self) -> Sensor:
        """The part's accelerometer less what counts as a delay."""
        return untimed(self.part.accel)

    @property
    def signals(self) -> frozenset[str]:
        """Names in ``SIGNALS`` of what it needs beside what the sensors measure."""
        return needed_signals(self.gyro) | needed_signals(self.accel)

    @property
    def late(self) -> bool:
        """Whether the samples of a sensor are of another time than now."""
        return tells_instant(self.part.gyro) or bool(timed(self.part.accel))

    @property
    def derived(self) -> Derived:
        """The signals on which effects depend and that are made from the inputs."""
        return Derived.of(self.signals - {*self.slopes.names})

    @property
    def slopes(self) -> Derived:
        """Of these the differences that are taken in rounds."""
        growing = (s for s in (self.gyro, self.accel) if any(_grows(e, s.kind) for e in s.effects))
        return Derived.of(KINDS[s.kind].own_rate for s in growing)

    @property
    def extra(self) -> tuple[str, ...]:
        """Names of the signals beside temperature that must be inputs."""
        return tuple(n for n in EXTRA_INPUTS if n in self.signals)

    @property
    def extra_inputs(self) -> tuple[Variable, ...]:
        """The variables of those signals, less those that are inputs for every part."""
        return input_variables(tuple(n for n in self.extra if n != "mag"))

    @property
    def implicit(self) -> bool:
        """Whether the errors depend on what is only known without them, slopes apart: on a signal
        that is made of rate or force, or those of each sensor on the input of the other.
        """
        course = {of for name in self.derived.names for of in SIGNALS[name].of} & {*TRUE}
        return bool(course) or (
            "rate" in needed_signals(self.accel) and "specific_force" in needed_signals(self.gyro)
        )

    @property
    def sizes(self) -> tuple[int, ...]:
        """Numbers of the memory: derived signals, slopes, gyro, accelerometer, rates."""
        return (
            self.derived.size,
            ROUNDS * self.slopes.size,
            len(self.gyro.chain.start),
            len(self.accel.chain.start),
            RATES * self.late,
        )

    @property
    def start(self) -> list[float]:
        """The memory before the first sample; empty where none is needed."""
        derived, slopes, *_, rates = self.sizes
        sensors = [*self.gyro.chain.start, *self.accel.chain.start]
        return [0.0] * (derived + slopes) + sensors + [0.0] * rates

    def apply(self, memory, measured: dict, gyro_p, accel_p, h):
        """The memory after the sample, rate and force (3,) without the sensors' errors, and marks
        (3,) each of the axes of gyro and accelerometer that are lost.

        ``measured`` has ``rate`` and ``specific_force`` (3,) as measured, and of the other signals
        what is known: the attitude is the filter's own; the velocity is not known and taken as
        zero. All are of the estimate's instant, which is ``estimate_latency`` ago.

        The ``slopes`` are those of what the round before restored: what feeds on its own past can
        grow from sample to sample, as the inverse of y = x + c dx/dt does where c < -h/2, and this
        cannot. Each round leaves the error of the one before times the effect's share.
        """
        derived, slopes, gyro, accel, rates = ca.vertsplit(
            memory, [0, *np.cumsum(self.sizes).tolist()]
        )
        p = (
            own_coefficients(self.part.gyro, self.gyro, gyro_p),
            own_coefficients(self.part.accel, self.accel, accel_p),
        )
        true, kept = {n: measured[n] for n in TRUE}, []
        size = self.slopes.size
        for before in ca.vertsplit(slopes, size) if size else [slopes]:
            after, slope = self.slopes.advance(before, true, h)
            found = self._round((derived, gyro, accel), measured | slope, true, p, h)
            true = dict(zip(TRUE, found[3:5], strict=True))
            kept.append(after)
        rate, force = true.values()
        if self.late:
            rates = self._followed(rates, rate, gyro_p, h)
            force = self._at_the_estimates_instant(force, rate, gyro_p, accel_p, h)
        memory = ca.vertcat(found[0], *kept, found[1], found[2], rates)
        return memory, rate, force, *found[5:]

    def _round(self, memory: tuple, measured: dict, true: dict, p: tuple, h) -> tuple:
        """``_undone`` from the ``true`` rate and force of the round before."""

        def undone(true: dict):
            return self._undone(memory, measured, true, p, h)

        if self.implicit:
            true = _solved(
                lambda z: undone(dict(zip(TRUE, ca.vertsplit(z, 3), strict=True)))[3:5],
                ca.vertcat(*true.values()),
            )
        return undone(true)

    def _undone(self, memory: tuple, measured: dict, true: dict, p: tuple, h) -> tuple:
        """The memory of derived signals, gyro and accelerometer after the sample, and the rest as
        of ``apply``, where the signals on which errors depend follow from the ``true`` rate and
        force, as far as they are not found on the way.

        That sensor goes first on whose input the errors of the other depend.
        """
        before, gyro_state, accel_state = memory
        unknown = ("attitude", "latitude", "velocity", *EXTRA_INPUTS)
        at = {n: ca.DM(SIGNALS[n].start) for n in unknown} | measured | true
        after, made = self.derived.advance(before, at, h)
        at |= self._where_known(made, measured)
        ways = {
            "rate": (self.gyro, gyro_state, p[0]),
            "specific_force": (self.accel, accel_state, p[1]),
        }
        out = {}
        for name in TRUE if "rate" in needed_signals(self.accel) else reversed(TRUE):
            sensor, state, own = ways[name]
            out[name] = sensor.compensation(state, measured[name], vector(at), own, h)
            at = at | {name: out[name][1]}
        (gyro_after, rate, gyro_lost), (accel_after, force, accel_lost) = (out[n] for n in TRUE)
        return after, gyro_after, accel_after, rate, force, gyro_lost, accel_lost

    def _followed(self, rates, rate, gyro_p, h):
        """The compensated ``rate`` and its mean over about the gyro's delay, as a column (6,)."""
        mean, delay = rates[3:], latency(self.part.gyro, gyro_p)
        return ca.vertcat(rate, mean - ca.expm1(-h / ca.fmax(delay, SHORT)) * (rate - mean))

    def _at_the_estimates_instant(self, force, rate, gyro_p, accel_p, h):
        """The force in the body's axes as they were at the instant of the estimate.

        An accelerometer of which nothing is known to be late is as late as the estimate, and no
        earlier than its row: by the reference's positions it is later by 0.0 to 0.3 ms on
        recordings 02, 11 and 26 of BROAD (``benchmarks/sensor_timing.py``).
        """
        estimate = estimate_latency(self.part.gyro, gyro_p, h)
        known = timed(self.part.accel)
        late = latency(self.part.accel, accel_p) if known else ca.fmax(estimate, 0)
        older = late - estimate
        return quaternion.rotate(quaternion.conjugate(quaternion.exponential(older * rate)), force)

    @staticmethod
    def _where_known(made: dict, measured: dict) -> dict:
        """The derived signals; those that need a latitude are zero without one."""
        known = measured.get("latitude_known", 1)
        return {n: v * known if "latitude" in SIGNALS[n].of else v for n, v in made.items()}


def needed_signals(sensor: Sensor) -> frozenset[str]:
    """Names in ``SIGNALS`` of what a sensor's compensation needs beside the signal it measures."""
    acting = (e for e in sensor.effects if e.invertible or e.states)
    return frozenset().union(*(e.signals(sensor.kind) for e in acting))


def _solved(undone, start) -> dict:
    """Rate and force z (6,) with ``undone(z)`` = z, by Newton's method from ``start``."""
    z = ca.SX.sym("z", 6)
    left = ca.vertcat(*undone(z)) - z
    step = z - ca.solve(ca.jacobian(left, z), left)
    for _ in range(NEWTON):
        start = ca.substitute(step, z, start)
    return dict(zip(TRUE, ca.vertsplit(start, 3), strict=True))


def _grows(effect: Effect, kind: str) -> bool:
    """Whether the inverse of an effect on this kind of sensor may grow from sample to sample."""
    return effect.grows and effect.invertible and KINDS[kind].own_rate in effect.signals(kind)


# Noise


@dataclass(frozen=True)
class TriadNoise:
    """Root densities of a triad's noise as the filter models it, (3,) each.

    With y the unit of the output, rad/s or m/s^2: ``white`` y sqrt(s), the random ``walk``
    y/sqrt(s), and ``relative`` sqrt(s), the noise that is proportional to the input.
    """

    white: ca.SX
    walk: ca.SX
    relative: ca.SX


def share_added(sensor: Sensor, p, signal: str):
    """The share of a signal of known size, such as the Earth's rate, that the sensor's own effects
    add to its input.
    """
    total = ca.SX(0)
    for e in sensor.effects:
        known = [n for n, q in e.parameters.items() if q.known is not None]
        if known and signal in e.environment.values():
            total = total + coefficients(sensor, p, e.name)[known[0]]
    return total


def noise_of(sensor: Sensor, p, h=0.0, horizon: Horizon = HORIZON) -> TriadNoise:
    """White noise, random walk and rate-dependent noise of a triad, and in the first two what
    stands for its correlated noise over ``horizon`` s and its rounding; all by the laws of its
    effects.

    Rounding to a step q adds an error of variance q^2/12 to each sample of period ``h`` s (0: no
    rounding) (Widrow and Kollar 2008, section 5.3). It is white where the other noise is at least
    of the order of q; below that, rounding is a bias of up to q/2, which the random walk has to
    follow. Noise that only changes of the input make is left out.
    """
    white, walk, relative = ca.SX.zeros(3), ca.SX.zeros(3), ca.SX.zeros(3)
    for e in sensor.effects:
        if e.law is None:
            continue
        c = coefficients(sensor, p, e.name)
        at_rest, at_one = (e.law.value("white", c, h=h, slope=0, x=x) for x in (0, 1))
        if at_rest is not None:
            white = ca.sqrt(white**2 + at_rest)
            relative = ca.sqrt(relative**2 + (at_one - at_rest))
        if e.law.walk is not None:
            walk = ca.sqrt(walk**2 + e.law.value("walk", c))
        for variance, tau in e.law.value("markov", c) or ():
            fast, slow = (
                _by_allan(variance, tau, *horizon)
                if isinstance(horizon, tuple)
                else _as_random_walk(variance, tau, horizon)
            )
            white, walk = ca.sqrt(white**2 + fast), ca.sqrt(walk**2 + slow)
    return TriadNoise(white, walk, relative)


def _as_random_walk(variance, tau, horizon):
    """Squared root densities of the white noise and the random walk that together stand for a
    Gauss-Markov process.

    The filter has no state for the process, so that its model is wider. Over the ``horizon`` T the
    increment of the process has the variance 2 s^2 (1 - exp(-T/tau)), which is K^2 T of the walk.
    A process that is fast against T acts on the angle like white noise of density 2 s^2 tau; of a
    slow one the walk has that part already.
    """
    grown = -ca.expm1(-horizon / tau)
    fast = 1 - grown * tau / horizon
    return 2 * variance * tau * fast**2, 2 * variance * grown / horizon


def _by_allan(variance, tau, short, long):
    """Squared root densities of the white noise and the random walk that together have the Allan
    variance of a Gauss-Markov process at the cluster times ``short`` and ``long`` s.

    Theirs is N^2 / t + K^2 t / 3 (IEEE Std 952). A process that is fast against both times is white
    noise of density 2 s^2 tau, a slow one a walk of 2 s^2 / tau. Of flicker, whose Allan variance
    is flat, and of times of which one is three times the other, theirs is 13 % too small in the
    middle, and too large before and after.
    """
    one, two = (_allan_times_time(variance, tau, t) for t in (short, long))
    walk = 3 * (two - one) / (long**2 - short**2)
    # of a very slow process the difference is rounding, of any sign
    return ca.fmax(one - walk * short**2 / 3, 0), walk


def _allan_times_time(variance, tau, time):
    """The Allan variance of a Gauss-Markov process at a cluster ``time``, times that time (IEEE Std
    952, annex C); of a time that is short against ``tau`` by its series.
    """
    x = time / tau
    exact = 1 + (4 * ca.expm1(-x) - ca.expm1(-2 * x)) / (2 * x)
    series = x * x / 3 * (1 - 3 * x / 4 + 7 * x * x / 20)
    return 2 * variance * tau * ca.if_else(x < SERIES, series, exact)
