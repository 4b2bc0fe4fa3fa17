"""Columns of a log that lie in files of their own, brought to the log's times.

A phone writes gyro and accelerometer into two files, each with its own times. Where every sample
of the one has a sample of the other within half a period, that sample is taken as it is, so that
its noise stays what it is; else values between two samples are interpolated, which takes away up to
half the variance of white noise, and that is said.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.clock import cadence_of
from pyimu.recording.rows import Rows, Source

LONGEST = 1.5
"""Periods between two samples over which nothing is interpolated."""

SAME = 1e-6
"""Part of a step by which two times may differ by rounding and be one."""

BETWEEN = "between samples"
"""How columns came to the log's times that were interpolated."""


@dataclass
class Companion:
    """The samples of a further file: ``time`` (m,) s from its own ``origin``, and its groups."""

    source: Source
    time: np.ndarray
    groups: dict[str, np.ndarray]
    origin: float | np.integer
    period: float
    findings: tuple[Finding, ...]
    nearest: bool | None = None
    left: list[float] = field(default_factory=list)

    @classmethod
    def read(cls, source: Source) -> Companion:
        """Raises UserError as reading a log does."""
        passing = Rows(source)
        pieces = [(time, groups) for time, groups, _ in passing.batches()]
        time = np.concatenate([t for t, _ in pieces])
        groups = {g: np.concatenate([values[g] for _, values in pieces]) for g in pieces[0][1]}
        return cls(source, time, groups, passing.origin, cadence_of(time).period, passing.findings)

    def at(self, time: np.ndarray, main: Rows) -> dict[str, np.ndarray]:
        """The groups at the times (n,) s of the log, NaN where this file has no sample near.

        Raises UserError where the first of the log's pieces and this file do not overlap.
        """
        moved = self.time + self._offset(main)
        if self.nearest is None:
            self._check(time, moved, main)
            self.nearest = _one_to_one(time, moved, self.period)
        after = np.clip(np.searchsorted(moved, time), 1, len(moved) - 1)
        share = (time - moved[after - 1]) / (moved[after] - moved[after - 1])
        apart = moved[after] - moved[after - 1] > LONGEST * self.period
        if self.nearest:
            rows = after - (share < 0.5)
            far = np.abs(moved[rows] - time) > 0.5 * LONGEST * self.period
            return {g: _blank(values[rows].astype(float), far) for g, values in self.groups.items()}
        inside = np.clip(share, 0.0, 1.0)
        between = np.minimum(inside, 1 - inside) > SAME
        far = (np.abs(share - inside) > 0.5) | (apart & between)
        self.left.append(float(np.mean(inside**2 + (1 - inside) ** 2)))
        found = {}
        for group, values in self.groups.items():
            weight = inside if values.ndim == 1 else inside[:, None]
            mixed = values[after - 1] * (1 - weight) + values[after] * weight
            found[group] = _blank(mixed, far)
        return found

    def said(self) -> list[Finding]:
        """How the columns came to the log's times."""
        name = self.source.header.path.name
        detail: dict[str, object] = {"file": name, "how": "nearest sample"}
        if not self.nearest:
            detail = {
                "file": name,
                "how": BETWEEN,
                "noise_left": float(np.mean(self.left)),
            }
        groups = ", ".join(self.groups)
        return [*self.findings, Finding("other_file", groups, len(self.time), detail)]

    def _offset(self, main: Rows) -> float:
        """s to add to this file's times to have the log's."""
        ours, theirs = main.source.header.seconds, self.source.header.seconds
        if ours == theirs:
            return float(self.origin - main.origin) * ours
        return float(self.origin) * theirs - float(main.origin) * ours

    def _check(self, time: np.ndarray, moved: np.ndarray, main: Rows) -> None:
        if moved[0] > time[-1] or moved[-1] < time[0]:
            raise UserError(
                f"{self.source.header.path}: covers {moved[0]:.9g} to {moved[-1]:.9g} s of the "
                f"times of {main.source.header.path}, which begin at {time[0]:.9g} s: the two do "
                "not overlap, or are on different clocks"
            )


def interpolated(findings: Iterable[Finding]) -> set[str]:
    """The groups whose values lie between samples of another file, by what was found in a log."""
    between = (
        f for f in findings if f.kind == "other_file" and f.detail["how"] == BETWEEN and f.column
    )
    return {group for f in between for group in f.column.split(", ")}


def _one_to_one(time: np.ndarray, moved: np.ndarray, period: float) -> bool:
    """Whether each sample of the log has one of its own in the file, within half a period.

    Those in a gap of the file, and beyond its ends, do not count.
    """
    inside = time[(time >= moved[0] - period / 2) & (time <= moved[-1] + period / 2)]
    after = np.clip(np.searchsorted(moved, inside), 1, len(moved) - 1)
    step, since = moved[after] - moved[after - 1], inside - moved[after - 1]
    in_gap = (step > LONGEST * period) & (np.minimum(since, step - since) > period / 2)
    inside, after = inside[~in_gap], after[~in_gap]
    if not len(inside):
        return False
    rows = after - (inside - moved[after - 1] < moved[after] - inside)
    near = np.abs(moved[rows] - inside) <= 0.5 * period
    return bool(np.mean(near) > 0.99 and np.mean(np.diff(rows) == 1) > 0.99)


def _blank(values: np.ndarray, far: np.ndarray) -> np.ndarray:
    values[far] = np.nan
    return values
