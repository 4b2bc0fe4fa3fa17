"""Numbers that are kept from sample to sample, as the part of a state that they are."""

from __future__ import annotations

from typing import ClassVar, Self

import casadi as ca


class Kept:
    """What a dataclass of columns has that is kept: ``SIZES`` are those of its fields."""

    SIZES: ClassVar[tuple[int, ...]]

    @classmethod
    def size(cls) -> int:
        return sum(cls.SIZES)

    @classmethod
    def unpack(cls, column) -> Self:
        ends = [sum(cls.SIZES[:i]) for i in range(len(cls.SIZES) + 1)]
        return cls(*ca.vertsplit(column, ends))

    def pack(self) -> ca.SX:
        return ca.densify(ca.vertcat(*vars(self).values()))
