"""Columns of Arrow that hold several numbers in a row: lists, and structures of named members.

They are called as in JSON: ``gyro[0]``, ``angular_velocity.x``, ``header.stamp.sec``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import pyarrow as pa
import pyarrow.compute as pc

from pyimu.recording.formats.clock_times import is_clock

LONGEST = 16
"""Numbers of a list in a row that are columns: what has more is a piece of a signal."""

DEEPEST = 4
"""Lists and structures within each other, at most."""


@dataclass(frozen=True)
class Leaf:
    """A column ``name`` of the type ``kind``: in the column ``top`` of the table what stands at the
    end of ``path``, members by their names and elements by their numbers.
    """

    name: str
    top: str
    kind: pa.DataType
    path: tuple[str | int, ...] = ()

    @property
    def is_number(self) -> bool:
        return is_number(self.kind) or is_clock(self.kind)

    def of(self, column: pa.Array) -> pa.Array:
        """It in the ``column`` that is its top; null where a list is shorter."""
        for step in self.path:
            if isinstance(step, str):
                column = pc.struct_field(column, step)
            else:
                one = pc.list_slice(column, step, step + 1, return_fixed_size_list=True)
                column = pc.list_element(one, 0)
        return column


def is_number(kind: pa.DataType) -> bool:
    return pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_boolean(kind)


def leaves(top: str, kind: pa.DataType, first: pa.Array) -> list[Leaf]:
    """The columns in that called ``top``, the lists of which are as long as those in its ``first``
    rows.
    """
    return list(_leaves(Leaf(top.strip(), top, kind), first))


def _leaves(leaf: Leaf, first: pa.Array) -> Iterator[Leaf]:
    kind = leaf.kind
    if len(leaf.path) < DEEPEST and pa.types.is_struct(kind):
        for field in kind:
            name, path = f"{leaf.name}.{field.name}", (*leaf.path, field.name)
            yield from _leaves(Leaf(name, leaf.top, field.type, path), first)
        return
    lists = pa.types.is_list(kind) or pa.types.is_large_list(kind)
    if len(leaf.path) < DEEPEST and (lists or pa.types.is_fixed_size_list(kind)):
        length = pc.max(pc.list_value_length(leaf.of(first))).as_py() or 0
        if 0 < length <= LONGEST:
            for k in range(length):
                one = Leaf(f"{leaf.name}[{k}]", leaf.top, kind.value_type, (*leaf.path, k))
                yield from _leaves(one, first)
            return
    yield leaf
