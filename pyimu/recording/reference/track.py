"""The samples of a reference that can be differentiated: without occlusions and faults."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.clock import runs

LEAST_NODES = 8
"""A segment of a reference with fewer samples is left out."""


BREAK = 1.5
"""A step between reference samples above so many of its own longest usual ones is a gap."""


BRIDGED = 2.25
"""A gap of so many mean steps or less is none: with one sample missing the others still show half
of what they show elsewhere, and a derived rate is used in no more than that."""


SPIKE_ANGLE = 0.05
"""rad; below it a step of the reference's attitude and back is taken for its noise."""


SPIKE_RATIO = 20.0
"""A spike exceeds the 95 % quantile of its statistic in the same recording so many times."""


STEP_RATIO = 8.0
"""Close to a spike, a step of the rate above so many 90 % quantiles belongs to the same fault."""


REACQUIRE = 1.0
"""s; within it faults are one fault, and a shorter piece of reference beside one is left out."""


MARGIN = 0.25
"""s; left out on both sides of a fault."""


def fresh(values: np.ndarray) -> np.ndarray:
    """Rows of a reference (n, k) that are known and new.

    A slow reference that is held between its own samples repeats most rows in runs of one length;
    its repeats are no samples. One that stands still for a while, or is known at every row, is
    left as it is.
    """
    known = np.flatnonzero(np.all(np.isfinite(values), axis=1))
    if len(known) < 8:
        return known
    new = np.concatenate([[True], np.any(np.diff(values[known], axis=0) != 0, axis=1)])
    lengths = np.diff(np.flatnonzero(np.append(new, True)))
    usual = np.median(lengths)
    held = len(lengths) >= 8 and usual >= 2 and np.mean(np.abs(lengths - usual) <= 1) > 0.8
    return known[new] if held else known


def known_axes(values: np.ndarray) -> np.ndarray:
    """The columns of a reference (n, k) of which anything is known."""
    return np.flatnonzero(np.isfinite(values).any(axis=0))


class Track:
    """The samples of a reference that can be differentiated, without occlusions and faults.

    ``segments`` are arrays of row numbers. ``known`` are the rows with a reference;
    ``steps(nodes)`` gives the rotation vectors (m - 1, d) rad between them, or steps of another
    unit; a step and back below ``least`` is taken for the reference's noise.
    """

    def __init__(
        self,
        time: np.ndarray,
        known: np.ndarray,
        steps: Callable[[np.ndarray], np.ndarray],
        least: float = SPIKE_ANGLE,
    ) -> None:
        self.time = time
        self.least = least
        self.findings: list[Finding] = []
        step = np.diff(time[known])
        # the 90 % quantile, for a reference may fall on every second and third row in turn
        longest = BREAK * float(np.quantile(step, 0.9)) if len(step) else math.nan
        self.period = float(step[step <= longest].mean()) if len(step) else math.nan
        longest = max(longest, BRIDGED * self.period)
        whole = self._split(known, step > longest)
        self.segments = [
            nodes for nodes in self._without_faults(whole, steps) if len(nodes) >= LEAST_NODES
        ]

    @staticmethod
    def _split(nodes: np.ndarray, ends: np.ndarray) -> list[np.ndarray]:
        return [
            part for part in np.split(nodes, np.flatnonzero(ends) + 1) if len(part) >= LEAST_NODES
        ]

    def _without_faults(self, whole: list[np.ndarray], steps) -> list[np.ndarray]:
        """The segments less the faults of the reference.

        A spike is a step of the attitude that comes and goes, or a rate that jumps up and down
        again between samples: two successive changes of rate that oppose each other, sqrt(-d_k .
        d_k+1). It is zero for a step of the rate and for any acceleration that lasts, however fast
        the motion, and needs no gyro, so that over-range of the gyro is no fault of the reference.
        """
        angles = [steps(nodes) for nodes in whole]
        changes = [np.diff(a, axis=0) for a in angles]
        spikes = [np.sqrt(np.maximum(0, -np.sum(d[:-1] * d[1:], axis=1))) for d in changes]
        if not whole:
            return []
        gate = max(self.least, SPIKE_RATIO * float(np.quantile(np.concatenate(spikes), 0.95)))
        if max(s.max() for s in spikes) <= gate:
            return whole
        sizes = [np.linalg.norm(d, axis=1) for d in changes]
        step_gate = STEP_RATIO * float(np.quantile(np.concatenate(sizes), 0.9))
        kept = [
            self._healthy(nodes, s > gate, size > step_gate)
            for nodes, s, size in zip(whole, spikes, sizes)
        ]
        self._report(whole, kept, spikes, gate)
        return [
            part
            for nodes, good in zip(whole, kept)
            for part in self._split(nodes[good], np.diff(np.flatnonzero(good)) > 1)
        ]

    def _healthy(self, nodes: np.ndarray, spike: np.ndarray, step: np.ndarray) -> np.ndarray:
        """Mask of the nodes that no fault touches; ``spike`` (m - 3,), ``step`` (m - 2,)."""
        good, time = np.ones(len(nodes), bool), self.time[nodes]
        for first, last in self._faults(time[1:-2][spike], time[1:-1][step]):
            good &= (time < first - MARGIN) | (time > last + MARGIN)
        for start, stop in runs(good):
            if stop - start < len(nodes) and time[stop - 1] - time[start] < REACQUIRE:
                good[start:stop] = False
        return good

    @staticmethod
    def _faults(spikes: np.ndarray, steps: np.ndarray) -> list[tuple[float, float]]:
        """Intervals that spikes, and steps of the rate close to them, span."""
        events = np.union1d(spikes, steps)
        groups = np.split(events, np.flatnonzero(np.diff(events) > REACQUIRE) + 1)
        return [(g[0], g[-1]) for g in groups if np.isin(g, spikes).any()]

    def _report(
        self, whole: list[np.ndarray], kept: list[np.ndarray], spikes: list[np.ndarray], gate: float
    ) -> None:
        lost = np.concatenate([nodes[~good] for nodes, good in zip(whole, kept)])
        count = sum(int(np.sum(s > gate)) for s in spikes)
        self._tell(count, lost, float(max(s.max() for s in spikes)))

    def cut(self, jumps: np.ndarray, angles: np.ndarray) -> None:
        """Leave out what lies within ``MARGIN`` of ``jumps`` (j,), rows before which the
        reference's world turned by ``angles`` (j,) rad.
        """
        if not len(jumps):
            return
        away = np.full(len(self.time), np.inf)
        for row in jumps:
            away = np.minimum(away, np.abs(self.time - self.time[row]))
        whole, self.segments = self.segments, []
        for nodes in whole:
            good = away[nodes] > MARGIN
            self.segments += self._split(nodes[good], np.diff(np.flatnonzero(good)) > 1)
        lost = np.concatenate([nodes[away[nodes] <= MARGIN] for nodes in whole])
        self._tell(len(jumps), lost, float(angles.max()))

    def _tell(self, count: int, lost: np.ndarray, largest: float) -> None:
        """Add faults to the finding of them: how many, the rows (k,) that they cost, their size."""
        time = self.time[lost]
        detail = {
            "left_out": len(lost),
            "largest_angle": largest,
            "first": float(time.min()),
            "last": float(time.max()),
        }
        told = [f for f in self.findings if f.kind == "reference_spikes"]
        for f in told:
            count += f.count
            detail = {
                "left_out": detail["left_out"] + f.detail["left_out"],
                "largest_angle": max(largest, f.detail["largest_angle"]),
                "first": min(detail["first"], f.detail["first"]),
                "last": max(detail["last"], f.detail["last"]),
            }
        others = [f for f in self.findings if f not in told]
        self.findings = [*others, Finding("reference_spikes", "", count, detail)]
