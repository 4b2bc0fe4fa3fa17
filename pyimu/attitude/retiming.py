"""Samples that a sensor's own clock took: which instants they belong to, and back to the rows.

A clock that is off by the share eps takes its sample k at (1 + eps) times the time since power-on
that its row says. The samples hold the motion of those instants exactly; only their times are
wrong. The filter therefore turns by the true period, and here its estimates are brought back to the
times of the rows.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation


class Retiming:
    """The instants ``taken`` (n,) s of the samples whose rows say ``time`` (n,) s.

    The clock is off by the share ``skew``; power-on is one ``period`` s before the first row.
    """

    def __init__(self, time: np.ndarray, skew: float, period: float) -> None:
        self.time, self.taken = time, time + skew * (time - time[0] + period)

    def nearest_row(self) -> np.ndarray:
        """The row (n,) whose time is nearest to each sample's instant.

        It is -1 where the sample before has that row.
        """
        row = _nearest(self.time, self.taken)
        return np.where(np.diff(row, prepend=-1) > 0, row, -1)

    def to_rows(self, outputs: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The filter's outputs by name, (n,) or (n, m) at the samples, as they are at the rows.

        The attitude ``q`` turns evenly from sample to sample, and on after the last one; the others
        are those of the nearest sample.
        """
        sample = _nearest(self.taken, self.time)
        return {n: y[sample] for n, y in outputs.items()} | {"q": self._attitude(outputs["q"])}

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
