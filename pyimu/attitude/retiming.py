"""Samples that are not of their rows' times: which instants they belong to, and back to the rows.

A clock that is off by the share eps takes its sample k at (1 + eps) times the time since power-on
that its row says; a sample that is late holds the motion of its delay before. The samples hold the
motion of those instants exactly; only their times are wrong. The filter therefore turns by the true
period, and here its estimates are brought back to the times of the rows.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation


class Retiming:
    """The instants ``taken`` (n,) s of the estimates after samples whose rows say ``time`` (n,) s.

    The clock is off by the share ``skew``; power-on is one ``period`` s before the first row. All
    estimates are late by ``delay`` s, early where it is below zero.
    """

    def __init__(self, time: np.ndarray, skew: float, period: float, delay: float = 0.0) -> None:
        self.time, self.taken = time, time + skew * (time - time[0] + period) - delay

    def nearest_row(self) -> np.ndarray:
        """The row (n,) whose time is nearest to each sample's instant.

        It is -1 where the sample before has that row.
        """
        row = _nearest(self.time, self.taken)
        return np.where(np.diff(row, prepend=-1) > 0, row, -1)

    def to_rows(self, outputs: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The filter's outputs by name, (n,) or (n, m) at the samples, as they are at the rows.

        The attitude ``q`` turns evenly from sample to sample, and on after the last one; the others
        are those of the nearest sample. How the rate may have changed after the last one is in
        ``std`` and ``heading_std``.
        """
        sample = _nearest(self.taken, self.time)
        rows = {n: y[sample] for n, y in outputs.items()} | {"q": self._attitude(outputs["q"])}
        after = np.maximum(self.time - self.taken[-1], 0)
        last = after > 0
        if last.any():
            added = self._strayed(outputs["q"], after[last])
            rows["std"][last, :3] = np.sqrt(rows["std"][last, :3] ** 2 + added[:, None])
            rows["heading_std"][last] = np.sqrt(rows["heading_std"][last] ** 2 + added)
        return rows

    def _strayed(self, q: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Mean square (m,) in rad^2 per axis of what turning on evenly for ``after`` (m,) s errs
        by.

        It is half of the turn by which the rate changes over that time, by all of the samples.
        """
        turns = (Rotation.from_quat(q[:-1], scalar_first=True).inv()) * Rotation.from_quat(
            q[1:], scalar_first=True
        )
        rates = turns.as_rotvec() / np.diff(self.taken)[:, None]
        steps = np.clip(np.ceil(after / np.diff(self.taken).mean()), 1, len(rates)).astype(int)
        change = {n: np.mean((rates[n:] - rates[:-n]) ** 2) for n in set(steps) if n < len(rates)}
        return np.array([t**2 / 4 * change.get(n, 0.0) for t, n in zip(after, steps, strict=True)])

    def _attitude(self, q: np.ndarray) -> np.ndarray:
        left = np.clip(np.searchsorted(self.taken, self.time) - 1, 0, len(q) - 2)
        share = (self.time - self.taken[left]) / (self.taken[left + 1] - self.taken[left])
        before = Rotation.from_quat(q[left], scalar_first=True)
        turn = before.inv() * Rotation.from_quat(q[left + 1], scalar_first=True)
        at = before * Rotation.from_rotvec(share[:, None] * turn.as_rotvec())
        return at.as_quat(scalar_first=True)


def _nearest(times: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Index (m,) of the nearest of the rising ``times`` (n,) to each of ``wanted`` (m,)."""
    right = np.clip(np.searchsorted(times, wanted), 1, len(times) - 1)
    return right - (wanted - times[right - 1] < times[right] - wanted)
