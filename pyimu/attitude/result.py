"""The result of ``pyimu.attitude.run``: what the filter estimated, and what can be done with it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.rest import Rest
from pyimu.attitude.variables import STATUS
from pyimu.recording.formats.suffix import write_table

FILE = "attitude.parquet"
"""What ``AttitudeResult.write`` makes."""


@dataclass(frozen=True, eq=False)
class AttitudeResult:
    """What the filter estimated, a row for each of the recording's.

    ``time`` (n,) s; ``q`` (n, 4), body to world, scalar first; ``gyro_bias`` (n, 3) rad/s; ``std``
    (n, 6), of the attitude error in body axes in rad and of the bias in rad/s; ``quasi_static``
    (n,) bool; ``nis`` (n,) the normalised innovation squared of gravity, 0 without its update;
    ``status`` (n,) int, bits of ``pyimu.attitude.STATUS``. ``rest`` is the rest at the start.
    ``parameters`` are the values by name with which the block ``AttitudeUkf`` gives the same.
    """

    name: str
    time: np.ndarray
    q: np.ndarray = field(repr=False)
    gyro_bias: np.ndarray = field(repr=False)
    std: np.ndarray = field(repr=False)
    quasi_static: np.ndarray = field(repr=False)
    nis: np.ndarray = field(repr=False)
    status: np.ndarray = field(repr=False)
    rest: Rest | None = None
    parameters: Mapping[str, float] = field(default_factory=dict, repr=False)

    @property
    def euler(self) -> np.ndarray:
        """Roll, pitch, yaw (n, 3) in rad."""
        return Rotation.from_quat(self.q, scalar_first=True).as_euler("ZYX")[:, ::-1]

    def report(self) -> str:
        """A few lines for a terminal or a notebook."""
        duration = self.time[-1] - self.time[0]
        at_rest = self.rest is not None and self.rest.seen
        start = f"{self.rest.duration:.1f} s at rest" if at_rest else "in motion"
        return "\n".join(
            [
                f"{self.name}: {len(self.time)} samples, {duration:.1f} s, starts {start}",
                *self._last(),
                self._updates(),
                *self._events(),
            ]
        )

    __str__ = report

    def _last(self) -> list[str]:
        """The last attitude and the last bias."""
        roll, pitch, yaw = np.degrees(self.euler[-1])
        std, bias_std = np.split(np.degrees(self.std[-1]), [3])
        bias = zip(np.degrees(self.gyro_bias[-1]), bias_std, strict=True)
        angles = f"roll {roll:.2f}, pitch {pitch:.2f}, yaw {yaw:.2f} deg"
        stds = ", ".join(f"{s:.2f}" for s in std)
        return [
            f"  last attitude   {angles}; std {stds} deg (body x, y, z)",
            f"  last gyro bias  {', '.join(f'{b:.4f} +- {s:.4f}' for b, s in bias)} deg/s",
        ]

    def _updates(self) -> str:
        """How often gravity was used, and how well it fitted."""
        line = f"  quasi-static    {np.mean(self.quasi_static):.1%} of the samples"
        updated = self.nis[self.nis > 0]
        if not len(updated):
            return line
        return (
            f"{line}, mean NIS {updated.mean():.3g} (3 degrees of freedom, if accelerations are as "
            "accel_std)"
        )

    def _events(self) -> list[str]:
        """What the status told, and how often."""
        counts = {bit: int(np.sum(self.status & bit > 0)) for bit in STATUS}
        return [
            f"  status {bit}        {count} samples: {STATUS[bit]}"
            for bit, count in counts.items()
            if count
        ]

    def write(self, out: str | os.PathLike) -> Path:
        """Write ``attitude.parquet`` into the folder ``out``, whole or not at all; gives its path.

        A row is a sample; the columns are named with their units as in a recording: ``time [s]``,
        ``q_w [1]``, ``gyro_bias_x [rad/s]``, ``std_1 [rad]``, ``nis [1]`` and so on. Raises
        UserError where the folder cannot be written.
        """
        path = Path(out) / FILE
        write_table(path, self._table())
        return path

    def _table(self) -> dict[str, np.ndarray]:
        groups = {
            "q_{} [1]": ("wxyz", self.q),
            "gyro_bias_{} [rad/s]": ("xyz", self.gyro_bias),
            "std_{} [rad]": ("123", self.std[:, :3]),
            "std_{} [rad/s]": ("456", self.std[:, 3:]),
        }
        table = {"time [s]": self.time}
        for title, (names, values) in groups.items():
            table |= {title.format(n): column for n, column in zip(names, values.T, strict=True)}
        return table | {
            "quasi_static [1]": self.quasi_static,
            "nis [1]": self.nis,
            "status [1]": self.status,
        }
