"""A rocker suspension: how body and wheels of a six-wheel rover lie on the ground.

On each side a rocker carries the rear wheel at its one end and at its other a bogie with the front
and the middle wheel. A differential between the rockers gives the body the mean of their
inclinations (Bickler 1989, US patent 4840394; Hacot 1998, Analysis and Traction Control of a
Rocker-Bogie Planetary Rover).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import casadi as ca


@dataclass(frozen=True)
class Rocker:
    """Lengths in m of the suspension, on level ground.

    ``front``, ``middle`` and ``rear`` are how far ahead of the rockers' axle the wheels are;
    ``track`` is between the wheels of both sides; ``axle`` and ``bogie`` are the heights of the
    rockers' axle and of the bogies' above the centres of the wheels. The bogie's axle is halfway
    between its wheels. The values are round figures of the size of the Mars Exploration Rovers; of
    its own the paper gives none.
    """

    front: float = 0.7
    middle: float = 0.0
    rear: float = -0.7
    track: float = 1.2
    axle: float = 0.3
    bogie: float = 0.1

    @property
    def wheels(self) -> tuple[tuple[float, float], ...]:
        """Places (forward, left) of the wheels: front, middle, rear of the left side, then right.

        They are those on level ground. Tilted by an angle a, a link is shorter by the share
        1 - cos(a) as seen from above, which is left out: the ground hardly differs over that.
        """
        return tuple(
            (x, y)
            for y in (self.track / 2, -self.track / 2)
            for x in (self.front, self.middle, self.rear)
        )

    @property
    def reach(self) -> float:
        """The height difference of two wheels in m below which the suspension can follow."""
        long = self.front - self.middle
        link, lean = self._link
        return min(long, link * (1 - math.sin(lean)))

    @property
    def _link(self) -> tuple[float, float]:
        """Length m and inclination rad of the line from rear wheel to bogie on level ground."""
        along = (self.front + self.middle) / 2 - self.rear
        return math.hypot(along, self.bogie), math.atan2(self.bogie, along)

    def side(self, front, middle, rear) -> tuple:
        """Inclination (nose up, rad) of a side's rocker, and height of its axle over level ground.

        The wheels' centres are ``front``, ``middle`` and ``rear`` m higher than on level ground.
        In the vertical plane of the side, two links of constant length: the bogie's sine is the
        difference of its wheels over their distance, and so is the rocker's from the rear wheel to
        the bogie's axle.
        """
        long = self.front - self.middle
        sine = (front - middle) * (1 / long)
        axle_of_bogie = (front + middle) / 2 + self.bogie * ca.sqrt(1 - sine * sine)
        link, lean = self._link
        rise = ca.asin((axle_of_bogie - rear) * (1 / link)) - lean
        return rise, rear - self.rear * ca.sin(rise) + self.axle * (ca.cos(rise) - 1)

    def pose(self, heights) -> tuple:
        """Roll and pitch rad of the body, and height m of the middle of its axle.

        ``heights`` (6,) are those of the wheels, in the order of ``wheels``. The axle runs through
        the two sides' axles, which its roll follows from; the differential makes the pitch (nose
        down) the mean of both rockers'.
        """
        left, right = (self.side(*(heights[i] for i in side)) for side in ((0, 1, 2), (3, 4, 5)))
        pitch = -(left[0] + right[0]) / 2
        roll = ca.asin((left[1] - right[1]) / (self.track * ca.cos(pitch)))
        return roll, pitch, (left[1] + right[1]) / 2
