"""One noise of one axis, with all that is known of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import control
import numpy as np

from pyimu.errors import UserError
from pyimu.model.effects import EFFECTS
from pyimu.model.kinds import OWN
from pyimu.model.law import Law
from pyimu.model.sensor import Sensor
from pyimu.shaping import closed
from pyimu.shaping.allan import allan_deviation, clusters
from pyimu.shaping.continuous import (
    continuous_filter,
    discretise,
    has_filter,
    transfer_function,
    white,
)
from pyimu.shaping.sampled import only, operating_point, psd_two_sided, shaping_filter

NOISE_LIKE = tuple(e.name for e in EFFECTS if e.law and not e.stochastic)
"""Effects that draw nothing and stand in the field's tables of noises all the same."""

Closed = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, repr=False)
class NoiseModel:
    """The noise of one effect on one axis; ``describe`` makes it.

    ``sampled`` is the discrete filter from standard normals, what the simulation does;
    ``continuous`` the field's filter from white noises of density 1, None where the noise belongs
    to the sample and not to time; ``transfer_function`` H(s) the one from a single such noise whose
    density |H(j 2 pi f)|^2 is that of the samples far below Nyquist. All three are None for a rate
    ramp, which is no random process. ``closed_allan`` is the Allan deviation of the samples in
    closed form, where there is one.
    """

    sensor: str
    effect: str
    axis: int
    unit: str
    sample_period: float
    sampled: control.StateSpace | None = field(compare=False)
    continuous: control.StateSpace | None = field(compare=False)
    transfer_function: control.TransferFunction | None = field(compare=False)
    closed_allan: Closed | None = field(compare=False)
    label: Closed | None = field(default=None, compare=False)

    @property
    def poles(self) -> np.ndarray:
        """Poles [1/s] of the transfer function (m,), the slowest first; none for white noise."""
        if self.transfer_function is None:
            return np.zeros(0)
        found = (
            self.continuous.poles()
            if self.continuous is not None
            else self.transfer_function.poles()
        )
        return np.sort(found.real)[::-1] + 0.0

    def psd_two_sided(self, f: np.ndarray) -> np.ndarray:
        """Two-sided density of the samples at ``f`` [Hz], in unit^2/Hz, shape of ``f``.

        A ramp's is the formal label R^2 / (2 pi f)^3.
        """
        return (
            self.label(np.asarray(f, dtype=float))
            if self.sampled is None
            else psd_two_sided(self.sampled, f)
        )

    def allan_deviation(self, tau: np.ndarray) -> np.ndarray:
        """Allan deviation (n,) of the samples at ``tau`` (n,) s, multiples of the sample period.

        It is in closed form or by the integral.

        Raises ValueError for another tau.
        """
        if self.closed_allan is None:
            return allan_deviation(self.psd_two_sided, tau, self.sample_period)
        return self.closed_allan(clusters(tau, self.sample_period) * self.sample_period)

    def bode(self, f: np.ndarray) -> control.FrequencyResponseData:
        """Response of the transfer function at ``f`` (n,) Hz.

        ``.magnitude``, ``.phase`` and ``.plot()`` are those of python-control.
        """
        return control.frequency_response(
            self._existing(self.transfer_function, "transfer function"),
            2 * np.pi * np.asarray(f, dtype=float),
        )

    def discrete(self, sample_period: float | None = None) -> control.StateSpace:
        """The continuous filter sampled exactly, by Van Loan's method.

        The sample period [s] is the model's or another.

        Raises UserError where there is no continuous filter.
        """
        return discretise(
            self._existing(self.continuous, "continuous filter"),
            sample_period or self.sample_period,
        )

    @property
    def stationary_covariance(self) -> np.ndarray | None:
        """Stationary covariance (m, m) of the filter's states, P = A P A^T + B B^T.

        None where it grows for ever.
        """
        if self.sampled is None or np.any(np.abs(self.sampled.poles()) >= 1):
            return None
        a, q = self.sampled.A, self.sampled.B @ self.sampled.B.T
        return np.array(control.dlyap(a, q)) if len(a) else np.zeros((0, 0))

    @property
    def standard_deviation(self) -> float:
        """Stationary standard deviation of a sample, in the output's unit.

        It is infinite where the noise grows for ever.
        """
        p = self.stationary_covariance
        if p is None:
            return np.inf
        c, d = self.sampled.C, self.sampled.D
        return float(np.sqrt((c @ p @ c.T + d @ d.T).item()))

    def _existing(self, system, what: str):
        if system is None:
            raise UserError(
                f"{self.sensor}.{self.effect} has no {what}; psd_two_sided and allan_deviation are "
                "what is known of its samples"
            )
        return system

    def __repr__(self) -> str:
        poles = ", ".join(f"{p:.4g}" for p in self.poles) or "none"
        stds = f"standard deviation {self.standard_deviation:.4g} {self.unit}"
        return (
            f"NoiseModel({self.sensor}.{self.effect}, axis {'xyz'[self.axis]}, every "
            f"{self.sample_period:g} s: poles [1/s] {poles}; {stds})"
        )


def describe(
    sensor: Sensor,
    effect: str,
    axis: int,
    sample_period: float,
    *,
    at: float | None = None,
    slope: float = 0.0,
) -> NoiseModel:
    """The noise of one effect of a sensor on one axis (0 to 2), sampled every ``sample_period`` s.

    ``at`` and ``slope`` are the axis's own input (at rest and level unless given) and its rate, on
    which rate-dependent noise and jitter depend. ``quantization`` counts as the white noise q^2 h
    / 12, which it is where other noise exceeds q / 2, and ``angle_quantization`` as the difference
    of independent errors Q = q / sqrt(12), likewise.

    Raises UserError where the sensor lacks the effect, or the effect is neither a noise nor listed
    in ``NOISE_LIKE``.
    """
    alone = only(sensor, effect)
    law, stochastic = alone.effect(effect).law, alone.effect(effect).stochastic
    if law is None:
        raise UserError(
            f"{sensor.kind}.{effect} draws no noise and is not {' or '.join(NOISE_LIKE)}"
            if not stochastic
            else f"{sensor.kind}.{effect} has no law: give its definition one"
        )
    c = alone.of_axis(effect, axis)
    x, h = operating_point(sensor, axis, at, slope)[OWN[sensor.kind].start + axis], sample_period
    sampled = (
        shaping_filter(sensor, effect, axis, h, at=at, slope=slope)
        if stochastic
        else _noise_like(law, c, h)
    )
    continuous = continuous_filter(effect, c, x) if has_filter(law) else None
    ramp = law.value("ramp", c)
    return NoiseModel(
        sensor.kind,
        effect,
        axis,
        sensor.output.unit,
        h,
        sampled,
        continuous,
        _transfer(law.value("rounding", c), h, sampled, continuous),
        _closed(law, c, h, sampled),
        None if ramp is None else lambda f: ramp**2 / (2 * np.pi * f) ** 3,
    )


def _noise_like(law: Law, c: Mapping[str, float], h: float) -> control.StateSpace | None:
    """The system that makes the samples' errors where nothing is drawn; None for a ramp.

    It is white noise, or for a rounded integral y_k = (e_k-1 - e_k) / h with white e.
    """
    density, rounding = law.value("white", c, h=h), law.value("rounding", c)
    if density is not None:
        std = np.sqrt(density / h)
        return control.ss(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((1, 0)), [[std]], h)
    if rounding is not None:
        return control.ss([[0.0]], [[rounding]], [[1 / h]], [[-rounding / h]], h)
    return None


def _transfer(
    rounding: float | None,
    h: float,
    sampled: control.StateSpace | None,
    continuous: control.StateSpace | None,
) -> control.TransferFunction | None:
    if continuous is not None:
        return transfer_function(continuous)
    if sampled is None:
        return None
    if rounding is not None:
        return control.tf([rounding * np.sqrt(h), 0.0], [1.0])
    return transfer_function(white(float(np.linalg.norm(sampled.D)) * np.sqrt(h)))


def _closed(
    law: Law, c: Mapping[str, float], h: float, sampled: control.StateSpace | None
) -> Closed | None:
    """The closed forms of Hidalgo 2012, table 3, that are exact for samples.

    A sum of Gauss-Markov processes is left to the integral.
    """
    ramp, rounding, walk = (law.value(part, c) for part in ("ramp", "rounding", "walk"))
    if ramp is not None:
        return lambda tau: closed.ramp_deviation(ramp, tau)
    if rounding is not None:
        return lambda tau: closed.angle_quantization_deviation(rounding, tau)
    if walk is not None and law.white is None and law.markov is None:
        return lambda tau: closed.random_walk_deviation(np.sqrt(walk), tau, h)
    if sampled.nstates == 0:
        return lambda tau: closed.white_deviation(np.linalg.norm(sampled.D) * np.sqrt(h), tau)
    return None
