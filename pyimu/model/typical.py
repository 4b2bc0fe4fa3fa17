"""The typical size of each effect in a tactical and in a consumer MEMS part.

The figures and their sources are in ``pyimu/model/typical.toml``.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any

from pyimu import units
from pyimu.errors import UserError

CLASSES = ("tactical", "consumer")
"""The classes of parts, the better one first."""

NO_SOURCE = "no source"
"""How the source of an engineering guess begins; one phrase of reasoning follows."""


@dataclass(frozen=True)
class Magnitude:
    """A realistic size of one coefficient: ``value`` in ``unit``, and the document that it is from.

    ``beside`` holds other coefficients of the effect that the figure goes with, each a value and
    its unit.
    """

    parameter: str
    value: float
    unit: str
    source: str
    beside: Mapping[str, tuple[float, str]] = field(default_factory=dict)

    @property
    def si(self) -> float:
        """The value in the SI unit of the parameter."""
        return _si(self.value, self.unit)

    @property
    def beside_si(self) -> dict[str, float]:
        """The other coefficients in SI units."""
        return {name: _si(*figure) for name, figure in self.beside.items()}

    @property
    def sourced(self) -> bool:
        """False for an engineering guess."""
        return not self.source.startswith(NO_SOURCE)


def magnitudes(effect: str, kind: str) -> dict[str, Magnitude]:
    """The size of an effect in a sensor of this kind, by class of part.

    Raises UserError where there is none.
    """
    table = _table()
    if (effect, kind) not in table:
        names = sorted({name for name, k in table if k == kind})
        raise UserError(
            f"typical.toml: no effect {effect} of a sensor "
            f"{kind}{units.did_you_mean(effect, names)}"
        )
    return dict(table[effect, kind])


def largest(effect: str, kind: str) -> float:
    """The largest size in SI units that a data sheet allows a part, 0 where none allows more than
    ten times what is typical of a consumer part.
    """
    figure = _file().get(effect, {}).get(kind, {}).get("largest")
    return 0.0 if figure is None else _si(float(figure["value"]), figure["unit"])


def documents() -> Mapping[str, str]:
    """The documents by the key with which a source begins."""
    return _file()["documents"]


def _si(value: float, unit: str) -> float:
    return value * units.parse(unit).factor


@lru_cache(maxsize=1)
def _file() -> Mapping[str, Any]:
    text = files("pyimu.model").joinpath("typical.toml").read_text(encoding="utf-8")
    return MappingProxyType(tomllib.loads(text))


@lru_cache(maxsize=1)
def _table() -> Mapping[tuple[str, str], Mapping[str, Magnitude]]:
    """Magnitudes by (effect, kind), then by class."""
    return MappingProxyType(
        {
            (effect, kind): {c: _magnitude(entry, c) for c in CLASSES}
            for effect, kinds in _file().items()
            if effect != "documents"
            for kind, entry in kinds.items()
        }
    )


def _magnitude(entry: Mapping[str, Any], c: str) -> Magnitude:
    beside = MappingProxyType(
        {name: (float(value), unit) for name, (value, unit) in entry.get("beside", {}).items()}
    )
    figure = entry[c]
    return Magnitude(
        entry["parameter"], float(figure["value"]), figure["unit"], figure["source"], beside
    )
