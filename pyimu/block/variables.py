"""The named scalars of a block, its noise channels, and what its parameters must keep."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, Literal

import casadi as ca
import numpy as np

from pyimu.errors import UserError

Kind = Literal["real", "boolean", "integer"]

MOTION, IMU = "motion", "imu"
"""Terminals of the units, which can be wired as a whole: the truth in which a sensor moves, and
what it measures."""


@dataclass(frozen=True)
class Variable:
    """One scalar of a block.

    ``name`` is its FMI name (``gyro_error.g_sensitivity.G[1,2]``), ``unit`` an SI spelling. A
    parameter that acts on the start alone is ``fixed``, and cannot be set during a run.

    Inputs or outputs of one ``terminal`` are the members of a bus that a tool can wire at once;
    ``member`` is the name there, if it is not the variable's own. ``said`` tells what
    people say otherwise than others in its unit, as ``Parameter`` has it.
    """

    name: str
    unit: str = "1"
    description: str = ""
    start: float = 0.0
    kind: Kind = "real"
    minimum: float | None = None
    maximum: float | None = None
    fixed: bool = False
    terminal: str = ""
    member: str = ""
    said: str = ""


def array(
    name: str, unit: str, text: str, start: Iterable[float] = (0.0, 0.0, 0.0), **more: Any
) -> tuple[Variable, ...]:
    """The scalars of a vector, numbered from one; ``more`` is of ``Variable``."""
    return tuple(
        Variable(f"{name}[{i + 1}]", unit, text, float(v), **more) for i, v in enumerate(start)
    )


def in_terminal(terminal: str, *variables: Variable, prefix: str = "") -> tuple[Variable, ...]:
    """The same as members of one terminal, there without the ``prefix`` of their names."""
    return tuple(
        replace(v, terminal=terminal, member=v.member or v.name.removeprefix(prefix))
        for v in variables
    )


@dataclass(frozen=True)
class NoiseChannel:
    """One standard normal input; ``number`` names its stream, whatever else the block holds."""

    name: str
    number: int


@dataclass(frozen=True)
class Limits:
    """Conditions that parameters must keep together, and with the sample period.

    ``broken(p, h)`` (n,) is not 0 where they break ``texts[i]``.

    What one parameter must keep by itself are the bounds of its ``Variable``.
    """

    texts: tuple[str, ...]
    broken: ca.Function

    def check(self, p: np.ndarray, h: float, name: str) -> None:
        """Raise UserError, which starts with ``name``, for the first limit that is broken."""
        for text, broken in zip(self.texts, np.array(self.broken(p, h)).ravel(), strict=True):
            if broken:
                raise UserError(f"{name}: {text}")


def sample_period_of(seconds: float, what: str) -> float:
    """A sample period [s] as a float.

    Raises UserError, which starts with ``what``, for one that is not a positive, finite number.
    """
    try:
        h = float(seconds)
    except (TypeError, ValueError):
        h = math.nan
    if not (h > 0.0 and math.isfinite(h)):
        raise UserError(
            f"{what}: the sample period must be a positive and finite number of seconds, not "
            f"{seconds!r}"
        )
    return h


def seed_of(seed: int, bits: int = 64) -> int:
    """A seed as an int. Raises UserError for one that is no integer from 0 to 2^bits - 1."""
    if (
        isinstance(seed, bool)
        or not isinstance(seed, (int, np.integer))
        or not 0 <= int(seed) < 2**bits
    ):
        raise UserError(f"seed {seed!r} is not an integer in 0 to 2^{bits} - 1")
    return int(seed)
