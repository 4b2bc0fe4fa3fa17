"""The interface of every reader: named columns of numbers, read in pieces of bounded length."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np

from pyimu.errors import Finding, UserError

Columns = list[np.ndarray]
"""Arrays (n,) of one length: float64, NaN where a value is missing; the time may be of int64."""


class Reader(ABC):
    """A file with columns of numbers, named by ``header``.

    ``findings`` are what the reader had to decide. ``crowded`` says that a file may hold much else,
    so that only the columns that a map names, or whose names are a recording's own, are looked at;
    ``skipped`` says what in it has no columns of numbers, and why. ``rate`` [Hz] is what the file
    says of itself, for where it has no times, ``body`` the axes that its format defines ("frd").
    ``word`` stands in the rows that are read of a table of several sensors, ``words`` in those of
    the others. ``clocks`` are the columns of dates and times of day, which come in s whatever their
    names say.
    """

    path: Path
    header: list[str]
    findings: tuple[Finding, ...] = ()
    crowded = False
    skipped: tuple[str, ...] = ()
    rate: float | None = None
    body: str | None = None
    clocks: tuple[str, ...] = ()
    word: str = ""
    words: tuple[str, ...] = ()
    in_memory = False
    """Whether it is no file, so that no command can look into it."""
    is_sheet = False
    """Whether it is a table in text, which may have sums and means below its samples."""

    @abstractmethod
    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """The columns at ``positions``, piece by piece, and the share of the file read so far.

        The pieces have the length that suits the file.

        ``long`` is the position of a column that may stay of integers, so that a clock in ns is not
        rounded. Raises UserError, with its place, for what is no number.
        """

    @abstractmethod
    def count(self, long: int) -> int | None:
        """The number of rows, None where only reading tells.

        ``long`` is the position of the time.
        """

    def at_end(self) -> tuple[Finding, ...]:
        """What was seen where the file ends, once it was read to there."""
        return ()

    def lines(self) -> Iterator[str]:
        """The lines of a text as they stand in it, none of any other file."""
        return iter(())

    def numeric(self) -> list[int]:
        """Positions of the columns that hold numbers."""
        return list(range(len(self.header)))

    def place(self, index: int) -> str:
        """Where the sample ``index`` stands, for messages."""
        return f"row {index + 2}"


class ReaderOver(Reader):
    """A reader of what another ``reader`` reads, with other columns."""

    reader: Reader

    @property
    def path(self):  # type: ignore[no-untyped-def, override]
        return self.reader.path

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return self.reader.header

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        return self.reader.findings

    @property
    def rate(self) -> float | None:  # type: ignore[override]
        return self.reader.rate

    @property
    def clocks(self) -> tuple[str, ...]:  # type: ignore[override]
        return self.reader.clocks

    @property
    def word(self) -> str:  # type: ignore[override]
        return self.reader.word

    @property
    def words(self) -> tuple[str, ...]:  # type: ignore[override]
        return self.reader.words

    @property
    def crowded(self) -> bool:  # type: ignore[override]
        return self.reader.crowded

    @property
    def in_memory(self) -> bool:  # type: ignore[override]
        return self.reader.in_memory

    @property
    def is_sheet(self) -> bool:  # type: ignore[override]
        return self.reader.is_sheet

    @property
    def skipped(self) -> tuple[str, ...]:  # type: ignore[override]
        return self.reader.skipped

    @property
    def body(self) -> str | None:  # type: ignore[override]
        return self.reader.body

    def at_end(self) -> tuple[Finding, ...]:
        return self.reader.at_end()

    def lines(self) -> Iterator[str]:
        return self.reader.lines()

    def place(self, index: int) -> str:
        return self.reader.place(index)


def as_number(column: np.ndarray, may_stay: bool) -> np.ndarray:
    """A column as float64, or as int64 where it ``may_stay`` of integers and is."""
    return np.ascontiguousarray(
        column, dtype=np.int64 if may_stay and column.dtype.kind in "iu" else float
    )


def need(module: str, extra: str, path: Path | str) -> ModuleType:
    """Import the module ``module``, which what ``path`` names takes.

    Raises UserError that names the extra of the package which installs it.
    """
    try:
        return import_module(module)
    except ImportError:
        library = module.partition(".")[0]
        raise UserError(
            f"{path}: needs {library}, which is not installed; install the extra: pip install "
            f"'pyimu[{extra}]'"
        ) from None
