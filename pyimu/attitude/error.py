"""How far an estimated attitude is from a reference: inclination, total and heading error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from scipy.spatial.transform import Rotation

LOST = 0.5
"""rad; root mean square from which on an attitude is lost: which of two lost ones is further off is
chance."""


@dataclass(frozen=True)
class AttitudeError:
    """Error of an attitude against a reference, heading set right at the first row.

    ``time`` (m,) s; ``total`` (m,) rad, angle of the error rotation; ``heading`` (m,) rad, its part
    about the vertical; ``inclination`` (m,) rad, angle between the two verticals, in which no
    heading is; ``tilt`` (m, 2) rad, which way it goes in the reference's world. All are only at
    rows that the reference covers.
    """

    time: np.ndarray
    total: np.ndarray
    heading: np.ndarray
    inclination: np.ndarray
    tilt: np.ndarray

    @property
    def rms(self) -> float:
        return root_mean_square(self.total)

    def in_windows(self, span: float) -> AttitudeError:
        """The same with heading set right at the first row of each ``span`` s.

        A heading that nothing measures drifts with the bias, by chance: over minutes that is larger
        than what the sensors' errors make of the attitude. The rotation is that about the vertical
        and then the tilt: cos(total/2) = cos(heading/2) cos(inclination/2).
        """
        if not len(self.time):
            return self
        window = np.floor((self.time - self.time[0]) / span)
        first = np.flatnonzero(np.diff(window, prepend=-1.0))
        start = np.repeat(self.heading[first], np.diff([*first, len(window)]))
        heading = self.heading - start
        half = np.cos(heading / 2) * np.cos(self.inclination / 2)
        total = 2 * np.arccos(np.clip(np.abs(half), 0, 1))
        return replace(self, total=total, heading=heading)

    def at(self, time: np.ndarray) -> AttitudeError:
        """The rows whose times are among ``time`` (k,)."""
        rows = np.isin(self.time, time)
        each = (getattr(self, f.name)[rows] for f in fields(self))
        return AttitudeError(*each)

    def powers(self, span: float) -> np.ndarray:
        """Mean square [rad^2] in each ``span`` s (k,)."""
        window = np.floor((self.time - self.time[0]) / span) if len(self.time) else self.time
        return np.array([np.mean(self.total[window == w] ** 2) for w in np.unique(window)])

    @property
    def is_lost(self) -> bool:
        return self.rms > LOST


def error_against(time: np.ndarray, q: np.ndarray, reference: Rotation) -> AttitudeError:
    """The error of the attitudes ``q`` (m, 4) at ``time`` (m,) against as many of a reference."""
    if not len(time):
        return AttitudeError(*(np.zeros(0),) * 4, np.zeros((0, 2)))
    error = Rotation.from_quat(q, scalar_first=True) * reference.inv()
    error = Rotation.from_euler("z", -error[0].as_euler("ZYX")[0]) * error
    up = np.array([0.0, 0.0, 1.0])
    seen = error.apply(up)
    inclination = angle_between(seen, up)
    level = np.maximum(np.hypot(*seen.T[:2]), 1e-300)
    return AttitudeError(
        time,
        error.magnitude(),
        np.unwrap(error.as_euler("ZYX")[:, 0]),
        inclination,
        seen[:, :2] * (inclination / level)[:, None],
    )


def angle_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Angle (n,) in rad between unit vectors (n, 3), exact for small ones too."""
    return 2 * np.arcsin(np.minimum(1, np.linalg.norm(a - b, axis=-1) / 2))


def root_mean_square(values: Sequence[float] | np.ndarray) -> float:
    """NaN of no values."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else float("nan")
