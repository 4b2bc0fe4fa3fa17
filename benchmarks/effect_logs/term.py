"""What an effect is made of."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from effect_logs.scene import Scene

Form = dict[str, Any]
"""What belongs to an effect beside its size: instants, frequencies, widths."""

ROTATING = ("table", "tumble", "rover")
SHAKEN = ("tumble", "rover", "shaker")
BOTH = ("gyro", "accel")


@dataclass(frozen=True)
class Case:
    """What an effect acts on: the sensor's kind, what surrounds it, and the effect's coefficient.

    ``c`` is an array of the term's shape, or a number; ``form`` as the term drew it; ``rng`` gives
    the same draws whatever the size.
    """

    kind: str
    scene: Scene
    c: Any
    form: Form
    seed: int

    @property
    def rng(self) -> np.random.Generator:
        return np.random.default_rng([self.seed, 7])


@dataclass(frozen=True)
class Term:
    """One effect: ``apply(x, case)`` gives its output (n, 3) for an input (n, 3).

    ``sizes`` are coefficients typical of consumer parts, by kind. ``shape`` is the coefficient's,
    () for a number; it has a sign where ``signed``. ``known`` says that only size 1 is possible.
    ``needs`` are the groups of a recording that tell of it, beside motion and temperature.
    ``answer`` is the catalogue's name of it, empty where it has none, ``parameter`` the name of its
    coefficient there, in which it is ``told(c)``. ``gain`` is the size in sigmas of an effect that
    is random: ``gain(case, triad, free)``. ``slow`` says that it changes over minutes, ``by_size``
    that a size in sigmas says how well it is seen. ``hollow`` coefficients have no diagonal.
    ``forms`` are those in which the part lacks it.
    """

    name: str
    apply: Callable[[np.ndarray, Case], np.ndarray]
    sizes: Mapping[str, float]
    shape: tuple[int, ...] = (3,)
    signed: bool = True
    hollow: bool = False
    known: bool = False
    needs: tuple[str, ...] = ()
    motions: tuple[str, ...] = ROTATING
    form: Callable[[np.random.Generator, Scene], Form] = lambda rng, scene: {}
    answer: str | None = None
    parameter: str = ""
    told: Callable[[Any], Any] = lambda c: c
    gain: Callable[..., float] | None = None
    slow: bool = False
    by_size: bool = True
    forms: tuple[str, ...] = ("declared", "undeclared")

    @property
    def right(self) -> str:
        """The catalogue's name of it."""
        return self.name if self.answer is None else self.answer

    def direction(self, rng) -> Any:
        """A coefficient of about unit size on some of the axes: each with probability 0.6."""
        if self.known or not self.shape:
            return 1.0
        full = rng.uniform(0.5, 1.5, self.shape)
        full *= rng.choice([-1, 1], self.shape) if self.signed else 1
        allowed = 1 - np.eye(3) if self.hollow else np.ones(self.shape)
        kept = (rng.random(self.shape) < 0.6) * allowed
        while not kept.any():
            kept = (rng.random(self.shape) < 0.6) * allowed
        return full * kept
