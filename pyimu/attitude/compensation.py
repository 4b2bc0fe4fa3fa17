"""The sensors' errors undone, and what of them stays as noise: what a part's effects mean to its
attitude filter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.variables import EXTRA_INPUTS
from pyimu.model.effects.noise import flicker_processes
from pyimu.model.part import Part, input_variables
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS, Derived, vector

TRUE = ("rate", "specific_force")
"""What the sensors measure: gyro and accelerometer."""

HORIZON = 100.0
"""s; over so long a time the random walks that stand for correlated noise grow as it does."""

NEWTON = 2
"""Steps by which rate and force are found where the errors depend on their course; one is exact
where these are affine in them."""


# Compensation


@dataclass(frozen=True)
class Compensation:
    """A part's effects solved for its inputs, sample by sample, with the memory that they and the
    derived signals need.
    """

    part: Part

    @property
    def derived(self) -> Derived:
        return Derived.of(self.part.signals)

    @property
    def extra(self) -> tuple[str, ...]:
        """Signals beside temperature that must be inputs."""
        return tuple(n for n in EXTRA_INPUTS if n in self.part.signals)

    @property
    def extra_inputs(self):
        return input_variables(self.extra)

    @property
    def implicit(self) -> bool:
        """Whether the errors depend on what is only known without them: the course of rate or
        force, or either sensor on the other.
        """
        course = {of for name in self.part.signals for of in SIGNALS[name].of} & {
            "rate",
            "specific_force",
        }
        return bool(course) or (
            "rate" in self.part.accel.signals and "specific_force" in self.part.gyro.signals
        )

    @property
    def start(self) -> list[float]:
        """The memory before the first sample."""
        return [0.0] * self.derived.size + [
            *self.part.gyro.chain.start,
            *self.part.accel.chain.start,
        ]

    def apply(self, memory, measured: dict, gyro_p, accel_p, h):
        """Memory that follows, rate and force (3,) without the sensors' errors, and marks (3,) each
        of what is lost.

        ``measured`` has ``rate`` and ``specific_force`` (3,) as measured, and of the other inputs
        of ``SIGNALS`` what is known: the attitude is the filter's own, the velocity nobody's and
        taken as zero.
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
        """The same, where what the errors depend on follows from the ``true`` rate and force, as
        far as it is not found on the way.

        The sensor goes first on whose input the other's errors depend.
        """
        sizes = [
            self.derived.size,
            len(self.part.gyro.chain.start),
            len(self.part.accel.chain.start),
        ]
        before, gyro_state, accel_state = ca.vertsplit(
            memory, [0, sizes[0], sizes[0] + sizes[1], sum(sizes)]
        )
        at = (
            {
                n: ca.DM(SIGNALS[n].start)
                for n in ("attitude", "latitude", "velocity", *EXTRA_INPUTS)
            }
            | measured
            | true
        )
        after, made = self.derived.advance(before, at, h)
        at |= self._where_known(made, measured)
        states, parameters, out = (
            {"rate": gyro_state, "specific_force": accel_state},
            {"rate": gyro_p, "specific_force": accel_p},
            {},
        )
        for name in TRUE if "rate" in self.part.accel.signals else reversed(TRUE):
            sensor = self.part.gyro if name == "rate" else self.part.accel
            out[name] = sensor.compensation(
                states[name], measured[name], vector(at), parameters[name], h
            )
            at = at | {name: out[name][1]}
        gyro, accel = (out[n] for n in TRUE)
        # casadi makes a row of nothing out of a slice of one number, and counts it when it is
        # stacked.
        return (
            ca.vertcat(after[: sizes[0]], gyro[0], accel[0]),
            gyro[1],
            accel[1],
            gyro[2],
            accel[2],
        )

    @staticmethod
    def _where_known(made: dict, measured: dict) -> dict:
        """Without a latitude there is no Earth rate."""
        known = measured.get("latitude_known", 1)
        return {n: v * known if n == "earth_rate" else v for n, v in made.items()}


def _solved(undone, start) -> dict:
    """Rate and force z (6,) that ``undone(z)`` gives back, by Newton's method from ``start``."""
    z = ca.SX.sym("z", 6)
    left = ca.vertcat(*undone(z)) - z
    step = z - ca.solve(ca.jacobian(left, z), left)
    for _ in range(NEWTON):
        start = ca.substitute(step, z, start)
    return dict(zip(TRUE, ca.vertsplit(start, 3), strict=True))


# Noise


@dataclass(frozen=True)
class Noise:
    """Densities of a triad as the filter models it: (3,) each; ``white`` {Y}/sqrt(s), ``walk``
    {y}/sqrt(s), ``relative`` sqrt(s).
    """

    white: ca.SX
    walk: ca.SX
    relative: ca.SX


def coefficient(sensor: Sensor, p, effect: str, parameter: str):
    """A coefficient out of the sensor's parameters ``p`` as a column, zero where the part lacks the
    effect.
    """
    at = [
        i
        for i, slot in enumerate(sensor.slots)
        if (slot.effect, slot.parameter) == (effect, parameter)
    ]
    return ca.vertcat(*[p[i] for i in at]) if at else ca.SX.zeros(3)


def noise_of(sensor: Sensor, p, h=0.0) -> Noise:
    """White noise, random walk and rate-dependent noise of a triad, with what stands for its
    correlated noise and its rounding.

    A step q is in each sample of period ``h`` s (0: no rounding) an error of variance q^2/12
    (Widrow and Kollar 2008, section 5.3), white where the other noise is at least of the order of
    q; below that, rounding is a bias of up to q/2, which the random walk has to follow.
    """
    noise = Noise(
        *(
            coefficient(sensor, p, *name)
            for name in (
                ("angle_random_walk", "N"),
                ("rate_random_walk", "K"),
                ("rate_dependent_noise", "k"),
            )
        )
    )
    if "quantization" in sensor.values:
        noise = replace(
            noise,
            white=ca.sqrt(
                noise.white**2 + coefficient(sensor, p, "quantization", "q") ** 2 * h / 12
            ),
        )
    for variance, tau in correlated(sensor, p):
        white, walk = _as_random_walk(variance, tau)
        noise = replace(
            noise, white=ca.sqrt(noise.white**2 + white), walk=ca.sqrt(noise.walk**2 + walk)
        )
    return noise


def correlated(sensor: Sensor, p) -> list[tuple]:
    """Variance (3,) and correlation time of every Gauss-Markov process in a triad's noise."""
    out = []
    if "gauss_markov" in sensor.values:
        q, tau = (coefficient(sensor, p, "gauss_markov", n) for n in ("q", "tau"))
        out.append((q**2 * tau / 2, tau))
    if "bias_instability" in sensor.values:
        b, low, high = (
            coefficient(sensor, p, "bias_instability", n) for n in ("B", "f_low", "f_high")
        )
        out += [(variance, 1 / rate) for variance, rate in flicker_processes(b, low, high)]
    return out


def _as_random_walk(variance, tau):
    """Squared densities, white and walk, that stand for a Gauss-Markov process: wider than it, in
    the filter's few states.

    Over ``HORIZON`` T its increment has the variance 2 s^2 (1 - exp(-T/tau)), which is the walk's
    K^2 T. What is fast against T acts on the angle like white noise of density 2 s^2 tau; of a
    slow process the walk has that part already.
    """
    grown = -ca.expm1(-HORIZON / tau)
    fast = 1 - grown * tau / HORIZON
    return 2 * variance * tau * fast**2, 2 * variance * grown / HORIZON
