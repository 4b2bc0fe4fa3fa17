"""A short ``repr`` for values that hold arrays: one line, of arrays the shape."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

LONGEST = 60
"""Characters of a text that is shown whole."""

FEW = 3
"""Numbers of an array that are shown, and entries of a sequence that are named."""


class Brief:
    """A dataclass (``repr=False``) that shows its fields in short, those that are not empty."""

    def __repr__(self) -> str:
        own = fields(self)  # type: ignore[arg-type]
        told = ((f.name, getattr(self, f.name)) for f in own if f.repr)
        shown = (f"{name}={in_short(value)}" for name, value in told if not _empty(value))
        return f"{type(self).__name__}({', '.join(shown)})"


def in_short(value: Any) -> str:
    """A value in a few words: numbers to four digits, of what is long how much there is."""
    if isinstance(value, np.ndarray):
        if value.size > FEW:
            return f"array {value.shape}"
        return in_short(value.tolist())
    if isinstance(value, (float, np.floating)):
        return f"{value:.4g}"
    if isinstance(value, np.generic):
        return in_short(value.item())
    if isinstance(value, str):
        return repr(value if len(value) <= LONGEST else value[: LONGEST - 3] + "...")
    if isinstance(value, Mapping):
        return f"{{{_named(map(str, value), len(value))}}}"
    if isinstance(value, (tuple, list)):
        left, right = "()" if isinstance(value, tuple) else "[]"
        return f"{left}{_named(map(in_short, value), len(value))}{right}"
    if is_dataclass(value) or callable(value):
        return getattr(value, "__name__", type(value).__name__)
    return repr(value)


def _named(entries: Any, count: int) -> str:
    """The first entries, and how many more there are."""
    shown = [text for text, _ in zip(entries, range(FEW))]
    return ", ".join([*shown, *([f"{count - FEW} more"] if count > FEW else [])])


def _empty(value: Any) -> bool:
    return value is None or (isinstance(value, (str, tuple, list, Mapping)) and not value)
