"""Lines of text files, plain and gzipped, of bounded length."""

from __future__ import annotations

import gzip
import io
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from pyimu.errors import UserError

LONGEST = 1 << 18
"""Bytes of a line: a table of 10,000 columns has no longer ones, and a file without ends of lines
is none."""

BLOCK = 1 << 20
"""Bytes that are read at once."""

COMMENTS = ("#", "//", "%", '"#')
"""What a line of comment begins with."""

NO_COMMENT = ("#N/A", '"#N/A')
"""A row may begin so, where its first cell holds no value."""

_MARKS = tuple(mark.encode() for mark in COMMENTS)
_NO_MARKS = tuple(mark.encode() for mark in NO_COMMENT)


def is_comment(line: str) -> bool:
    return line.startswith(COMMENTS) and not line.startswith(NO_COMMENT)


def is_gzip(path: Path) -> bool:
    return path.name.lower().endswith(".gz")


@contextmanager
def opened(path: Path) -> Iterator[tuple[BinaryIO, BinaryIO]]:
    """The text's bytes, and the file itself, whose position tells how far reading is.

    Raises UserError for what cannot be read.
    """
    try:
        with path.open("rb") as raw:
            if is_gzip(path):
                with gzip.GzipFile(fileobj=raw, mode="rb") as unpacked:
                    yield io.BufferedReader(unpacked, BLOCK), raw
            else:
                yield raw, raw
    except (OSError, EOFError, zlib.error) as error:
        reason = getattr(error, "strerror", None) or error
        raise UserError(f"{path}: cannot be read ({reason})") from None


def lines(path: Path) -> Iterator[str]:
    """The lines of a text in UTF-8, without a byte order mark.

    Raises UserError for other bytes, and for a line longer than ``LONGEST``.
    """
    with opened(path) as (stream, _):
        number = 0
        while line := stream.readline(LONGEST + 1):
            number += 1
            if len(line) > LONGEST:
                raise UserError(
                    f"{path}: row {number} is longer than {LONGEST >> 10} KiB, this is no table"
                )
            try:
                yield line.decode("utf-8-sig" if number == 1 else "utf-8")
            except UnicodeDecodeError:
                raise UserError(f"{path}: is not text in UTF-8") from None


class Body(io.RawIOBase):
    """The bytes of a table from its line ``first`` (from 1) on, lines of comment left out.

    Where ``blanks`` separate the columns, a run of them becomes one. Lines longer than ``LONGEST``
    end it, for the reader behind to complain.
    """

    def __init__(self, stream: BinaryIO, first: int, blanks: bool) -> None:
        self._stream, self._blanks = stream, blanks
        self._rest = memoryview(b"")
        for _ in range(first - 1):
            stream.readline(LONGEST)

    def readable(self) -> bool:
        return True

    def readinto(self, buffer) -> int:  # type: ignore[no-untyped-def]
        while not self._rest:
            block = self._stream.read(BLOCK)
            if not block:
                return 0
            block += self._stream.readline(LONGEST)
            self._rest = memoryview(self._cleaned(block))
        piece, self._rest = self._rest[: len(buffer)], self._rest[len(buffer) :]
        buffer[: len(piece)] = piece
        return len(piece)

    def _cleaned(self, block: bytes) -> bytes:
        commented = block.startswith(_MARKS) or any(b"\n" + mark in block for mark in _MARKS)
        if not commented and not self._blanks:
            return block
        kept = block.split(b"\n")
        if commented:
            kept = [
                line for line in kept if not line.startswith(_MARKS) or line.startswith(_NO_MARKS)
            ]
        if self._blanks:
            kept = [b" ".join(line.split()) for line in kept]
        return b"\n".join(kept)
