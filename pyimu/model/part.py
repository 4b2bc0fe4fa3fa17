"""The inertial measurement unit: a part as data, and its block."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property

import casadi as ca
import numpy as np

from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.block.variables import IMU, MOTION, Limits, Variable, seed_of
from pyimu.errors import UserError
from pyimu.files import shortened
from pyimu.model import part_plot, show
from pyimu.model.arguments import AXES
from pyimu.model.sensor import Sensor
from pyimu.model.signals import EVERY_SAMPLE, SIGNALS, Derived, inputs_for, vector
from pyimu.model.tolerance import Tolerance, declared, specimen_of
from pyimu.model.truth import measured_recording
from pyimu.recording.clock import RATES
from pyimu.recording.recording import Recording


@dataclass(frozen=True)
class Part:
    """A sensor as data: name, sample rate [Hz], and the effects of its triads.

    The effects are those of two ``Sensor``, gyro and accelerometer, with the values of their
    coefficients. Those of a magnetometer, a third one, are undone by ``pyimu.attitude``; the part's
    block has no magnetometer.

    ``estimate`` names the coefficients ``(sensor, effect, parameter)`` that the part leaves to the
    data; ``notes`` keeps what the file says beside a value: its source, the figure as quoted.
    ``tolerances`` say how far specimens of the part lie from it; ``specimen`` draws one.

    Raises UserError for a sample rate that is not positive and finite, and for coefficients outside
    their bounds or that do not go with each other or with the sample rate, as a delay of more
    sample periods than it can remember.
    """

    name: str
    sample_rate: float
    gyro: Sensor = field(default_factory=lambda: Sensor("gyro"))
    accel: Sensor = field(default_factory=lambda: Sensor("accel"))
    estimate: frozenset[tuple[str, str, str]] = frozenset()
    notes: dict[tuple[str, str, str], dict[str, str]] = field(default_factory=dict, compare=False)
    description: str = ""
    tolerances: tuple[Tolerance, ...] = ()
    mag: Sensor = field(default_factory=lambda: Sensor("mag"))

    def __post_init__(self) -> None:
        period = _inverse(self.sample_rate)
        if not 1 / RATES[1] <= period <= 1 / RATES[0]:
            raise UserError(
                f"part {self.name}: the sample rate must be a positive and finite number of Hz, "
                f"from {RATES[0]:g} to {RATES[1]:g}, not {shortened(repr(self.sample_rate))}"
            )
        for sensor in (self.gyro, self.accel, self.mag):
            sensor.check(period, f"part {self.name}")
        for t in self.tolerances:
            t.check(declared(self.sensor(t.key[0]), t.key))
        if len({t.key for t in self.tolerances}) < len(self.tolerances):
            raise UserError(f"part {self.name}: two tolerances of one coefficient")
        in_order = sorted(self.tolerances, key=lambda t: t.place)
        object.__setattr__(self, "tolerances", tuple(in_order))

    __repr__ = show.as_text
    _repr_html_ = show.as_html
    to_frame = show.as_frame
    plot = part_plot.plot

    @property
    def sample_period(self) -> float:
        return 1.0 / self.sample_rate

    def sensor(self, kind: str) -> Sensor:
        return {"gyro": self.gyro, "accel": self.accel, "mag": self.mag}[kind]

    def with_sensor(self, sensor: Sensor) -> Part:
        return replace(self, **{sensor.kind: sensor})

    @property
    def signals(self) -> frozenset[str]:
        """Names in ``SIGNALS`` of what its effects need beside what the sensors measure."""
        return self.gyro.signals | self.accel.signals

    @property
    def start_values(self) -> dict[str, float]:
        """Its coefficients by their names in a unit, as ``pyimu.fmu.simulate`` takes them.

        Those of a specimen make the unit of its part that specimen, without another build.
        """
        return {v.name: v.start for v in self.gyro.variables + self.accel.variables}

    @property
    def nominal(self) -> Part:
        """The specimen without deviations, which measures what the part measures.

        It has every effect of a tolerance, at the identity where the part has none, so that its
        unit has the coefficients as parameters.
        """
        part = self
        for kind, effect, _ in (t.key for t in self.tolerances):
            part = part.with_sensor(part.sensor(kind).with_values(effect))
        return part

    def specimen(self, seed: int) -> Part:
        """One specimen of the part, drawn from its tolerances: a part that has none.

        Each coefficient is what this part declares of it, or the identity, and a deviation that
        follows from ``seed`` and the coefficient's name alone, as ``Tolerance.deviation`` says; the
        same seed gives the same specimen on every platform. Raises UserError for a part without
        tolerances, a seed that is no integer from 0 to 2^64 - 1, and a deviation with which a
        coefficient leaves its bounds.
        """
        seed = seed_of(seed)
        if not self.tolerances:
            raise UserError(
                f"part {self.name} has no tolerances to draw a specimen from; a part file gives "
                "them as tables such as [tolerance.gyro.turn_on_bias]"
            )
        name = f"{self.name}, specimen {seed}"
        notes, sensors = dict(self.notes), {}
        for sensor in (self.gyro, self.accel):
            try:
                sensors[sensor.kind], said = specimen_of(sensor, self.tolerances, seed)
            except UserError as error:
                raise UserError(f"part {name}: {error}") from None
            notes |= said
        return replace(
            self,
            **sensors,
            name=name,
            notes=notes,
            estimate=self.estimate - {t.key for t in self.tolerances},
            description=f"{self.description.rstrip('.') or self.name}, specimen {seed}",
            tolerances=(),
        )

    def simulate(self, recording: Recording, *, seed: int | None = 0) -> Recording:
        """The recording as this part would have measured it.

        See ``pyimu.model.simulate.simulate_recording``.
        """
        return measured_recording(
            self.block, (self.gyro, self.accel), recording, self.sample_period, seed
        )

    @cached_property
    def block(self) -> Block:
        """The part as the block ``ImuSensor``: gyro and accelerometer on the same inputs.

        The temperature goes through, sampled like them, so that the sensor alone feeds a filter.
        """
        return _imu_sensor(self)


def _inverse(rate: float) -> float:
    """1 / rate, NaN where there is none."""
    try:
        return 1.0 / rate
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        return math.nan


TEMPERATURE = Variable(
    "measured_temperature",
    "degC",
    "temperature of the part, sampled like its axes",
    terminal=IMU,
    member="temperature",
)


def input_variables(names: Iterable[str], terminal: str = MOTION) -> tuple[Variable, ...]:
    """Inputs of a block by their names in ``SIGNALS``, members of a ``terminal``.

    Unconnected, they mean a part at rest, level, in its reference state.
    """
    return tuple(
        Variable(
            f"{name}[{i + 1}]" if SIGNALS[name].size > 1 else name,
            SIGNALS[name].unit,
            SIGNALS[name].text,
            start,
            terminal=terminal,
        )
        for name in names
        for i, start in enumerate(SIGNALS[name].start)
    )


def _imu_sensor(part: Part) -> Block:
    sensors = (part.gyro, part.accel)
    names, derived = inputs_for(part.signals), Derived.of(part.signals)
    given, h = {n: ca.SX.sym(n, SIGNALS[n].size) for n in names}, ca.SX.sym("h")
    memory = ca.SX.sym("memory", derived.size)
    remembered, made = derived.advance(memory, given, h)
    u = vector({**given, **made})
    s, p, w = (
        [ca.SX.sym(f"{name}_{sensor.kind}", size(sensor)) for sensor in sensors]
        for name, size in (
            ("s", lambda c: len(c.chain.start)),
            ("p", lambda c: len(c.slots)),
            ("w", lambda c: len(c.noise)),
        )
    )
    results = [sensor.step(s[i], u, p[i], w[i], h) for i, sensor in enumerate(sensors)]
    step = plain_function(
        "step",
        [ca.vertcat(memory, *s), ca.vertcat(*given.values()), ca.vertcat(*p), ca.vertcat(*w), h],
        [
            ca.vertcat(remembered, *[r[0] for r in results]),
            ca.vertcat(*[r[1] for r in results], given["temperature"]),
        ],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
    )
    start = np.concatenate([np.zeros(derived.size), *[sensor.chain.start for sensor in sensors]])
    # Before the first sample: the ideal measurement of the inputs, without the part's errors.
    ideal = ca.vertcat(*[given[sensor.output.own] for sensor in sensors], given["temperature"])
    initial = plain_function(
        "initial",
        [ca.vertcat(*given.values()), ca.vertcat(*p)],
        [ca.SX(ca.DM(start)), ideal],
        ["u", "p"],
        ["s", "y"],
    )
    return Block(
        name="ImuSensor",
        description=_description(part),
        limits=_limits(part),
        step=step,
        initial=initial,
        inputs=input_variables(names),
        parameters=part.gyro.variables + part.accel.variables,
        outputs=tuple(
            Variable(
                f"{c.kind}[{i + 1}]",
                c.output.unit,
                f"measured {c.output.own.replace('_', ' ')}, axis {AXES[i]}",
                terminal=IMU,
            )
            for c in sensors
            for i in range(3)
        )
        + (TEMPERATURE,),
        noise=part.gyro.noise + part.accel.noise,
        sample_period=part.sample_period,
    )


def _description(part: Part) -> str:
    """The part's description, and which effects a step of more than one sample would leave out."""
    text = part.description or f"Inertial measurement unit {part.name}"
    names = sorted({e.name for s in (part.gyro, part.accel) for e in s.effects if e.differences})
    return (
        f"{text.rstrip('.')}. {EVERY_SAMPLE[0].upper()}{EVERY_SAMPLE[1:]}, for {', '.join(names)}"
        if names
        else text
    )


def _limits(part: Part) -> Limits | None:
    """Those of both sensors, on the parameters of the block."""
    h, p = ca.SX.sym("h"), [ca.SX.sym("p", len(s.slots)) for s in (part.gyro, part.accel)]
    found = [
        (s.chain.limits, values)
        for s, values in zip((part.gyro, part.accel), p, strict=True)
        if s.chain.limits
    ]
    if not found:
        return None
    broken = plain_function(
        "limits",
        [ca.vertcat(*p), h],
        [ca.densify(ca.vertcat(*[limits.broken(values, h) for limits, values in found]))],
        ["p", "h"],
        ["broken"],
    )
    return Limits(tuple(text for limits, _ in found for text in limits.texts), broken)
