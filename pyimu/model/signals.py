"""The signals that an effect may depend on: the inputs of every sensor, and what follows from their
course in time.

A sensor's chain takes all of them as one vector ``u``, in the order of ``SIGNALS``; ``COLUMNS``
says where each stands. Derived signals are not inputs of a simulation: ``derive`` makes them,
sample by sample, from the inputs and a little memory.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import casadi as ca
import numpy as np

from pyimu.recording.columns import GROUPS, ZERO
from pyimu.symbolic import earth, quaternion
from pyimu.symbolic.missing import is_number, kept

VIBRATION_TIME = 1.0
"""s; time constant of the mean that parts vibration from motion, and of the mean square of what is
left."""

LONGEST_HOLD = 60.0
"""s; a slow signal that has rested for longer changes as if it had rested so long: read less than
once a minute a thermometer misses the changes for which data sheets state a sensitivity (some
K/min), and a step after a night's rest is no slope of a night."""

EVERY_SAMPLE = "wants new inputs at every sample"
"""What is said of an effect that follows from the difference of successive inputs, wherever it is
described."""


@dataclass(frozen=True)
class Signal:
    """One signal: its unit, its value where nobody sets it, and for a derived one the inputs ``of``
    which it follows.

    ``memory`` counts the numbers kept from sample to sample;
    ``advance(memory, started, h, *inputs)`` gives the value and the memory that follows,
    ``started`` being false at the first sample. ``difference`` says that the value is the
    difference of two successive inputs: it is zero at a sample whose inputs are held from the one
    before. An input is a ``group`` of a recording's columns.
    """

    unit: str
    start: tuple[float, ...]
    text: str
    of: tuple[str, ...] = ()
    memory: int = 0
    advance: Callable | None = None
    difference: bool = False
    group: str = ""
    surrounding: bool = False

    @property
    def size(self) -> int:
        return len(self.start)

    @property
    def derived(self) -> bool:
        return self.advance is not None


def _count(count, started, h):
    """The first sample is one period after power-on: sample k belongs to time k h."""
    return (count + 1) * h, count + 1


def _difference(before, started, h, now):
    """NaN at a sample that is NaN and at the one after it: neither has a difference."""
    return (now - ca.if_else(started, before, now)) / h, now


def _slow_difference(memory, started, h, now):
    """Slope of a signal that may be refreshed less often than there are samples: between its last
    two different values.

    A change after n samples of rest is a slope over n sample periods (at most ``LONGEST_HOLD``),
    which is held for the n samples until the next change is due and released then: its integral is
    the change, late by the n samples. With a new value at every sample it is the plain
    difference. NaN at a sample that is NaN, which counts as one of rest.
    """
    before, rested, slope, left = ca.vertsplit(memory)
    begun = ca.logic_and(started, is_number(before))
    before, since = ca.if_else(begun, before, now), rested + 1
    changed = ca.logic_and(is_number(now), now != before)
    n = ca.fmin(since, ca.fmax(1, ca.floor(LONGEST_HOLD / h)))
    slope = ca.if_else(changed, (now - before) / (n * h), ca.if_else(left > 0, slope, 0))
    following = (
        ca.if_else(changed, now, before),
        ca.if_else(ca.logic_or(changed, ca.logic_not(begun)), 0, since),
        slope,
        ca.fmax(ca.if_else(changed, n, left) - 1, 0),
    )
    return ca.if_else(is_number(now), slope, now), ca.vertcat(*following)


def _mean_square(memory, started, h, now):
    """Mean square of what is faster than ``VIBRATION_TIME``, by two exponential means, which leave
    out a sample that is NaN.
    """
    n, gain = now.numel(), 1 - ca.exp(-h / VIBRATION_TIME)
    begun = ca.logic_and(started, is_number(memory[:n]))
    before = ca.vertcat(ca.if_else(begun, memory[:n], now), memory[n:])
    mean = before[:n] + gain * (now - before[:n])
    square = before[n:] + gain * ((now - mean) ** 2 - before[n:])
    return square, kept(ca.vertcat(mean, square), before)


def _to_body(attitude, v):
    """A world vector in body axes; an attitude from outside need not be of unit norm to the last
    bit.
    """
    return quaternion.rotate(quaternion.conjugate(quaternion.normalized(attitude)), v)


def _integral(memory, started, h, now):
    """A sample that is NaN adds nothing."""
    total = kept(memory + h * now, memory)
    return total, total


def _earth(memory, started, h, attitude, latitude):
    return _to_body(attitude, earth.earth_rate(latitude)), memory


def _transport(memory, started, h, attitude, latitude, velocity):
    return _to_body(attitude, earth.transport_rate(latitude, velocity)), memory


_INPUTS = {
    g.signal: Signal(g.unit, g.start, g.text, group=name, surrounding=g.surrounding)
    for name, g in GROUPS.items()
    if g.signal
}

_DERIVED = {
    "time": Signal("s", (0.0,), "time since power-on", (), 1, _count),
    "temperature_rate": Signal(
        "K/s", (0.0,), "rate of the temperature", ("temperature",), 4, _slow_difference
    ),
    "angular_acceleration": Signal(
        "rad/s^2", ZERO, "rate of the angular rate, body axes", ("rate",), 3, _difference, True
    ),
    "jerk": Signal(
        "m/s^3",
        ZERO,
        "rate of the specific force, body axes",
        ("specific_force",),
        3,
        _difference,
        True,
    ),
    "vibration": Signal(
        "(m/s^2)^2",
        ZERO,
        "mean square of the specific force's vibration, body axes",
        ("specific_force",),
        6,
        _mean_square,
    ),
    "earth_rate": Signal(
        "rad/s", ZERO, "the Earth's rotation, body axes", ("attitude", "latitude"), 0, _earth
    ),
    "transport_rate": Signal(
        "rad/s",
        ZERO,
        "rotation of east-north-up along the way over the Earth, body axes",
        ("attitude", "latitude", "velocity"),
        0,
        _transport,
    ),
    "turned": Signal(
        "rad",
        ZERO,
        "angle turned about each body axis since power-on",
        ("rate",),
        3,
        _integral,
    ),
}

SIGNALS: Mapping[str, Signal] = MappingProxyType(_INPUTS | _DERIVED)
"""Every signal, in the order in which they stand in the vector ``u``."""

ALWAYS = ("rate", "specific_force", "temperature")
"""Inputs that every simulated part has, whether its effects need them or not."""


def _columns() -> dict[str, slice]:
    ends = np.cumsum([s.size for s in SIGNALS.values()]).tolist()
    return {
        name: slice(end - s.size, end) for (name, s), end in zip(SIGNALS.items(), ends, strict=True)
    }


COLUMNS: Mapping[str, slice] = MappingProxyType(_columns())
"""Where each signal stands in ``u``."""

N_INPUT = sum(s.size for s in SIGNALS.values())

START = np.concatenate([s.start for s in SIGNALS.values()])
"""``u`` (N_INPUT,) at rest and level, at the reference temperature and supply."""


def inputs_for(needed: Iterable[str]) -> tuple[str, ...]:
    """The inputs from which ``needed`` signals follow, and those that are always there, in the
    order of ``SIGNALS``.
    """
    wanted = {*ALWAYS, *inputs_of(needed)}
    return tuple(n for n, s in SIGNALS.items() if n in wanted)


def inputs_of(needed: Iterable[str]) -> set[str]:
    """The inputs from which ``needed`` signals follow."""
    return set().union(*(SIGNALS[n].of if SIGNALS[n].derived else (n,) for n in needed))


def vector(given: Mapping[str, ca.SX]) -> ca.SX:
    """The vector ``u`` of a sensor; a signal that is not given stands at its start value."""
    return ca.vertcat(*[given.get(n, ca.DM(s.start)) for n, s in SIGNALS.items()])


@dataclass(frozen=True)
class Derived:
    """Memory that a set of derived signals needs, and their values:
    ``advance(state, inputs, h) -> (following, values)``.
    """

    names: tuple[str, ...]

    @classmethod
    def of(cls, needed: Iterable[str]) -> Derived:
        wanted = set(needed)
        return cls(tuple(n for n, s in SIGNALS.items() if s.derived and n in wanted))

    @property
    def size(self) -> int:
        """Numbers of state: a mark that the first sample has been, and each signal's memory."""
        return 1 + sum(SIGNALS[n].memory for n in self.names) if self.names else 0

    def advance(
        self, state: ca.SX, inputs: Mapping[str, ca.SX], h: ca.SX
    ) -> tuple[ca.SX, dict[str, ca.SX]]:
        if not self.names:
            return state, {}
        following, values, at = [ca.SX(1)], {}, 1
        for name in self.names:
            signal = SIGNALS[name]
            value, after = signal.advance(
                state[at : at + signal.memory, 0], state[0], h, *(inputs[n] for n in signal.of)
            )
            values[name] = value
            following.append(after)
            at += signal.memory
        return ca.vertcat(*following), values


SURROUNDINGS = tuple(n for n, s in SIGNALS.items() if s.surrounding)
"""Inputs that are neither motion nor place: temperature, supply, magnetic field."""
