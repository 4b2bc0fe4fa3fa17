"""The heading filter over a log: ``HeadingEstimator`` begun with what a known motion showed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.attitude.heading.estimator import heading_estimator
from pyimu.attitude.input_grid import CHUNK, InputGrid
from pyimu.attitude.outputs import advance
from pyimu.block.block import Block, Run
from pyimu.block.parameters import with_settings
from pyimu.errors import UserError
from pyimu.heading.calibration import Calibration
from pyimu.heading.motion import Z
from pyimu.model.part import Part
from pyimu.recording.recording import Recording

CALIBRATED = ("scale_factor", "turn_on_bias")
"""Effects that a calibration takes the place of."""

UNKNOWN = {"std0[2]": 0.1, "std0[3]": 0.03}
"""Standard deviations of bias [rad/s] and scale factor at the start where nothing is known: a
consumer part's zero-rate level of 5 deg/s, and its sensitivity of 3 % (MPU-6050, section 6.1)."""


@dataclass(frozen=True, eq=False)
class HeadingTrack:
    """The heading filter's estimates at the rows (n,) of a log.

    ``time`` s; ``heading`` rad with all turns in it, ``heading_std`` rad, ``bias`` and ``bias_std``
    rad/s, ``scale_factor`` and ``scale_factor_std``, ``rate`` rad/s less both, ``at_rest``,
    ``status``.
    """

    time: np.ndarray
    heading: np.ndarray
    heading_std: np.ndarray
    bias: np.ndarray
    bias_std: np.ndarray
    scale_factor: np.ndarray
    scale_factor_std: np.ndarray
    rate: np.ndarray
    at_rest: np.ndarray
    status: np.ndarray


COLUMN = {"heading": "turned"}
"""Outputs of the block that a track has by another name."""


@dataclass(frozen=True)
class HeadingFilter:
    """The Kalman filter on heading, bias and scale factor of a ``part``, for logs.

    It begins with what the ``calibration`` found and how well it knows it, to which comes
    ``slip_std``, the standard deviation of the share by which the known motion may have been
    another; a calibration without noise of its own is taken at its word. Without one, bias and
    scale factor begin at nothing with what a consumer part's data sheet leaves open. ``settings``
    are values of the block's other parameters by name.

    Raises UserError for a setting that is unknown.
    """

    part: Part
    calibration: Calibration | None = None
    slip_std: float = 0.0
    settings: Mapping[str, float] = field(default_factory=dict)

    @property
    def block(self) -> Block:
        return heading_estimator(uncalibrated(self.part) if self.calibration else self.part)

    def run(
        self, recording: Recording, heading0: float = 0.0, heading0_std: float = 0.0
    ) -> HeadingTrack:
        """The heading over a recording; one period before its first row it is ``heading0`` rad,
        known to ``heading0_std`` rad.

        Rests are those of the column ``stationary`` where the recording has one, else they are
        detected from gyro and accelerometer. Raises UserError for a recording without gyro.
        """
        if recording.gyro is None:
            raise UserError(f"{recording.name}: no gyro, a heading needs gyro_z")
        values = {"heading0": heading0, "std0[1]": heading0_std} | self._start()
        if recording.stationary is not None:
            values["rest_time"] = 0.0
        return _run(self.block, recording, self.part, values | dict(self.settings))

    def _start(self) -> dict[str, float]:
        found = self.calibration
        if found is None:
            return dict(UNKNOWN)
        covariance = np.array(found.physical_covariance)
        covariance[0, 0] += self.slip_std**2 * (1.0 + found.s) ** 2
        if found.noise is not None:
            covariance[1, 1] += found.noise[1] ** 2 * found.seconds
        std = np.sqrt(np.diag(covariance))
        both = std[0] * std[1]
        return {
            "bias0": found.b0,
            "scale_factor0": found.s,
            "std0[2]": float(std[1]),
            "std0[3]": float(std[0]),
            "correlation0": float(covariance[0, 1] / both) if both > 0 else 0.0,
        }


def uncalibrated(part: Part) -> Part:
    """The part without the effects of its gyro that a calibration takes the place of."""
    return part.with_sensor(part.gyro.without(*CALIBRATED))


def compensated(recording: Recording, part: Part) -> Recording:
    """The recording with the rate about the vertical less the part's own errors, but for those that
    a calibration finds.
    """
    if all(e.law is not None for e in uncalibrated(part).gyro.effects):
        return recording
    nothing = {f"std0[{i}]": 0.0 for i in (1, 2, 3)} | {"rest_time": 0.0}
    plain = replace(recording, stationary=None, heading=None)
    track = _run(heading_estimator(uncalibrated(part)), plain, part, nothing)
    gyro = np.array(recording.gyro)
    gyro[:, Z] = np.where(np.isfinite(gyro[:, Z]), track.rate, np.nan)
    return replace(recording, gyro=gyro)


def _run(
    block: Block, recording: Recording, part: Part, values: Mapping[str, float]
) -> HeadingTrack:
    p = with_settings(block, values, "the heading filter")
    grid = InputGrid(recording, part, [v.name for v in block.inputs])
    steps = Run(block, int(grid.rows[-1]) + 1, p=p, sample_period=recording.sample_period)
    kept = np.empty((len(recording), len(block.outputs)))
    buffer = np.empty((min(CHUNK, int(grid.rows[-1]) + 1), len(block.outputs)))
    for piece in grid.pieces():
        y = buffer[: len(piece.inputs)]
        advance(steps, piece, y)
        kept[piece.rows] = y[piece.at]
    column = {v.name: kept[:, i] for i, v in enumerate(block.outputs)}
    names = [f for f in HeadingTrack.__dataclass_fields__ if f != "time"]
    return HeadingTrack(recording.time, **{n: column[COLUMN.get(n, n)] for n in names})
