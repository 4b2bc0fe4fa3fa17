"""What ``characterize`` found, as frozen data: by log, by sensor, by channel, and over all logs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pyimu.characterization.allan.readings import Floor
from pyimu.characterization.evidence import Evidence
from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.characterization.noise.fit import ChannelFit
from pyimu.characterization.spectrum.bandwidth import Bandwidth
from pyimu.characterization.spectrum.lines import Line
from pyimu.characterization.spectrum.psd import Psd
from pyimu.characterization.temperature.fit import ThermalFit
from pyimu.characterization.temperature.warm_up import WarmUp
from pyimu.display.brief import Brief
from pyimu.errors import Finding
from pyimu.model.part import AXES, Part
from pyimu.recording.quality.false_force import false_force

if TYPE_CHECKING:
    from pyimu.characterization.magnetometer.estimate import MagnetometerFit

SI = {
    "gyro": {"Q": "rad", "N": "rad/sqrt(s)", "B": "rad/s", "K": "rad/s/sqrt(s)", "R": "rad/s^2"},
    "accel": {"Q": "m/s", "N": "m/s/sqrt(s)", "B": "m/s^2", "K": "m/s^2/sqrt(s)", "R": "m/s^3"},
}
"""SI units of the coefficients, by sensor and letter."""

SAMPLE = {"gyro": "rad/s", "accel": "m/s^2"}
"""SI units of the samples."""


@dataclass(frozen=True)
class Curve:
    """Deviations (t,) in the unit of the samples at cluster times ``tau`` (t,) s."""

    tau: np.ndarray
    deviation: np.ndarray


@dataclass(frozen=True)
class AllanCurve(Curve):
    """Overlapping Allan deviations with the limits ``low`` and ``high`` (t,) of the true ones.

    ``freedom`` (t,) are the equivalent degrees of freedom.
    """

    freedom: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass(frozen=True, repr=False)
class NoiseAnalysis(Brief):
    """The noise of a channel: its deviations, and the coefficients fitted to them.

    The effect of temperature and warm-up has been removed from the samples; ``as_measured`` is
    their Allan deviation before that, None where there was none. At the cluster times of ``allan``,
    ``fitted`` (t,) is the Allan deviation of the fit, nan where it was not fitted, and ``terms``
    are those (t,) of each of its terms by itself, by letter.
    """

    allan: AllanCurve
    modified: Curve
    hadamard: Curve
    as_measured: Curve | None
    fit: ChannelFit
    fitted: np.ndarray
    terms: Mapping[str, np.ndarray]
    floor: Floor


@dataclass(frozen=True)
class Overview:
    """A column over time, in bins of equally many samples.

    ``low``, ``mean`` and ``high`` (m,) are the least, the mean and the largest sample of a bin,
    ``time`` (m,) is that of its middle in s.
    """

    time: np.ndarray
    low: np.ndarray
    mean: np.ndarray
    high: np.ndarray


@dataclass(frozen=True, repr=False)
class Channel(Brief):
    """One axis of a sensor in one log.

    ``noise`` is None, and ``reason`` says why, where it could not be characterised; ``thermal`` is
    None, and ``thermal_reason`` says why, where nothing could be said of temperature. ``bandwidth``
    is None where the spectrum does not roll off.
    """

    name: str
    mean: float
    overview: Overview
    noise: NoiseAnalysis | None
    reason: str
    lines: tuple[Line, ...]
    thermal: ThermalFit | None
    thermal_reason: str
    warm_up: WarmUp | None
    bandwidth: Bandwidth | None = None

    @property
    def kind(self) -> str:
        """``gyro`` or ``accel``."""
        return self.name.partition("_")[0]

    @property
    def axis(self) -> str:
        """``x``, ``y`` or ``z``."""
        return self.name[-1]

    @property
    def compensated_for(self) -> str:
        """What was removed before the noise: ``temperature``, ``warm-up``, both or nothing."""
        warranted = self.thermal is not None and self.thermal.warranted and self.noise is not None
        return " and ".join(
            n
            for n, there in (("temperature", warranted), ("warm-up", self.warm_up is not None))
            if there
        )

    def coefficient(self, term: str) -> Coefficient | None:
        """The coefficient of a letter in SI, None where there is no fit."""
        return None if self.noise is None else self.noise.fit[term]


@dataclass(frozen=True, repr=False)
class SensorResult(Brief):
    """One sensor in one log.

    It has so many ``samples`` every ``h`` s, in ``segments`` without gap. Of the gaps ``closed``
    are so short that what is left counts as one stretch, the longest of ``longest`` samples;
    deviations are made of ``segments_used`` stretches. ``psd`` is one-sided, and so is ``fitted``
    (m, 3), the density of the fitted noise at its frequencies, nan for a channel without. Lines
    were searched between the frequencies ``searched`` [Hz].
    """

    kind: str
    h: float
    samples: int
    segments: int
    closed: int
    segments_used: int
    longest: int
    psd: Psd
    fitted: np.ndarray
    channels: tuple[Channel, ...]
    searched: tuple[float, float] = (math.nan, math.nan)


@dataclass(frozen=True, repr=False)
class LogResult(Brief):
    """One log: its rows, its ``duration`` [s], its sensors by kind, and its quality.

    ``evidence`` has what illustrates a finding, by its kind and column. ``magnetometer`` is what
    the log shows of its magnetometer's calibration; it is None, and ``magnetometer_reason`` says
    why, where it does not, and that is empty where the log does not turn or has none.
    """

    name: str
    rows: int
    duration: float
    sensors: Mapping[str, SensorResult]
    findings: tuple[Finding, ...]
    evidence: Mapping[tuple[str, str], Evidence]
    magnetometer: MagnetometerFit | None = None
    magnetometer_reason: str = ""

    @property
    def channels(self) -> Iterator[Channel]:
        """The channels of all sensors."""
        return (c for s in self.sensors.values() for c in s.channels)

    @property
    def moves(self) -> bool:
        """Whether the log is not at rest; of raw counts, which look like motion, nobody knows."""
        return {"motion"} == {f.kind for f in self.findings} & {"motion", "counts"}


@dataclass(frozen=True)
class Summary:
    """A coefficient over all logs: its mean with interval, or a bound.

    ``spread`` is the standard deviation of the logs, nan for one log.
    """

    mean: Coefficient
    spread: float
    logs: int


@dataclass(frozen=True)
class Outcome:
    """What ``characterize`` found: the logs, and the coefficients of the part that they are of.

    ``coefficients`` are by (channel, letter), in SI; N is the root of the two-sided density.
    Intervals hold the true value with the probability ``level``. ``part_given`` is the part, as its
    data sheet has it, that they are shown beside.
    """

    logs: tuple[LogResult, ...]
    level: float
    coefficients: Mapping[tuple[str, str], Summary]
    part_given: Part | None = None

    @property
    def kinds(self) -> tuple[str, ...]:
        """The sensors that at least one log holds."""
        return tuple(k for k in SI if any(k in log.sensors for log in self.logs))

    @property
    def magnetometer(self) -> MagnetometerFit | None:
        """The calibration of the log that knows the direction of a field best; None without one."""
        found = [log.magnetometer for log in self.logs if log.magnetometer is not None]
        return min(found, key=lambda f: f.direction_std, default=None)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings of all logs."""
        return tuple(f for log in self.logs for f in log.findings)

    @property
    def moving(self) -> tuple[str, ...]:
        """Names of the logs that do not rest, of which no part can be made; raw counts apart."""
        return tuple(log.name for log in self.logs if log.moves)

    @property
    def in_counts(self) -> tuple[str, ...]:
        """Names of the logs that hold raw counts in a false unit, in which their part would be."""
        return tuple(v.name for v in self.logs if any(f.kind == "counts" for f in v.findings))

    @property
    def in_false_unit(self) -> Mapping[str, Finding]:
        """Names of the logs whose forces have another unit than is stated, with the finding."""
        found = {log.name: false_force(log.findings) for log in self.logs}
        return {name: finding for name, finding in found.items() if finding is not None}

    @property
    def no_part(self) -> str:
        """Why no part can be made of the logs; empty where one can."""
        if self.moving:
            return "the log moves"
        if self.in_counts:
            return "the log holds raw counts"
        return "the log's forces have another unit than is stated" if self.in_false_unit else ""

    def markov(self, name: str) -> tuple[tuple[float, float], ...]:
        """Gauss-Markov noise of a channel over the logs, slowest first.

        Standard deviations in the unit of the samples and correlation times [s]: root mean squares
        and geometric means of the logs that have it, where these are at least half.
        """
        each = [ch.noise.fit.markov for ch in self.channel(name) if ch.noise]
        found = []
        for k in range(max(map(len, each), default=0)):
            own = [g[k] for g in each if len(g) > k and g[k].sigma.needed]
            if own and 2 * len(own) >= len(each):
                sigma = math.sqrt(sum(g.sigma.value**2 for g in own) / len(own))
                found.append((sigma, math.exp(sum(math.log(g.time) for g in own) / len(own))))
        return tuple(found)

    def floors(self, kind: str) -> list[list[Floor]]:
        """The lowest Allan deviations of each axis of a sensor, one for each log that has it."""
        names = (f"{kind}_{axis}" for axis in AXES)
        return [[ch.noise.floor for ch in self.channel(n) if ch.noise] for n in names]

    def channel(self, name: str) -> Iterator[Channel]:
        """The channel of a name in each log that has it."""
        return (c for log in self.logs for c in log.channels if c.name == name)
