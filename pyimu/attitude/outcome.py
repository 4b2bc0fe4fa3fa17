"""What the attitude filter estimated over a recording, as frozen data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.contradicted import contradicted
from pyimu.attitude.error import AttitudeError, error_against
from pyimu.attitude.even_turns import turn_findings
from pyimu.attitude.filter.status import STATUS
from pyimu.attitude.filters import OWN
from pyimu.attitude.magnetometer import Magnetometer
from pyimu.attitude.reference_reading import reference_findings
from pyimu.attitude.rest import Rest, gravity_findings
from pyimu.errors import Finding
from pyimu.numerics.laws import chi2
from pyimu.recording.quality.false_force import FALSE_FORCE, false_force
from pyimu.recording.quality.in_pieces import quality
from pyimu.recording.recording import Recording

NIS_BOUNDS = tuple(float(v) for v in chi2.ppf([0.025, 0.975], 3))
"""Between which 95 % of the normalised innovations squared of gravity lie, chi-squared of 3 degrees
of freedom."""


DISTURBED = 256
"""The bit of ``STATUS`` of a disturbed magnetic field."""


@dataclass(frozen=True)
class Event:
    """A bit of the status: in how many ``samples`` it was set, first and last at so many s."""

    bit: int
    samples: int
    first: float
    last: float

    @property
    def text(self) -> str:
        return STATUS[self.bit]


@dataclass(frozen=True, eq=False)
class Outcome:
    """What the filter estimated, a row for each of the recording's.

    ``time`` (n,) s; ``q`` (n, 4), body to world, scalar first; ``gyro_bias`` (n, 3) rad/s; ``std``
    (n, 6), of the attitude error in body axes in rad and of the bias in rad/s; ``quasi_static``
    (n,) bool; ``nis`` (n,) the normalised innovation squared of gravity, 0 without its update;
    ``status`` (n,) int, bits of ``pyimu.attitude.STATUS``; ``heading_std`` (n,) rad, of the
    attitude error about the vertical; ``at_rest`` (n,) bool. ``rest`` is the rest at the start.
    ``parameters`` are the values by name with which the filter's block gives the same. ``part`` is
    the name of the part, empty without one; ``left_in`` what of its errors is not undone;
    ``method`` the name of the filter (``pyimu.attitude.filters``). ``magnetometer`` says whether
    one was used, and what speaks against it. ``recording`` is what the filter ran over, ``of_part``
    what of it contradicts the part, ``of_heading`` what was found of its headings: a lag,
    which was undone, and what contradicts the magnetometer.

    Where it is ``smoothed``, ``q``, ``gyro_bias``, ``std`` and ``heading_std`` are by all rows, not
    only by those up to each. ``quasi_static``, ``nis``, ``status`` and ``at_rest`` stay what the
    filter found on its way: of a status that says that gravity or a heading contradicted, the
    attitude before knows nothing.
    """

    name: str
    time: np.ndarray
    q: np.ndarray = field(repr=False)
    gyro_bias: np.ndarray = field(repr=False)
    std: np.ndarray = field(repr=False)
    quasi_static: np.ndarray = field(repr=False)
    nis: np.ndarray = field(repr=False)
    status: np.ndarray = field(repr=False)
    heading_std: np.ndarray = field(repr=False)
    at_rest: np.ndarray = field(repr=False)
    recording: Recording = field(repr=False)
    rest: Rest | None = None
    parameters: Mapping[str, float] = field(default_factory=dict, repr=False)
    part: str = ""
    magnetometer: Magnetometer = Magnetometer()
    left_in: tuple[str, ...] = ()
    method: str = OWN
    smoothed: bool = False
    of_part: tuple[Finding, ...] = ()
    of_heading: tuple[Finding, ...] = ()

    @property
    def euler(self) -> np.ndarray:
        """Roll, pitch, yaw (n, 3) in rad."""
        return Rotation.from_quat(self.q, scalar_first=True).as_euler("ZYX")[:, ::-1]

    @property
    def tilt_std(self) -> np.ndarray:
        """Standard deviation (n,) in rad of the attitude error about a horizontal axis.

        It is the root mean square of two at a right angle: the sum of the variances about three
        axes is that about any other three.
        """
        whole = np.sum(self.std[:, :3] ** 2, axis=1)
        return np.sqrt(np.maximum(whole - self.heading_std**2, 0) / 2)

    @property
    def duration(self) -> float:
        """s."""
        return float(self.time[-1] - self.time[0])

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """What reading the recording found, and what its samples show."""
        found = (*quality(self.recording), *self.of_part, *self.of_heading)
        if false_force(found) is None:
            found += gravity_findings(self.rest)
        # What was not refused is gravity as the settings say.
        found = tuple(f for f in found if f.kind not in FALSE_FORCE)
        found = (
            *found,
            *turn_findings(self.rest),
            *self.magnetometer.findings,
            *contradicted(self.recording),
        )
        rows = self._referenced
        if not len(rows):
            return found
        reference = self.recording.ref_q[rows]
        return (*found, *reference_findings(self.time[rows], self.q[rows], reference))

    @property
    def disturbed(self) -> float:
        """Share of the samples in which the magnetic field was disturbed."""
        return float(np.mean(self.status & DISTURBED > 0))

    @cached_property
    def error(self) -> AttitudeError | None:
        """The error against the recording's ``ref_q``, None without one.

        The reference's body axes are taken for the sensor's.
        """
        rows = self._referenced
        if not len(rows):
            return None
        reference = Rotation.from_quat(self.recording.ref_q[rows], scalar_first=True)
        return error_against(self.time[rows], self.q[rows], reference)

    @property
    def _referenced(self) -> np.ndarray:
        """The rows (m,) with a reference attitude."""
        if self.recording.ref_q is None:
            return np.zeros(0, dtype=int)
        return np.flatnonzero(np.isfinite(self.recording.ref_q).all(axis=1))

    @property
    def updates(self) -> np.ndarray:
        """Rows (n,) with a normalised innovation squared."""
        return self.nis > 0

    @property
    def events(self) -> list[Event]:
        """The bits of the status that were set, and when."""
        found = []
        for bit in STATUS:
            rows = np.flatnonzero(self.status & bit)
            if len(rows):
                first, last = self.time[rows[[0, -1]]]
                found.append(Event(bit, len(rows), float(first), float(last)))
        return found
