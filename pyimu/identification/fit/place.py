"""Where the force of a reference acts: the point that it tracks is not the sensor's, gravity there
is known to some thousandths, and attitude and positions may count from another heading. How large
it is: the metres of positions are those of whoever calibrated the cameras, or guessed. And when: a
filter that was taken out of positions is known as far as the sensor showed it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.recording.reference.filters import below_hz
from pyimu.recording.reference.force import arm_forces

FAR = 10.0
"""m; standard deviation of how far along an axis a sensor may be from the point that a reference
tracks: within a vehicle, anywhere."""

HEADED = 0.05
"""rad; standard deviation of the heading of attitudes against positions, once it is about found."""

SCALED = 0.03
"""Standard deviation of the scale of positions: a camera's odometry has it by some percent, a rig
of cameras by how well the length was known that calibrated it, a satellite receiver not at all."""

GRAVITY, HEADING, SCALE, STILL_LATE, STILL_SMOOTH, UNKNOWN = 3, 4, 5, 6, 7, 8
"""The numbers of gravity, heading, the scale of positions, and what is left of a filter among the
unknowns, behind the arm's three axes, and how many they are."""

NOWHERE = np.zeros(UNKNOWN)
"""The point that is tracked, the gravity that was added, heading, scale and filter as they are."""


def verticals(attitude: np.ndarray) -> np.ndarray:
    """The vertical (n, 3) in the axes of bodies with attitudes (n, 4); zero where one is."""
    known, up = np.any(attitude != 0.0, axis=1), np.zeros((len(attitude), 3))
    body = Rotation.from_quat(attitude[known], scalar_first=True)
    up[known] = body.apply([0.0, 0.0, 1.0], inverse=True)
    return up


@dataclass(frozen=True, eq=False)
class Place:
    """What is not known of where a reference force acts: the arm (3,) m from its point to the
    sensor, and, unless ``gravity_std`` is zero, ``gravity`` to so many m/s^2 and the heading of the
    positions' world in that of the attitudes; by which share, to ``scale_std``, the body's way is
    longer than the positions'; and, where a filter of a ``size`` in s was taken out of the
    positions, or a delay of theirs, by how much they are still late [s], and half the variance in
    time over which they are still smoothed [s^2].

    ``forces`` (8, 3, n) is what a metre along each axis of the arm, a m/s^2 of gravity, a radian of
    heading, the whole of the positions' scale, a second, and a s^2 add to the reference force in
    its own body axes, ``time`` (n,) s when; ``across`` (n, 3) is the horizontal force that moves
    the body, less its gravity. The force has nothing above ``cutoff`` Hz, and of what was
    differentiated nothing above ``shown_hz``.
    """

    gravity: float
    gravity_std: float
    forces: np.ndarray
    across: np.ndarray
    time: np.ndarray
    cutoff: float = np.inf
    shown_hz: float = np.inf
    size: float = 0.0
    scale_std: float = 0.0

    @classmethod
    def of(
        cls,
        u: np.ndarray,
        time: np.ndarray,
        gravity: float = 0.0,
        gravity_std: float = 0.0,
        shown_hz: float = np.inf,
        scale_std: float = 0.0,
    ) -> Place:
        """By inputs (n, N_INPUT) that have the reference force, the body's rate and attitude."""
        # What stays zero is never written to, so that it takes no memory.
        forces, across = np.zeros((UNKNOWN, 3, len(u))), np.zeros((len(u), 3))
        forces[:GRAVITY] = arm_forces(u[:, COLUMNS["rate"]], time).transpose(2, 1, 0)
        q = u[:, COLUMNS["attitude"]]
        known = np.any(q != 0.0, axis=1)
        if gravity_std and known.any():
            up = verticals(q)
            force = u[known, OWN["accel"]]
            across[known] = force - np.sum(force * up[known], axis=1)[:, None] * up[known]
            forces[GRAVITY], forces[HEADING] = up.T, np.cross(up, across).T
            forces[SCALE][:, known] = (force - gravity * up[known]).T
        known_to = {"shown_hz": shown_hz, "scale_std": scale_std}
        return cls(gravity, gravity_std, forces, across, time, **known_to)

    def by(self, u: np.ndarray) -> Place:
        """The same beside other inputs (n, N_INPUT)."""
        known = self.gravity, self.gravity_std, self.shown_hz, self.scale_std
        made = replace(Place.of(u, self.time, *known), cutoff=self.cutoff, size=self.size)
        if self.size:
            made.forces[STILL_LATE:] = self.forces[STILL_LATE:]
        return made

    def scattered(self, noise: np.ndarray) -> Place:
        """The same with a ``noise`` (n, 3) m/s^2 more in the positions' share of the force."""
        if not self.scale_std:
            return self
        forces = np.array(self.forces)
        forces[SCALE] += noise.T
        return replace(self, forces=forces)

    def part(self, start: int, stop: int) -> Place:
        rows = slice(start, stop)
        return replace(
            self, forces=self.forces[..., rows], across=self.across[rows], time=self.time[rows]
        )

    def headed(self, angle: float) -> np.ndarray:
        """What a turn of the positions' world by an ``angle`` rad about the vertical adds to the
        reference force (n, 3).
        """
        return (np.cos(angle) - 1.0) * self.across + np.sin(angle) * self.forces[HEADING].T

    def below(self, values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
        """What values (n, k) have below the cutoff, in each of the ``segments``."""
        return below_hz(values, segments, float(np.median(np.diff(self.time))), self.cutoff)

    def shown(self, values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
        """What of values (n, k) in the world's axes positions or velocities show."""
        return replace(self, cutoff=self.shown_hz).below(values, segments)

    def as_the_force(self, values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
        """What is left of values (n, k) that were differentiated once they have gone through all
        that the force has, before it was looked up and since.
        """
        return self.below(self.shown(values, segments), segments)

    @property
    def std(self) -> np.ndarray:
        """Standard deviations (8,) of the unknowns before anything is seen."""
        headed = HEADED if self.gravity_std else 0.0
        of_filter = self.size, self.size**2
        return np.array([FAR, FAR, FAR, self.gravity_std, headed, self.scale_std, *of_filter])

    @cached_property
    def unknown(self) -> tuple[int, ...]:
        """Which of them are to be found."""
        return tuple(int(k) for k in np.flatnonzero(self.std))

    @property
    def where(self) -> tuple[int, ...]:
        """Those of them that say where the force acts, not how large it is, nor when."""
        return tuple(k for k in self.unknown if k < SCALE)

    @cached_property
    def slopes(self) -> np.ndarray:
        """The rates of change (8, 3, n) of the forces that are to be found, zero of others."""
        out = np.zeros(self.forces.shape)
        for k in self.unknown:
            out[k] = np.gradient(self.forces[k], self.time, axis=1)
        return out
