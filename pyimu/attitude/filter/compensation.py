"""What a part's effects mean to its attitude filter: the sensors' errors undone, and the noise that
stays.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.variables import EXTRA_INPUTS
from pyimu.block.variables import Variable
from pyimu.model.part import Part, input_variables
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS, Derived, vector

TRUE = ("rate", "specific_force")
"""What gyro and accelerometer measure."""

HORIZON = 100.0
"""s; over this time the random walks that stand for correlated noise grow as it does."""

NEWTON = 2
"""Steps by which rate and force are found where the errors depend on signals that are made of them;
one step is exact where the errors are affine in rate and force."""

NOT_UNDONE = "not undone, and in no standard deviation but that of rounding"
"""What is said of the errors that the filter leaves in."""


def left_in(part: Part) -> tuple[str, ...]:
    """The errors of a part that its filter leaves in, as ``time_delay of the gyro``."""
    sensors = (part.gyro, part.accel)
    return tuple(f"{name} of the {s.kind}" for s in sensors for name in s.left_in)


# Compensation


@dataclass(frozen=True)
class Compensation:
    """The effects of a ``part`` solved for its inputs, sample by sample, with the memory that they
    and the derived signals need.
    """

    part: Part

    @property
    def signals(self) -> frozenset[str]:
        """Names in ``SIGNALS`` of what it needs beside what the sensors measure."""
        return needed_signals(self.part.gyro) | needed_signals(self.part.accel)

    @property
    def derived(self) -> Derived:
        """The signals on which effects depend and that are made from the inputs."""
        return Derived.of(self.signals)

    @property
    def extra(self) -> tuple[str, ...]:
        """Names of the signals beside temperature that must be inputs."""
        return tuple(n for n in EXTRA_INPUTS if n in self.signals)

    @property
    def extra_inputs(self) -> tuple[Variable, ...]:
        """The variables of those signals."""
        return input_variables(self.extra)

    @property
    def implicit(self) -> bool:
        """Whether the errors depend on what is only known without them: on a signal that is made of
        rate or force, or those of each sensor on the input of the other.
        """
        course = {of for name in self.signals for of in SIGNALS[name].of} & {
            "rate",
            "specific_force",
        }
        return bool(course) or (
            "rate" in needed_signals(self.part.accel)
            and "specific_force" in needed_signals(self.part.gyro)
        )

    @property
    def start(self) -> list[float]:
        """The memory before the first sample; empty where none is needed."""
        return [0.0] * self.derived.size + [
            *self.part.gyro.chain.start,
            *self.part.accel.chain.start,
        ]

    def apply(self, memory, measured: dict, gyro_p, accel_p, h):
        """The memory after the sample, rate and force (3,) without the sensors' errors, and marks
        (3,) each of the axes of gyro and accelerometer that are lost.

        ``measured`` has ``rate`` and ``specific_force`` (3,) as measured, and of the other signals
        what is known: the attitude is the filter's own; the velocity is not known and taken as
        zero.
        """

        def undone(true: dict):
            return self._undone(memory, measured, true, gyro_p, accel_p, h)

        true = {n: measured[n] for n in TRUE}
        if self.implicit:
            true = _solved(
                lambda z: undone(dict(zip(TRUE, ca.vertsplit(z, 3), strict=True)))[1:3],
                ca.vertcat(*true.values()),
            )
        return undone(true)

    def _undone(self, memory, measured: dict, true: dict, gyro_p, accel_p, h):
        """The same as ``apply``, where the signals on which errors depend follow from the ``true``
        rate and force, as far as they are not found on the way.

        That sensor goes first on whose input the errors of the other depend.
        """
        gyro, accel = self.part.gyro, self.part.accel
        size, of_gyro = self.derived.size, self.derived.size + len(gyro.chain.start)
        before, gyro_state, accel_state = ca.vertsplit(memory, [0, size, of_gyro, memory.numel()])
        unknown = ("attitude", "latitude", "velocity", *EXTRA_INPUTS)
        at = {n: ca.DM(SIGNALS[n].start) for n in unknown} | measured | true
        after, made = self.derived.advance(before, at, h)
        at |= self._where_known(made, measured)
        ways = {
            "rate": (gyro, gyro_state, gyro_p),
            "specific_force": (accel, accel_state, accel_p),
        }
        out = {}
        for name in TRUE if "rate" in needed_signals(accel) else reversed(TRUE):
            sensor, state, p = ways[name]
            out[name] = sensor.compensation(state, measured[name], vector(at), p, h)
            at = at | {name: out[name][1]}
        (gyro_after, rate, gyro_lost), (accel_after, force, accel_lost) = (out[n] for n in TRUE)
        # casadi makes a row of nothing out of a slice of one number, and counts it when it is
        # stacked.
        kept = ca.vertcat(after[:size], gyro_after, accel_after)
        return kept, rate, force, gyro_lost, accel_lost

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


def noise_of(sensor: Sensor, p, h=0.0) -> TriadNoise:
    """White noise, random walk and rate-dependent noise of a triad, and in the first two what
    stands for its correlated noise and its rounding; all by the laws of its effects.

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
            fast, slow = _as_random_walk(variance, tau)
            white, walk = ca.sqrt(white**2 + fast), ca.sqrt(walk**2 + slow)
    return TriadNoise(white, walk, relative)


def _as_random_walk(variance, tau):
    """Squared root densities of the white noise and the random walk that together stand for a
    Gauss-Markov process.

    The filter has no state for the process, so that its model is wider. Over ``HORIZON`` T the
    increment of the process has the variance 2 s^2 (1 - exp(-T/tau)), which is K^2 T of the walk.
    A process that is fast against T acts on the angle like white noise of density 2 s^2 tau; of a
    slow one the walk has that part already.
    """
    grown = -ca.expm1(-HORIZON / tau)
    fast = 1 - grown * tau / HORIZON
    return 2 * variance * tau * fast**2, 2 * variance * grown / HORIZON
