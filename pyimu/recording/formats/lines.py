"""Lines of text files, plain and gzipped, of bounded length."""

from __future__ import annotations

import codecs
import gzip
import io
import re
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from pyimu.errors import UserError
from pyimu.recording.formats.cells import ERRORS
from pyimu.recording.naming.languages import CODES, code_by_words

LONGEST = 1 << 18
"""Bytes of a line: a table of 10,000 columns has no longer ones, and a file without ends of lines
is none."""

BLOCK = 1 << 20
"""Bytes that are read at once."""

CARRIAGE = "its lines end with a carriage return alone; have them end with a line feed"

NOVATEL = "is a binary log of NovAtel's; log RAWIMUSXA (or RAWIMUXA), or export that as ASCII"

SIGNS = {
    b"PK\x03\x04": "is a ZIP archive or a workbook; unpack it, or save its sheet as CSV",
    b"\xd0\xcf\x11\xe0": "is a workbook of Excel; save its sheet as CSV",
    b"SQLite format 3": "is a database of SQLite; save its table as CSV, or call a bag .db3",
    b"\x89HDF": "is HDF5; its name must end in .h5 then, or .mat",
    b"MATLAB 5.0": "is a MAT file; its name must end in .mat then",
    b"PAR1": "is Parquet; its name must end in .parquet then",
    b"\x93NUMPY": "is an array of NumPy; its name must end in .npy then",
    b"ULog": "is a log of PX4; its name must end in .ulg then",
    b"#ROSBAG": "is a bag of ROS 1; its name must end in .bag then",
    b"\x89MCAP": "is MCAP; its name must end in .mcap then",
    b"\xaaD\x12": NOVATEL,
    b"\xaaD\x13": NOVATEL,
    b"\xb5b": "is binary UBX of u-blox; take a table of its ESF-RAW or ESF-MEAS messages",
    b"\xfa\xff": "is binary of Xsens; export it as text, in MT Manager or by the SDK",
    b"Obj\x01": "is Avro, as Empatica's EmbracePlus writes it; make a CSV or Parquet of it",
}
"""How other files begin, and what is to be done with one that is called as a text."""

LONGEST_SIGN = max(map(len, SIGNS))

COMMENTS = ("#", "//", "%", '"#')
"""What a line of comment begins with."""

NO_COMMENT = (*ERRORS, *(f'"{error}' for error in ERRORS))
"""A row may begin so, where its first cell holds no value."""

_MARKS = tuple(mark.encode() for mark in COMMENTS)
_NO_MARKS = tuple(mark.encode() for mark in NO_COMMENT)


def is_comment(line: str) -> bool:
    return line.startswith(COMMENTS) and not line.startswith(NO_COMMENT)


UTF_16 = "UTF-16"
UTF_8 = "UTF-8"
WESTERN = "Windows-1252"
CHINESE = CODES["gb2312"]
"""Codes of a text: the second is the usual one, and in the others older programs write, as in those
of ``CODES``."""

_BOMS = {b"\xff\xfe": "utf-16-le", b"\xfe\xff": "utf-16-be"}
"""Marks at the start of texts in UTF-16."""

PEEKED = 32
"""Bytes that tell a text in UTF-16 without such a mark."""


def is_gzip(path: Path) -> bool:
    """Whether a file is packed, whatever its name says."""
    return path.name.lower().endswith(".gz") or _first_bytes(path)[:2] == b"\x1f\x8b"


def _first_bytes(path: Path) -> bytes:
    """The first bytes of a regular file, none of one that cannot be read."""
    try:
        with path.open("rb") as raw:
            return raw.read(LONGEST_SIGN) if path.is_file() else b""
    except OSError:
        return b""


def sign_of(path: Path) -> str | None:
    """What a file is by its first bytes, and what is to be done with it; None of any other."""
    first = _first_bytes(path)
    return next((does for sign, does in SIGNS.items() if first.startswith(sign)), None)


def _is_no_text(path: Path, why: str) -> UserError:
    """What is said of a file that is no text: what it is, where its first bytes tell, else why."""
    return UserError(f"{path}: {sign_of(path) or why}")


@contextmanager
def opened(path: Path) -> Iterator[tuple[BinaryIO, BinaryIO]]:
    """The text's bytes, and the file itself, whose position tells how far reading is.

    A text in UTF-16 comes in UTF-8. Raises UserError for what cannot be read.
    """
    try:
        with path.open("rb") as raw:
            if is_gzip(path):
                with gzip.GzipFile(fileobj=raw, mode="rb") as unpacked:
                    yield _in_utf8(io.BufferedReader(unpacked, BLOCK)), raw
            else:
                yield _in_utf8(raw), raw
    except (OSError, EOFError, zlib.error) as error:
        reason = getattr(error, "strerror", None) or error
        raise UserError(f"{path}: cannot be read ({reason})") from None
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not text in UTF-16, as its first bytes say") from None


def _in_utf8(stream: io.BufferedReader) -> BinaryIO:
    """``stream``, and where it begins as UTF-16 does, its text in UTF-8."""
    head = stream.peek(PEEKED)[:PEEKED]
    code = _BOMS.get(head[:2])
    if code is not None:
        stream.read(2)
    else:
        code = _unmarked(head)
    if code is None:
        return stream
    return io.BufferedReader(Recoded(stream, code), BLOCK)


def _unmarked(head: bytes) -> str | None:
    """The code of a text in UTF-16 that begins without its mark, as ASCII in two bytes each; None
    of any other.
    """
    halves = head[0::2], head[1::2]
    zero = [len(half) > 1 and not any(half) for half in halves]
    if zero[0] == zero[1] or 0 in halves[zero[0]]:
        return None
    return "utf-16-be" if zero[0] else "utf-16-le"


def code_of(path: Path) -> str:
    """The code of a text by its first 256 KiB, one of those above."""
    with opened(path) as (stream, raw):
        if stream is not raw and isinstance(getattr(stream, "raw", None), Recoded):
            return UTF_16
        try:
            codecs.getincrementaldecoder("utf-8")().decode(head := stream.read(LONGEST))
        except UnicodeDecodeError:
            told = _code_by_words(head)
            if told is not None:
                return CODES[told]
            return WESTERN if _in_chinese(head) is None else CHINESE
    return UTF_8


def _code_by_words(head: bytes) -> str | None:
    """The code in which one of the first lines has a word for a quantity, None where none has."""
    told = (code_by_words(line) for line in head.splitlines() if _in_utf_8(line) is None)
    return next((code for code in told if code is not None), None)


def _in_utf_8(line: bytes, first: bool = False) -> str | None:
    """A line's text, of the ``first`` one without the mark of the code; None of another code."""
    try:
        return line.decode("utf-8-sig" if first else "utf-8")
    except UnicodeDecodeError:
        return None


def lines(path: Path) -> Iterator[str]:
    """The lines of a text, without a byte order mark.

    A line that is not in UTF-8 is taken for one in the code in which the first lines have words for
    quantities, else for one in Windows-1252, or in GB 2312 where it may be in that. Raises
    UserError for bytes that are no text there, and for a line longer than ``LONGEST``.
    """
    with opened(path) as (stream, _):
        number, code, looked = 0, None, False
        while line := stream.readline(LONGEST + 1):
            number += 1
            if len(line) > LONGEST:
                if number == 1 and b"\r" in line:
                    raise _is_no_text(path, CARRIAGE)
                raise _is_no_text(
                    path, f"row {number} is longer than {LONGEST >> 10} KiB, this is no table"
                )
            text = _in_utf_8(line, number == 1)
            if text is None:
                if not looked:
                    code, looked = _told_code(path), True
                text = _decoded(line, code)
            if text is None:
                raise _is_no_text(
                    path,
                    f"is not text in {UTF_8}, {UTF_16}, {WESTERN} or {CHINESE}; save text in "
                    f"another code as {UTF_8}",
                )
            yield text


def _told_code(path: Path) -> str | None:
    with opened(path) as (stream, _):
        return _code_by_words(stream.read(LONGEST))


def _decoded(line: bytes, code: str | None) -> str | None:
    """The text of a line in an older code, of ``code`` where that was told, None where it is none;
    letters of Windows-1252 are no control characters.
    """
    if code is not None:
        return line.decode(code, "replace")
    chinese = _in_chinese(line)
    if chinese is not None:
        return chinese
    try:
        text = line.decode("cp1252")
    except UnicodeDecodeError:
        return None
    return text if all(c.isprintable() or c in "\t\r\n\xa0\xad" for c in text) else None


_PAIRS = re.compile(rb"[\x80-\xff]+")
_LEAST_PAIRS = 2
"""Letters of GB 2312 in a line that are two bytes each: Western ones above ASCII stand alone."""


def _in_chinese(text: bytes) -> str | None:
    """A text in GB 2312, None where it can be none."""
    runs = _PAIRS.findall(text)
    if max(map(len, runs), default=0) < 2 * _LEAST_PAIRS or any(len(run) % 2 for run in runs):
        return None
    try:
        return text.decode("gb2312")
    except UnicodeDecodeError:
        return None


class Recoded(io.RawIOBase):
    """The bytes of ``stream``, a text in ``code``, in UTF-8."""

    def __init__(self, stream: BinaryIO, code: str) -> None:
        self._stream = stream
        self._decoder = codecs.getincrementaldecoder(code)()
        self._rest = b""

    def readable(self) -> bool:
        return True

    def readinto(self, buffer) -> int:  # type: ignore[no-untyped-def]
        while not self._rest:
            block = self._stream.read(BLOCK)
            # A code unit that was cut off at the end is no text any more.
            self._rest = self._decoder.decode(block).encode("utf-8", "replace")
            if not block:
                break
        piece, self._rest = self._rest[: len(buffer)], self._rest[len(buffer) :]
        buffer[: len(piece)] = piece
        return len(piece)


class Body:
    """The bytes of a table from its line ``first`` (from 1) to before ``stop``, in whole lines.

    Lines of comment are left out, and those that are not ``whole``, where that is asked. Where
    ``blanks`` separate the columns, a run of them becomes one; ``rewrite`` makes a row of a line,
    or none, also of what looks like a comment where those are not ``comments``.
    Lines longer than ``LONGEST`` are cut, for the reader behind to complain.
    """

    def __init__(
        self,
        stream: BinaryIO,
        first: int,
        stop: int | None,
        blanks: bool,
        whole: Callable[[bytes], bool] | None = None,
        rewrite: Callable[[str], str | None] | None = None,
        comments: bool = True,
    ) -> None:
        self._stream, self._blanks, self._whole = stream, blanks, whole
        self._rewrite, self._comments = rewrite, comments
        self._left = None if stop is None else stop - first
        for _ in range(first - 1):
            stream.readline(LONGEST)

    def blocks(self) -> Iterator[bytes]:
        """The bytes in blocks with something in them."""
        while self._left != 0 and (block := self._stream.read(BLOCK)):
            block += self._stream.readline(LONGEST)
            kept = self._cleaned(self._before_stop(block))
            if kept.strip():
                yield kept

    def _before_stop(self, block: bytes) -> bytes:
        """The lines of a block that are before the last one."""
        if self._left is None:
            return block
        count = block.count(b"\n")
        if count >= self._left:
            block = b"\n".join(block.split(b"\n", self._left)[: self._left]) + b"\n"
        self._left = max(self._left - count, 0)
        return block

    def _cleaned(self, block: bytes) -> bytes:
        commented = self._comments and (
            block.startswith(_MARKS) or any(b"\n" + mark in block for mark in _MARKS)
        )
        if not (commented or self._blanks or self._whole or self._rewrite):
            return block
        kept = block.split(b"\n")
        if commented:
            kept = [
                line for line in kept if not line.startswith(_MARKS) or line.startswith(_NO_MARKS)
            ]
        if self._rewrite is not None:
            told = (self._rewrite(line.decode("utf-8", "replace").rstrip("\r")) for line in kept)
            kept = [row.encode() for row in told if row is not None]
        if self._blanks:
            kept = [b" ".join(line.split()) for line in kept]
        if self._whole is not None:
            kept = list(filter(self._whole, kept))
        return b"\n".join(kept)


def share(truths: Iterable[bool]) -> float:
    """Share of the ``truths`` that hold, zero of none."""
    seen = list(truths)
    return sum(seen) / len(seen) if seen else 0.0
