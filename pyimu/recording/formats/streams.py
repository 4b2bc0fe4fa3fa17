"""Files of which a library reads all columns at once: logs of autopilots.

``Stream`` is what is found in one, named as a recording's columns are.
"""

from __future__ import annotations

import io
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.reader import Columns, Reader, as_number

MOST_PACKED = 1000
"""Rows to a byte of a file: eight bytes are packed into one of 8000 at best where nearly all are
the same."""


@dataclass(frozen=True)
class StreamReader(Reader):
    """Columns (n,) in memory by the name and unit that a recording's header has.

    ``body`` names the axes that the format defines, ``rate`` [Hz] is what the file states.
    """

    path: Path
    columns: dict[str, np.ndarray]
    findings: tuple[Finding, ...] = ()
    body: str | None = "frd"
    rate: float | None = None
    clocks: tuple[str, ...] = ()
    word: str = ""
    words: tuple[str, ...] = ()

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return list(self.columns)

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        columns = list(self.columns.values())
        yield [as_number(columns[p], p == long) for p in positions], 1.0

    def count(self, long: int) -> int:
        return len(next(iter(self.columns.values())))

    def place(self, index: int) -> str:
        return f"sample {index}"


class Said(io.TextIOBase):
    """What a library prints of a file while it reads, kept from the screen.

    Its lines are no words of ours, and would stand in the middle of a result that is to be JSON.
    ``of_damage`` is whether one of them says that bytes were passed over. What other threads print
    goes where it was to go.
    """

    def __init__(self, behind: TextIO, damage: Sequence[str]) -> None:
        self._behind, self._damage = behind, tuple(damage)
        self._thread = threading.get_ident()
        self.of_damage = False

    def write(self, text: str) -> int:
        if threading.get_ident() != self._thread:
            return self._behind.write(text)
        self.of_damage = self.of_damage or any(word in text for word in self._damage)
        return len(text)

    def flush(self) -> None:
        self._behind.flush()

    def isatty(self) -> bool:
        return self._behind.isatty()


@contextmanager
def unheard(damage: Sequence[str] = ()) -> Iterator[Callable[[], bool]]:
    """Within this context what this thread prints is not shown.

    Gives the question whether a word of ``damage`` was in it.
    """
    out, err = Said(sys.stdout, damage), Said(sys.stderr, damage)
    with redirect_stdout(out), redirect_stderr(err):
        yield lambda: out.of_damage or err.of_damage


@contextmanager
def reading(path: Path, name: str) -> Iterator[None]:
    """One net at the edge of a reader: what the library raises becomes a UserError.

    Libraries that parse damaged files raise whatever comes their way; ``name`` is the format.
    """
    try:
        yield
    except UserError:
        raise
    except MemoryError:
        raise UserError(f"{path}: cannot be read as {name} (it asks for too much memory)") from None
    except Exception as error:  # noqa: BLE001
        reason = (str(error).splitlines() or [""])[0] or type(error).__name__
        raise UserError(f"{path}: cannot be read as {name} ({reason})") from None


def must_be_held(path: Path, name: str, rows: int) -> None:
    """Raises UserError for a file ``name`` of so many rows that no file of its size holds them: of
    those that were never written there may be any number, and each is read.
    """
    most = max(path.stat().st_size, 1 << 10) * MOST_PACKED
    if rows > most:
        raise UserError(
            f"{path}: {name} says that it has {rows:,} rows, of which a file of "
            f"{path.stat().st_size:,} bytes holds {most:,} at most; is it cut off, or were they "
            "never written?"
        )


def onto(clock: np.ndarray, time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """``values`` (m,) of times ``time`` (m,) at the times ``clock`` (n,), linear between them."""
    first = clock[0]
    return np.interp((clock - first).astype(float), (time - first).astype(float), values)
