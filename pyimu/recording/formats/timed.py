"""A file without times: its samples are those of a rate."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver

TIME = "time [s]"
"""The column that is added."""


@dataclass(frozen=True)
class TimedReader(ReaderOver):
    """What ``reader`` reads, and behind it the column ``TIME``: sample k is at k / ``hertz``."""

    reader: Reader
    hertz: float
    source: str
    """Where the rate is from."""

    rate = None
    clocks = ()

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        detail = {"rate": self.hertz, "from": self.source}
        return (*self.reader.findings, Finding("nominal_time", "time", 1, detail))

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return [*self.reader.header, TIME]

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        own = len(self.reader.header)
        theirs = [p for p in positions if p != own]
        done = 0
        for columns, share in self.reader.batches(theirs, theirs[0] if theirs else 0):
            rows = len(columns[0])
            self._check()
            found = dict(zip(theirs, columns, strict=True))
            found[own] = np.arange(done, done + rows) / self.hertz
            done += rows
            yield [np.asarray(found[p], dtype=float) for p in positions], share

    def _check(self) -> None:
        """Raise UserError where a row was left out: those behind it would be early by a period."""
        for finding in self.reader.at_end():
            if finding.kind == "rows_left_out":
                row, count = finding.detail["first_row"], finding.count
                raise UserError(
                    f"{self.path}: row {row} is no whole row{f', one of {count}' * (count > 1)}, "
                    "and none can be left out of a log without times: mend it"
                )

    def count(self, long: int) -> int | None:
        names = [k for k, name in enumerate(self.reader.header) if "gyr" in name or "acc" in name]
        return self.reader.count(names[0] if names else 0)
