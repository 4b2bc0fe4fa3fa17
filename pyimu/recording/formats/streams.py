"""Files of which a library reads all columns at once: logs of autopilots.

``Stream`` is what is found in one, named as a recording's columns are.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.reader import Columns, Reader, as_number

MOST_PACKED = 1000
"""Rows to a byte of a file: eight bytes are packed into one of 8000 at best where nearly all are
the same."""


@dataclass(frozen=True)
class StreamReader(Reader):
    """Columns (n,) in memory by the name and unit that a recording's header has.

    ``body`` names the axes that the format defines.
    """

    path: Path
    columns: dict[str, np.ndarray]
    findings: tuple[Finding, ...] = ()
    body: str | None = "frd"

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
