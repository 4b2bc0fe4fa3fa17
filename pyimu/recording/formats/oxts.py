"""KITTI's ``oxts``: a folder with a text of numbers for each sample, and their times in another.

Geiger et al. 2013, and the data set's own ``dataformat.txt``, whose names the columns have.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pyimu.errors import UserError
from pyimu.files import check_regular, text_in
from pyimu.recording.formats.reader import Columns, Reader

NAMES = tuple(
    "lat lon alt roll pitch yaw vn ve vf vl vu ax ay az af al au wx wy wz wf wl wu "
    "pos_accuracy vel_accuracy navstat numsats posmode velmode orimode".split()
)
TIME, CLOCK = "timestamp", "ns"
"""The column of the times, and its unit: they have nine digits behind the seconds."""

BATCH = 4096
"""Samples of a piece."""

LONGEST = 4096
"""Bytes of a sample at most: thirty numbers have some 500."""


def oxts_in(folder: Path) -> Path | None:
    """The folder with ``timestamps.txt`` and ``data`` that a folder is, or holds as ``oxts``; None
    for any other.
    """
    inside = (folder, folder / "oxts")
    return next((f for f in inside if (f / STAMPS).is_file() and (f / "data").is_dir()), None)


STAMPS = "timestamps.txt"


def is_oxts(reader: Reader) -> bool:
    """Whether what ``reader`` has opened is such a folder."""
    return tuple(reader.header) == (TIME, *NAMES)


@dataclass(frozen=True)
class OxtsReader(Reader):
    """The samples in a folder ``oxts``; a time without a sample, as the data set has some, is left
    out.
    """

    path: Path
    header: list[str]
    samples: tuple[Path, ...]
    times: np.ndarray

    @classmethod
    def open(cls, folder: Path) -> OxtsReader:
        """Open the folder. Raises UserError for times that are none, or too few of them."""
        stamps = folder / STAMPS
        lines = text_in(stamps).split("\n")
        named = {p.stem: p for p in (folder / "data").glob("*.txt") if p.stem.isdigit()}
        rows = sorted(named, key=int)
        late = next((row for row in rows if int(row) >= len(lines)), None)
        if late is not None:
            raise UserError(f"{named[late]}: {stamps} has no time for it")
        times = [_nanoseconds(stamps, int(row), lines[int(row)]) for row in rows]
        header = [TIME, *NAMES]
        return cls(folder, header, tuple(named[r] for r in rows), np.array(times, dtype=np.int64))

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        for start in range(0, len(self.samples), BATCH):
            stop = min(start + BATCH, len(self.samples))
            numbers = np.array([_numbers(p) for p in self.samples[start:stop]])
            times = self.times[start:stop]
            yield (
                [
                    numbers[:, p - 1] if p else times if long == 0 else times.astype(float)
                    for p in positions
                ],
                stop / len(self.samples),
            )

    def count(self, long: int) -> int:
        return len(self.samples)

    def place(self, index: int) -> str:
        return str(self.samples[index].name) if index < len(self.samples) else f"sample {index}"


def _nanoseconds(path: Path, row: int, text: str) -> int:
    """ns since 1970 of a date with a time."""
    try:
        stamp = np.datetime64(text.strip().replace(" ", "T"), "ns")
    except ValueError:
        stamp = np.datetime64("NaT")
    if np.isnat(stamp):
        raise UserError(
            f"{path}: line {row + 1} is no date with a time such as 2011-09-26 13:02:25.594360375"
        )
    return int(stamp.astype(np.int64))


def _numbers(path: Path) -> list[float]:
    """The numbers of a sample. Raises UserError where it has not as many as it should have."""
    check_regular(path)
    with path.open(errors="replace") as file:
        words = file.read(LONGEST).split()
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != len(NAMES):
        raise UserError(f"{path}: is no sample of oxts, which has {len(NAMES)} numbers")
    return numbers
