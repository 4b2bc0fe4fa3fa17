"""Annotations for the arguments of an effect's function.

Coefficients, states, noise, signals, and the sample period.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

INPUT = "input"
"""Start of a state that begins as if the first input had always been there."""

AXES = "xyz"


@dataclass(frozen=True)
class Scan:
    """Where identification starts its search for a coefficient that it cannot follow a slope to.

    Of one without slope at the identity it tries a logarithmic grid of ``points`` values: ``low``
    and ``high`` count sample periods ("period"), radians a sample ("rate") or shares of the largest
    input, of which a limit does most where it is small ("range") and a dead zone where it is large
    ("zone").

    One that is a ``form`` is tried with sizes that are linear beside it: a time constant of
    ``low`` s to ``high`` times the log's length ("span"), shares of the range of the signal that
    drives the effect ("swing"), instants ``low`` s apart ("instant"), frequencies of at least
    ``low`` cycles a log ("line") with the angle at power-on ("phase").
    """

    measure: str
    low: float = 0.0
    high: float = 1.0
    points: int = 8

    def values(self, period: float, largest: float) -> np.ndarray:
        """The grid for a log of this sample period [s] and largest input."""
        sizes = {"period": period, "rate": 1.0 / period, "range": largest, "zone": largest}
        unit = sizes[self.measure]
        return unit * np.geomspace(self.low, self.high, self.points)

    def forms(self, length: float, swing: float) -> np.ndarray:
        """The values of a form to try in a log of this length [s] whose driving signal has this
        range.
        """
        if self.measure == "instant":
            return np.arange(self.low, length, self.low)
        low, high = (
            (self.low, self.high * length)
            if self.measure == "span"
            else (self.low * swing, self.high * swing)
        )
        return np.geomspace(low, high, self.points) if 0.0 < low < high else np.zeros(0)


@dataclass(frozen=True)
class Parameter:
    """A coefficient of an effect, and what is known of it beforehand.

    At ``start`` the effect is the identity; matrices may leave out their diagonal.

    ``reference`` marks a coefficient that only fixes an origin (a reference temperature): it is
    never estimated. ``form`` marks one that shapes an effect whose size others give (a time
    constant, an instant): it acts only where they do. ``known`` is the one value, beside zero,
    that it can have. ``scan`` says where identification starts its search where it has no
    slope to follow. ``reads`` marks one that is read off the raw samples: the level at which they
    stop ("ceiling"), the one below which they are zero ("threshold"), or the step on whose
    multiples they lie ("step"). ``density`` marks the root of a density, a white noise's or that of
    a walk's steps, which a data sheet may print one-sided. ``said`` tells what is said otherwise
    than others in its unit: a "frequency" in Hz, a "ratio" as a plain number. ``columns`` names the
    columns of a matrix where these are no axes.
    """

    unit: str
    shape: tuple[int, ...] = (3,)
    start: float = 0.0
    description: str = ""
    diagonal: bool = True
    reference: bool = False
    form: bool = False
    known: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    scan: Scan | None = None
    reads: Literal["", "ceiling", "threshold", "step"] = ""
    density: bool = False
    said: Literal["", "frequency", "ratio"] = ""
    columns: tuple[str, ...] = ()

    @property
    def sought(self) -> bool:
        """Whether it must be scanned for because the identity has no slope against it."""
        return self.scan is not None and not self.form

    @cached_property
    def indices(self) -> tuple[tuple[int, ...], ...]:
        """Index of every free element, row by row."""
        return tuple(i for i in np.ndindex(*self.shape) if self.diagonal or i[0] != i[1])

    def place(self, index: tuple[int, ...]) -> str:
        """Where an element stands, as "x" or "x from yz"; nothing where there is but one."""
        if len(index) == 1 and self.shape != (3,):
            return str(index[0] + 1)
        labels: list[Sequence[str]] = [AXES, self.columns or AXES]
        return " from ".join(labels[k][i] for k, i in enumerate(index))

    def fault(self, values: np.ndarray) -> str:
        """Why ``values`` are not allowed, as "must not be below 0"; empty where they are.

        The values have the parameter's shape and are in its SI unit.
        """
        if not np.all(np.isfinite(values)):
            return "must be finite"
        if self.minimum is not None and np.any(values < self.minimum):
            return f"must not be below {self.minimum:g}"
        if self.maximum is not None and np.any(values > self.maximum):
            return f"must not be above {self.maximum:g}"
        return (
            "must have zeros on its diagonal"
            if not self.diagonal and np.any(np.diag(values))
            else ""
        )


@dataclass(frozen=True)
class State:
    """Memory of an effect.

    ``start`` is a number, ``INPUT`` for the steady state at the first input of the effect, or the
    name of one of the effect's environment arguments for that signal's first value.
    """

    unit: str
    shape: tuple[int, ...] = (3,)
    start: float | str = 0.0


@dataclass(frozen=True)
class Noise:
    """Independent standard normals, one draw a sample."""

    size: int = 3


@dataclass(frozen=True)
class Environment:
    """A signal beside the effect's own input, by its name in ``SIGNALS``, or ``OWN_RATE``.

    The signal that the sensor itself measures means the effect's own input: a sensor knows it
    through nothing else.
    """

    signal: str


@dataclass(frozen=True)
class SamplePeriod:
    """The sample period in seconds."""
