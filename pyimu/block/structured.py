"""Equations that are made once for all whose numbers alone differ, where these are parameters."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Structured(Generic[T]):
    """What a step is made ``of``, as the argument of a cached function: equal to another one of the
    same ``structure``, which is all that the equations depend on.
    """

    structure: tuple
    of: T = field(compare=False)
