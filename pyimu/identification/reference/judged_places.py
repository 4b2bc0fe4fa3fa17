"""How well the accelerometer's motion behind a filter of places explains the force that a reference
makes of these.

A filter over positions p makes F(p'') + g of the force, in the world's axes. The accelerometer's is
brought there by the gyro, filtered, and brought back: F(R f) = F(p'') + g of a filter that leaves
what is constant; so is what an arm from the point that is tracked to the sensor adds to it. By the
attitudes of the reference the noise of these would be filtered with it, and explain itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.interpolated import TAPS
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.judged import Judge, explained
from pyimu.identification.reference.moving import moving_rows, turned_onto
from pyimu.model.kinds import OWN
from pyimu.recording.reference.filters import turned_by
from pyimu.recording.reference.force import arm_forces

FARTHEST = 0.1
"""s; so far places may be beside attitudes, as a standard deviation before anything is seen, and
the farthest that is believed where no filter is."""


@dataclass(frozen=True)
class Together:
    """No filter, and places that have the attitudes' clock."""

    size: float = 0.0

    def reach(self, h: float) -> int:
        """As ``Filter.reach``: as far as the clock is looked for that it is compared with."""
        return int(np.ceil(FARTHEST / h)) + TAPS

    def seen(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """As ``Filter.seen``."""
        return rate


TOGETHER = Together()

ROUNDS = 2
"""Steps towards the clock of places: one leaves some share of some ms."""


class PlacesJudge(Judge):
    """As ``Judge``, of a trial of the accelerometer and places, beside the ``rate`` (n, 3) rad/s
    that the gyro of its rows shows.
    """

    def __init__(self, trial: Trial, filters, rate: np.ndarray) -> None:
        self.rate, self.leads = rate, {}
        super().__init__(trial, filters)

    def lead(self, one) -> float:
        """By how many s places behind a filter of those that are judged are early beside
        attitudes.
        """
        self._judged(one)
        return self.leads[one]

    @cached_property
    def shown(self) -> np.ndarray:
        """What the reference shows (m, 3) in the sensor's axes, in the band."""
        trial, rows = self.trial, moving_rows(self.trial)
        x, y = (in_band(trial, v) for v in (trial.u[:, OWN[trial.kind]], trial.y))
        return x @ turned_onto(*(v[rows] - v[rows].mean(axis=0) for v in (x, y)))

    @cached_property
    def _forces(self) -> np.ndarray:
        """What the sensor shows, and what a metre of an arm along each axis adds (n, 12), in the
        world's axes.
        """
        arms = arm_forces(self._slow(self.rate), self.whole.time)
        return self._turned_by(np.column_stack([self.whole.y, *np.moveaxis(arms, 2, 0)]))

    @cached_property
    def _turns(self) -> dict[int, Rotation]:
        """From the body's axes to those that it had at the first row of a segment, by that row."""
        h, segments = self.whole.h, self.whole.segments
        turned = ((a, turned_by(self.rate[a:b], h)) for a, b in segments)
        return {a: Rotation.from_quat(q, scalar_first=True) for a, q in turned}

    def _columns(self, one) -> list[np.ndarray]:
        """A bias, the motion behind the filter and what a clock makes of it, and an arm's force
        (m, 10) of each axis: places have a clock that is theirs beside the attitudes.
        """
        world, self.leads[one] = np.array(self._forces), 0.0
        if one is not None:
            for a, b in self.whole.segments:
                world[a:b] = one.seen(world[a:b], self.whole.h, None)
        world = self._as_reference(world)
        for _ in range(0 if one == TOGETHER else ROUNDS):
            lead = self._early(world)
            self.leads[one] += lead
            world = self._led(world, lead / self.whole.h)
        return self._by_sensor(world)

    def _as_reference(self, values: np.ndarray) -> np.ndarray:
        """As ``Judge._as_reference``: of positions nothing is kept that their noise hides."""
        return self.whole.place.shown(values, self.whole.segments)

    def _by_sensor(self, world: np.ndarray) -> list[np.ndarray]:
        """The columns (m, 10) of forces (n, 12) in the world's axes, each axis's."""
        moved, *arms = np.split(self._turned_by(world, back=True), 4, axis=1)
        shared = self._with_slopes(moved)
        return [np.hstack([shared, arm]) for arm in self._by_axis(arms)]

    def _early(self, world: np.ndarray) -> float:
        """By how many s the places are early beside the attitudes, by forces (n, 12) in the world's
        axes.
        """
        late = in_band(self.trial, self._turned_by(slopes(self.whole, world[:, :3]), back=True))
        rest = []
        for i, x in enumerate(self._by_sensor(world)):
            known = np.delete(x, range(4, 7), axis=1)
            every = np.column_stack([self.shown[:, i], late[:, i], x[:, 4 + i]])
            rest.append(every - explained(known, every))
        left = np.concatenate(rest)
        # Where the body hardly moves no clock is seen, and none is made up.
        unseen = np.column_stack([np.zeros(2), left[:, 0].std() / FARTHEST * np.eye(2)])
        left = np.concatenate([left, unseen])
        return float(np.linalg.lstsq(left[:, 1:], left[:, 0])[0][0])

    def _turned_by(self, values: np.ndarray, back: bool = False) -> np.ndarray:
        """Vectors (n, 3 k) in the world's axes, or ``back`` in the body's."""
        out = np.zeros(values.shape)
        for a, b in self.whole.segments:
            for at in range(0, values.shape[1], 3):
                vector = slice(at, at + 3)
                out[a:b, vector] = self._turns[a].apply(values[a:b, vector], inverse=back)
        return out

    @cached_property
    def _taken(self) -> list[np.ndarray]:
        """What filters take away (m, 3), of each axis."""
        force = self._turned_by(self._slow(self.whole.y))
        columns = [self._turned_by(self._slope(force, t), back=True) for t in (2, 4, 6)]
        return self._by_axis(columns)
