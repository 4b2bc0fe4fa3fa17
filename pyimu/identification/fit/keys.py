"""What the columns of a regression stand for."""

from __future__ import annotations

from dataclasses import dataclass

from pyimu.model.chain import Slot
from pyimu.model.sensor import Sensor


@dataclass(frozen=True, order=True)
class Coefficient:
    """A coefficient of the sensor's model."""

    effect: str
    parameter: str
    index: tuple[int, ...]


@dataclass(frozen=True)
class LogBias:
    """The bias of one axis at a log's power-on."""

    log: str
    axis: int


@dataclass(frozen=True)
class LogTurn:
    """A small turn of a log's reference against the sensor, about one axis."""

    log: str
    axis: int


@dataclass(frozen=True)
class LogClock:
    """What is left of a log's clock: an offset (``order`` 0) or a drift (1)."""

    log: str
    order: int


@dataclass(frozen=True)
class Scanned:
    """The change that an effect would make with one of the values that are tried of a coefficient,
    ``number`` of them smaller.
    """

    effect: str
    parameter: str
    index: tuple[int, ...]
    number: int
    value: float


@dataclass(frozen=True)
class Shape:
    """A column of a term of a formula, by the term's text and its ``number`` there, as it would add
    to one axis.
    """

    term: str
    number: int
    axis: int


@dataclass(frozen=True)
class LogLag:
    """Seconds by which a log's thermometer is behind the sensor's temperature."""

    log: str


@dataclass(frozen=True)
class LogPlace:
    """What a log's reference force is of: how far along one axis of the body the sensor is from the
    point that is tracked [m]; as the fourth gravity there [m/s^2], as the fifth the heading of the
    positions' world in that of the attitudes [rad], as the sixth by which share the body's way is
    longer than the positions', behind these what is left of a filter that was taken out of these
    [s, s^2].
    """

    log: str
    number: int


LogKey = LogBias | LogTurn | LogClock | LogLag | LogPlace

Key = Coefficient | LogKey | Scanned | Shape


def coefficient_of(slot: Slot) -> Coefficient:
    return Coefficient(slot.effect, slot.parameter, slot.index)


def coefficients_of(sensor: Sensor, effect: str) -> frozenset[Coefficient]:
    """All coefficients of an effect that can be estimated, whether the sensor has it or not."""
    one = Sensor(sensor.kind, {effect: {}})
    return frozenset(coefficient_of(s) for s in one.slots if not s.definition.reference)
