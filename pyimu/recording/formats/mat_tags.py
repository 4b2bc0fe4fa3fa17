"""The tags of a MAT file of version 5 to 7.2, checked before scipy's reader meets them.

That reader is C, and ends the process where a damaged tag lies about what follows. A file is a
header of 128 bytes and elements, each a type, a number of bytes and so much data (MAT-File Format,
MathWorks R2023b, "Level 5"): here the numbers of bytes are followed, through compressed elements
too, and must end where the file, the element around them, and the array's dimensions say.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

from pyimu.errors import UserError

HEADER = 128
MATRIX, COMPRESSED = 14, 15
SIZES = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4, 9: 8, 12: 8, 13: 8, 16: 1, 17: 2, 18: 4}
"""Bytes of an item of each type of data."""

CELL, STRUCT, OBJECT, CHAR, SPARSE = 1, 2, 3, 4, 5
NUMBERS = range(6, 16)
FUNCTION, OPAQUE, OBJECT_2 = 16, 17, 18

DEEPEST = 32
"""Structures in structures."""

MOST = 1 << 29
"""Bytes that the compressed elements of a file may have unpacked, and its numbers in memory: a
double array of whole numbers is stored in bytes, and takes eight times as much there."""

MOST_AXES = 32


TOO_LARGE = f"more than {MOST >> 20} MiB unpacked; save it with -v7.3"


class Damaged(Exception):
    """What is wrong with a file."""


@dataclass(frozen=True)
class _Element:
    """The type of an element and where its data lie in the bytes around it."""

    kind: int
    start: int
    stop: int
    after: int


def check_tags(path: Path) -> None:
    """Raise UserError where the tags of a MAT file do not fit each other."""
    data = path.read_bytes()
    if len(data) < HEADER or data[126:128] not in (b"IM", b"MI"):
        _check_version_4(path, data)
        return
    order = "<" if data[126:128] == b"IM" else ">"
    try:
        _Checker(order).top(memoryview(data))
    except Damaged as error:
        raise UserError(f"{path}: cannot be read as MAT ({error})") from None
    except (struct.error, zlib.error, RecursionError, MemoryError) as error:
        raise UserError(f"{path}: cannot be read as MAT (damaged: {error})") from None


def _check_version_4(path: Path, data: bytes) -> None:
    """Level 4: each matrix has a head of five integers, its name and its numbers."""
    at = 0
    while at < len(data):
        if len(data) - at < 20:
            raise UserError(f"{path}: cannot be read as MAT (it ends inside a head)")
        heads = [struct.unpack_from(f"{order}5i", data, at) for order in "<>"]
        good = [h for h in heads if 0 <= h[0] < 5000 and h[0] % 1000 // 100 == 0]
        if not good:
            raise UserError(f"{path}: cannot be read as MAT (neither version 4 nor 5 to 7)")
        kind, rows, columns, imaginary, name = good[0]
        size = {0: 8, 1: 4, 2: 4, 3: 2, 4: 2, 5: 1}.get(kind % 100 // 10)
        if size is None or kind % 10 > 2 or min(rows, columns) < 0 or imaginary not in (0, 1):
            raise UserError(f"{path}: cannot be read as MAT (a damaged head of version 4)")
        at += 20 + name + rows * columns * size * (1 + imaginary)
        if not 0 < name <= 4096 or at > len(data):
            raise UserError(f"{path}: cannot be read as MAT (cut off, or not a MAT file)")
    if not data:
        raise UserError(f"{path}: cannot be read as MAT (it is empty)")


class _Checker:
    """Follows the elements of a file with the byte ``order`` "<" or ">"."""

    def __init__(self, order: str) -> None:
        self.order = order
        self.unpacked = self.in_memory = 0

    def top(self, data: memoryview) -> None:
        at = HEADER
        while at < len(data):
            element = self._element(data, at, len(data), padded=False)
            if element.kind == COMPRESSED:
                self._compressed(data[element.start : element.stop])
            elif element.kind == MATRIX:
                self._matrix(data, element.start, element.stop, 0)
            else:
                raise Damaged(f"element of type {element.kind} where an array is expected")
            at = element.after

    def _compressed(self, packed: memoryview) -> None:
        unpacker = zlib.decompressobj()
        data = unpacker.decompress(packed, MOST - self.unpacked)
        if unpacker.unconsumed_tail:
            raise Damaged(TOO_LARGE)
        if not unpacker.eof:
            raise Damaged("a compressed array is cut off")
        self.unpacked += len(data)
        inner = memoryview(data)
        element = self._element(inner, 0, len(inner), padded=False)
        if element.kind != MATRIX:
            raise Damaged(f"compressed element of type {element.kind}")
        self._matrix(inner, element.start, element.stop, 0)

    def _element(self, data: memoryview, at: int, stop: int, padded: bool = True) -> _Element:
        """The element at ``at``; one of at most four bytes has its data in its tag."""
        if stop - at < 8:
            raise Damaged("a tag is cut off")
        kind, size = struct.unpack_from(f"{self.order}II", data, at)
        if kind >> 16:
            small = kind >> 16
            if small > 4:
                raise Damaged(f"a small element of {small} bytes")
            return _Element(kind & 0xFFFF, at + 4, at + 4 + small, at + 8)
        end = at + 8 + size
        if end > stop:
            raise Damaged(f"an element of {size} bytes where {stop - at - 8} are left")
        after = end + (-size % 8 if padded else 0)
        return _Element(kind, at + 8, end, min(after, stop))

    def _integers(self, data: memoryview, element: _Element, kind: int) -> tuple[int, ...]:
        count, odd = divmod(element.stop - element.start, 4)
        if element.kind != kind or odd:
            raise Damaged(f"an element of type {element.kind} where integers are expected")
        letter = {5: "i", 6: "I"}[kind]
        return struct.unpack_from(f"{self.order}{count}{letter}", data, element.start)

    def _matrix(self, data: memoryview, at: int, stop: int, depth: int) -> None:
        if depth > DEEPEST:
            raise Damaged("arrays nested too deeply")
        if at == stop:  # an empty array in a cell
            return
        flags_at = self._element(data, at, stop)
        flags = self._integers(data, flags_at, 6)
        if len(flags) != 2:
            raise Damaged("the flags of an array are damaged")
        kind = flags[0] & 0xFF
        if kind == OPAQUE:
            at = flags_at.after
            for _ in range(3):
                text = self._element(data, at, stop)
                if text.kind not in (1, 2):
                    raise Damaged("the names of an object are damaged")
                at = text.after
            self._arrays(data, at, stop, 1, depth)
            return
        dims_at = self._element(data, flags_at.after, stop)
        dims = self._integers(data, dims_at, 5)
        if not 2 <= len(dims) <= MOST_AXES or min(dims) < 0:
            raise Damaged("the dimensions of an array are damaged")
        name = self._element(data, dims_at.after, stop)
        if name.kind not in (1, 2, 16):
            raise Damaged("the name of an array is damaged")
        count = 1
        for n in dims:
            count *= n
        self._contents(data, name.after, stop, kind, bool(flags[0] & 0x800), count, depth)

    def _contents(
        self,
        data: memoryview,
        at: int,
        stop: int,
        kind: int,
        is_complex: bool,
        count: int,
        depth: int,
    ) -> None:
        if kind in NUMBERS or kind == CHAR:
            for _ in range(1 + is_complex):
                at = self._numbers(data, at, stop, count)
        elif kind == SPARSE:
            for _ in range(3 + is_complex):  # rows, starts of columns, numbers
                part = self._element(data, at, stop)
                if part.kind not in SIZES:
                    raise Damaged(f"a sparse array with an element of type {part.kind}")
                at = part.after
        elif kind == CELL:
            self._arrays(data, at, stop, count, depth)
        elif kind in (STRUCT, OBJECT):
            if kind == OBJECT:
                at = self._element(data, at, stop).after
            length_at = self._element(data, at, stop)
            (length, *rest) = self._integers(data, length_at, 5) or (0,)
            names = self._element(data, length_at.after, stop)
            size = names.stop - names.start
            if rest or not 0 < length <= 4096 or size % length or names.kind not in (1, 2):
                raise Damaged("the names of fields are damaged")
            self._arrays(data, names.after, stop, count * (size // length), depth)
        elif kind == FUNCTION:
            self._arrays(data, at, stop, 1, depth)
        else:
            raise Damaged(f"an array of class {kind}")

    def _numbers(self, data: memoryview, at: int, stop: int, count: int) -> int:
        numbers = self._element(data, at, stop)
        size = SIZES.get(numbers.kind)
        if size is None:
            raise Damaged(f"numbers of type {numbers.kind}")
        if numbers.kind not in (16, 17, 18) and numbers.stop - numbers.start != count * size:
            raise Damaged("an array has more or fewer numbers than its dimensions say")
        self.in_memory += 8 * count
        if self.in_memory > MOST:
            raise Damaged(TOO_LARGE)
        if numbers.stop - numbers.start > 4 * max(count, 1) * size:
            raise Damaged("a text has more bytes than its dimensions say")
        return numbers.after

    def _arrays(self, data: memoryview, at: int, stop: int, count: int, depth: int) -> None:
        if count * 8 > stop - at:
            raise Damaged("an array has more members than the file has bytes")
        for _ in range(count):
            inner = self._element(data, at, stop)
            if inner.kind != MATRIX:
                raise Damaged(f"a member of type {inner.kind}")
            self._matrix(data, inner.start, inner.stop, depth + 1)
            at = inner.after
