"""A recording as the attitude filter takes it, and what is known of its sensors."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace

import numpy as np

from pyimu.attitude.beyond_range import beyond_range
from pyimu.attitude.bridged import bridged
from pyimu.attitude.calibration import (
    MagnetometerCalibration,
    calibrated,
    calibration_of,
    of_sensor,
)
from pyimu.attitude.columns import informed, nominal_part
from pyimu.attitude.contradicted import believed
from pyimu.attitude.even_turns import with_later_rests
from pyimu.attitude.magnetometer import Magnetometer, magnetometer_of
from pyimu.attitude.rest import Rest, find_rest
from pyimu.errors import Finding, UserError
from pyimu.model.part import Part
from pyimu.model.part_file import part as part_of
from pyimu.recording.quality.inspect import rate_of_part
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class Prepared:
    """A ``recording`` without what contradicts its gyro, its samples mended, its field calibrated.

    ``as_given`` is the recording as it was. Of the rows ``between`` (m,) samples were missing;
    ``lost_rate_std`` rad/s is how well the rates beyond the gyro's range are known, 0 where none
    were drawn. ``declared`` is the part that was given, ``known`` what is known of the sensors;
    ``field`` is how the magnetometer is used.
    """

    as_given: Recording
    recording: Recording
    between: np.ndarray
    rest: Rest
    declared: Part | None
    known: Part
    lost_rate_std: float
    field: Magnetometer

    @classmethod
    def of(
        cls,
        recording: Recording,
        part: Part | str | os.PathLike | None,
        magnetometer: bool | MagnetometerCalibration | str | os.PathLike,
        own: bool,
        gravity: float,
    ) -> Prepared:
        """As ``pyimu.attitude.run`` is given them; ``own`` says that the filter is this package's,
        which alone takes a magnetometer. ``gravity`` is in m/s^2, 0 where it is not known.

        Raises UserError for a recording without gyro or with one row, a part or a calibration that
        cannot be read.
        """
        as_given = _with_gyro(recording)
        rest = find_rest(recording, gravity or STANDARD_GRAVITY)
        declared = None if part is None else part_of(part)
        calibration = calibration_of(magnetometer)
        recording, between = bridged(recording, rest, declared)
        rest = with_later_rests(rest, recording)
        recording = believed(recording)
        if calibration is None and declared is not None and bool(magnetometer):
            calibration = None if recording.mag is None else of_sensor(declared.mag)
        if calibration is not None:
            recording = calibrated(recording, calibration)
        wanted = calibration is not None or bool(magnetometer)
        field = replace(magnetometer_of(recording, wanted and own), calibration=calibration)
        if declared is None:
            known = nominal_part(recording, rest)
        else:
            known = informed(declared, recording, rest)
        recording, beyond = beyond_range(recording, known)
        return cls(as_given, recording, between, rest, declared, known, beyond, field)

    @property
    def of_part(self) -> tuple[Finding, ...]:
        """What contradicts the part that was given."""
        if self.declared is None:
            return ()
        return tuple(rate_of_part(self.as_given, self.declared.sample_rate))


def _with_gyro(recording: Recording) -> Recording:
    """The recording. Raises UserError where it has no gyro, or one row."""
    if recording.gyro is None:
        raise UserError(f"{recording.name}: no gyro, an attitude needs gyro_x, gyro_y, gyro_z")
    if len(recording.time) < 2:
        raise UserError(f"{recording.name}: one sample, an attitude over time needs two or more")
    return recording
