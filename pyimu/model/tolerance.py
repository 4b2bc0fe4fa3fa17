"""How far the specimens of a part lie from it, and the drawing of one.

A tolerance is no coefficient: it says of one how far a specimen may lie from what the part declares
of it, or from the identity where the part declares nothing. Nothing that knows a part, as the
attitude filter or ``close``, knows more of a specimen by it.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from pyimu.display.brief import Brief
from pyimu.errors import UserError
from pyimu.model.arguments import Parameter
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.kinds import KINDS
from pyimu.model.part_entry import FigureScale, Key, nested
from pyimu.model.part_value import EXACT, PartValue, with_values
from pyimu.model.sensor import Sensor
from pyimu.units import did_you_mean

DISTRIBUTIONS = {
    "uniform": "anywhere within +-value",
    "normal": "value is one standard deviation",
}
"""How specimens lie about the part: name, and what the value beside it means."""

STREAMS = 2**32
"""The first stream of random numbers that is a tolerance's; those of the noise lie below it."""


@dataclass(frozen=True, repr=False)
class Tolerance(Brief):
    """How far specimens lie from the part in one coefficient.

    ``key`` names it (sensor, effect, parameter); ``sizes`` holds the value in SI of every free
    element, row by row, whose meaning is that of ``distribution``. ``unit``, ``source`` and
    ``quoted`` are what stands beside it in the file. Raises UserError for an effect, a parameter or
    a distribution that does not exist, and for sizes that are not one for each element, finite and
    not negative.
    """

    key: Key
    sizes: tuple[float, ...]
    distribution: str
    unit: str = field(default="", compare=False)
    source: str = field(default="", compare=False)
    quoted: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        kind, effect, name = self.key
        known = CATALOGUE.of(kind, effect).parameters
        where = f"tolerance.{'.'.join(self.key)}"
        if name not in known:
            raise UserError(f"{where}: no parameter of {effect}{did_you_mean(name, known)}")
        if self.distribution not in DISTRIBUTIONS:
            raise UserError(
                f"{where}: unknown distribution {self.distribution!r}; known are "
                f"{', '.join(DISTRIBUTIONS)}"
            )
        free = len(known[name].indices)
        if len(self.sizes) != free or not all(0.0 <= v < math.inf for v in self.sizes):
            raise UserError(f"{where}: needs {free} finite sizes from 0 on, not {self.sizes}")

    @property
    def parameter(self) -> Parameter:
        return CATALOGUE[self.key[1]].parameters[self.key[2]]

    @property
    def si(self) -> str:
        """The coefficient's SI unit."""
        return Sensor(self.key[0]).unit(self.parameter.unit)

    @property
    def place(self) -> tuple[int, int, int]:
        """Where it stands among others: by sensor, effect and parameter as they are defined."""
        kind, effect, parameter = self.key
        places = (list(KINDS), list(CATALOGUE), list(CATALOGUE[effect].parameters))
        return (places[0].index(kind), places[1].index(effect), places[2].index(parameter))

    @property
    def array(self) -> np.ndarray:
        """The sizes in the parameter's shape, 0 on a diagonal that it does not have."""
        return _placed(self.parameter, self.sizes)

    @property
    def std(self) -> np.ndarray:
        """Standard deviation among specimens, in the parameter's shape."""
        return self.array / (math.sqrt(3.0) if self.distribution == "uniform" else 1.0)

    def check(self, declared: np.ndarray) -> None:
        """Raise UserError where specimens can lie outside the coefficient's bounds.

        A normal distribution has no ends; what it draws is checked when it is drawn.
        """
        if self.distribution == "uniform":
            for end in (declared - self.array, declared + self.array):
                fault = self.parameter.fault(end)
                if fault:
                    raise UserError(f"tolerance.{'.'.join(self.key)}: the coefficient {fault}")

    def deviation(self, seed: int) -> np.ndarray:
        """What specimen ``seed`` deviates by, in SI, in the parameter's shape.

        Each element is drawn by itself, of a stream of its own, so it depends on nothing but the
        seed, the element's name as in a unit (``gyro_error.scale_factor.s[1]``) and its size. The
        stream is that of ``pyimu.block.normals`` with the name's CRC-32 plus 2^32 for its channel:
        the words of Philox4x64-10 with key (seed, channel), the same on every platform, and no
        noise's.

        That holds for the elements of a matrix too. Of cross-axis sensitivity a data sheet prints
        one figure, which bounds what any axis sees of any other: each off-diagonal element of the
        misalignment is such a sensitivity, and nothing is said of one by another. Then half of the
        variance is a turn of the whole triad (m_ij = -m_ji) and half is non-orthogonality
        (m_ij = m_ji), as a die that lies askew in its package and elements that lie askew on the
        die would give alike. A g-sensitivity without axes is drawn so, too: nine elements.
        """
        kind, effect, name = self.key
        q = self.parameter
        drawn = [
            size * _DRAW[self.distribution](seed, _stream(f"{kind}_error.{effect}.{name}", i))
            for size, i in zip(self.sizes, q.indices, strict=True)
        ]
        return _placed(q, drawn)

    def size(self, digits: int = 12) -> str:
        """The size as a data sheet would print it, as "+-20 deg/s" or "1 sigma 0.1 deg/s/g"."""
        unit = self.unit or self.si
        figures = FigureScale(unit, self.si).guess(np.array(self.sizes))
        texts = [f"{v:.{digits}g}" for v in figures]
        text = texts[0] if len(set(texts)) == 1 else nested(texts, figures.shape)
        sign = "+-" if self.distribution == "uniform" else "1 sigma "
        return f"{sign}{text}" + ("" if unit == "1" else f" {unit}")


def specimen_of(
    sensor: Sensor, tolerances: Iterable[Tolerance], seed: int
) -> tuple[Sensor, dict[Key, dict[str, str]]]:
    """The sensor with what specimen ``seed`` has of each tolerance, and notes that say so.

    What is drawn is rounded to ten digits in the unit of its tolerance.
    """
    drawn = []
    for t in tolerances:
        kind, effect, parameter = t.key
        if kind == sensor.kind:
            value = declared(sensor, t.key) + t.deviation(seed)
            source = f"drawn, specimen {seed}, of {t.size()} ({t.distribution})"
            source += f", {t.source}" if t.source else ""
            drawn.append(PartValue(effect, parameter, value, t.unit or t.si, source, EXACT))
    return with_values(sensor, drawn)


def declared(sensor: Sensor, key: Key) -> np.ndarray:
    """What a sensor declares of a coefficient, the identity where it has no such effect."""
    _, effect, parameter = key
    values: Mapping[str, np.ndarray] = sensor.values.get(effect, CATALOGUE[effect].start())
    return values[parameter]


def _placed(q: Parameter, elements: Iterable[float]) -> np.ndarray:
    out = np.zeros(q.shape)
    for index, element in zip(q.indices, elements, strict=True):
        out[index] = element
    return out


def _stream(name: str, index: tuple[int, ...]) -> int:
    suffix = f"[{','.join(str(i + 1) for i in index)}]" if index else ""
    return STREAMS + zlib.crc32(f"{name}{suffix}".encode())


def _uniform(seed: int, stream: int) -> float:
    """The middle of one of 2^52 equal cells of (-1, 1), by the first word of the stream."""
    word = int(np.random.Philox(key=np.array([seed, stream], dtype=np.uint64)).random_raw())
    return 2.0 * ((word >> 12) + 0.5) * 2.0**-52 - 1.0


def _normal(seed: int, stream: int) -> float:
    from pyimu.block.normals import normals  # loads numba, and few specimens are drawn

    return float(normals(seed, [stream], 0, 1)[0, 0])


_DRAW = {"uniform": _uniform, "normal": _normal}
