"""A file that has its specific force in two parts: gravity, and the acceleration without it.

Apple's Core Motion splits an accelerometer's reading so (CMDeviceMotion: ``gravity`` and
``userAcceleration``, in g). Their sum is what the accelerometer read, whose sign is the other one
than that of a specific force: a phone that lies on its back reads -1 g on z.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.columns import XYZ
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver

FORCE = tuple(f"force of gravity and user acceleration {a}" for a in XYZ)
"""Names of the columns that are made, in g."""


@dataclass(frozen=True)
class WholeForceReader(ReaderOver):
    """What ``reader`` reads, and behind it ``FORCE``: the sum of its columns at ``gravity`` and
    ``user``, x first, with the other sign.
    """

    reader: Reader
    gravity: tuple[int, int, int]
    user: tuple[int, int, int]

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return [*self.reader.header, *FORCE]

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        first, other = (self.reader.header[at[0]] for at in (self.gravity, self.user))
        said = f"the force is that of {first} and {other} together, with the other sign"
        return (*self.reader.findings, Finding("layout", "accel", 1, {"read_as": said}))

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        width = len(self.reader.header)
        theirs = [p for p in positions if p < width]
        made = [p - width for p in positions if p >= width]
        theirs += [k for at in (self.gravity, self.user) for k in (at[axis] for axis in made)]
        asked = list(dict.fromkeys(theirs))
        for columns, share in self.reader.batches(asked, long if long in asked else asked[0]):
            of = dict(zip(asked, columns, strict=True))
            yield [of[p] if p < width else self._force(of, p - width) for p in positions], share

    def _force(self, of: dict[int, np.ndarray], axis: int) -> np.ndarray:
        return -(of[self.gravity[axis]].astype(float) + of[self.user[axis]].astype(float))

    def count(self, long: int) -> int | None:
        return self.reader.count(min(long, len(self.reader.header) - 1))

    def numeric(self) -> list[int]:
        width, theirs = len(self.reader.header), self.reader.numeric()
        pairs = enumerate(zip(self.gravity, self.user, strict=True))
        return [*theirs, *(width + k for k, pair in pairs if set(pair) <= set(theirs))]
