"""Samples in JSON of which each says whose it is: ``{"sensor": "Gyroscope", "x": 0.1}``, as Sensor
Logger exports them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pyimu.recording.formats.by_word import sensors_among
from pyimu.recording.naming.name import named

MOST = 64
"""Different sensors, at most."""


@dataclass(frozen=True)
class OfKind:
    """The samples of the sensor ``word``, beside which there are ``words``."""

    word: str
    words: tuple[str, ...]
    rows: list[dict[str, Any]]


def of_kind(rows: Sequence[Mapping[str, Any]], topic: str = "") -> OfKind | None:
    """The samples of the ``topic``, of the gyro where none is named; None where no member tells
    whose they are, or none is of the topic.
    """
    for key in _keys(rows):
        words = sensors_among(dict.fromkeys(row[key] for row in rows))
        if len(words) > 1 and (not topic or topic in words):
            own = topic or words[0]
            others = tuple(word for word in words if word != own)
            return OfKind(own, others, [dict(row) for row in rows if row[key] == own])
    return None


def _keys(rows: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """The members that are a text in each sample, of few different ones."""
    for key in rows[0] if rows else ():
        values = {v if isinstance(v := row.get(key), str) else None for row in rows}
        if None not in values and 1 < len(values) <= MOST:
            yield key


def called(word: str, name: str) -> str:
    """The name of a member of a sensor's sample, with the sensor's where it is an axis."""
    return f"{word} {name}" if word and named(name).axis else name
