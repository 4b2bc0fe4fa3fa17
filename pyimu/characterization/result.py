"""What ``characterize`` found, as frozen data: by log, by sensor, by channel, and over all logs;
its form in report.json.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from pyimu.characterization.allan.moments import TERMS
from pyimu.characterization.channel import Curve, Noise
from pyimu.characterization.evidence import Evidence
from pyimu.characterization.noise.coefficients import Coefficient, mean_coefficient
from pyimu.characterization.spectrum.lines import Line
from pyimu.characterization.spectrum.psd import Psd
from pyimu.characterization.temperature.fit import NAMES, ThermalFit
from pyimu.characterization.temperature.warm_up import WarmUp
from pyimu.errors import Finding
from pyimu.files import plain
from pyimu.model.part import Part
from pyimu.shaping import flicker_floor

SI = {
    "gyro": {"Q": "rad", "N": "rad/sqrt(s)", "B": "rad/s", "K": "rad/s/sqrt(s)", "R": "rad/s^2"},
    "accel": {"Q": "m/s", "N": "m/s/sqrt(s)", "B": "m/s^2", "K": "m/s^2/sqrt(s)", "R": "m/s^3"},
}
"""SI units of the coefficients."""

SAMPLE = {"gyro": "rad/s", "accel": "m/s^2"}


@dataclass(frozen=True)
class Overview:
    """What a column looked like over time: least, mean and largest sample (m,) of stretches of
    equally many, at ``time`` (m,) s.
    """

    time: np.ndarray
    low: np.ndarray
    mean: np.ndarray
    high: np.ndarray


@dataclass(frozen=True)
class Channel:
    """One axis of a sensor in one log; ``noise`` is None, and ``reason`` says why, where it could
    not be characterised.

    ``thermal`` is None, and ``thermal_reason`` says why, where nothing could be said of
    temperature.
    """

    name: str
    mean: float
    overview: Overview
    noise: Noise | None
    reason: str
    lines: tuple[Line, ...]
    thermal: ThermalFit | None
    thermal_reason: str
    warm_up: WarmUp | None

    @property
    def taken_off(self) -> str:
        """What the noise is without: ``temperature``, ``warm-up``, both or nothing."""
        warranted = self.thermal is not None and self.thermal.warranted and self.noise is not None
        return " and ".join(
            n
            for n, there in (("temperature", warranted), ("warm-up", self.warm_up is not None))
            if there
        )

    @property
    def kind(self) -> str:
        return self.name.partition("_")[0]

    def coefficient(self, term: str) -> Coefficient | None:
        """The coefficient of a letter in SI, None where there is no fit."""
        return None if self.noise is None else self.noise.fit[term]


@dataclass(frozen=True)
class SensorResult:
    """One sensor in one log: ``h`` s, ``samples`` of it, ``stretches`` without gap and how many
    ``used`` for the deviations, one-sided ``psd``.

    ``searched`` [Hz]: from where to where lines were looked for.
    """

    kind: str
    h: float
    samples: int
    stretches: int
    used: int
    longest: int
    psd: Psd
    channels: tuple[Channel, ...]
    searched: tuple[float, float] = (math.nan, math.nan)


@dataclass(frozen=True)
class LogResult:
    """One log: its rows, its ``duration`` in s, its sensors by kind, its quality; ``evidence``
    shows a finding, by its kind and column.
    """

    name: str
    rows: int
    duration: float
    sensors: Mapping[str, SensorResult]
    findings: tuple[Finding, ...]
    evidence: Mapping[tuple[str, str], Evidence]

    @property
    def channels(self) -> Iterator[Channel]:
        return (c for s in self.sensors.values() for c in s.channels)


@dataclass(frozen=True)
class Summary:
    """A coefficient over all logs: mean with interval, or a bound; ``spread``, the logs' own
    standard deviation (nan for one log).
    """

    mean: Coefficient
    spread: float
    logs: int


@dataclass(frozen=True)
class Characterization:
    """Result of ``pyimu.characterize``: the logs, and by (channel, letter) the coefficients of
    the part that they are of.

    Coefficients are SI; N is the root of the two-sided density. Intervals hold the true value with
    the probability ``level``.
    """

    logs: tuple[LogResult, ...]
    level: float

    @cached_property
    def coefficients(self) -> dict[tuple[str, str], Summary]:
        found: dict[tuple[str, str], list[Coefficient]] = {}
        for log in self.logs:
            for channel in log.channels:
                for term in TERMS if channel.noise else "":
                    found.setdefault((channel.name, term), []).append(channel.noise.fit[term])
        return {
            key: Summary(*mean_coefficient(each, self.level), len(each))
            for key, each in found.items()
        }

    @property
    def kinds(self) -> tuple[str, ...]:
        """The sensors that at least one log holds."""
        return tuple(k for k in SI if any(k in log.sensors for log in self.logs))

    def channel(self, name: str) -> Iterator[Channel]:
        """The channel of a name in each log that has it."""
        return (c for log in self.logs for c in log.channels if c.name == name)

    @property
    def findings(self) -> tuple[Finding, ...]:
        return tuple(f for log in self.logs for f in log.findings)

    def part(self, name: str = "characterised") -> Part:
        """The part that these logs show, as ``pyimu.build`` and ``pyimu.close`` take it."""
        from pyimu.characterization.report.as_part import part_of  # which needs this module

        return part_of(self, name)

    def report(self) -> str:
        """What was found, for a terminal or a notebook."""
        from pyimu.characterization.report.words import terminal  # which needs this module

        return terminal(self)

    def as_dict(self) -> dict[str, Any]:
        """The contents of report.json.

        ``level``, the probability of the intervals; ``logs``, a list of {``name``, ``rows``,
        ``duration`` [s], ``quality`` (as in the report of ``pyimu close``), ``sensors``}; ``part``:
        {channel: {letter: coefficient + ``spread`` over the logs, null for one}}.

        ``sensors``: {``gyro`` and ``accel``: {``sample_period`` [s], ``samples``, ``stretches``,
        ``stretches_used``, ``psd``: {``frequency`` [Hz], ``density`` by channel, one-sided},
        ``lines_from`` and ``lines_to`` [Hz], between which lines were looked for, ``channels``}},
        and ``channels``: {``gyro_x`` ...: {``unit``, ``mean``, ``coefficients``, ``allan``:
        {``tau`` [s], ``deviation``, ``low``, ``high``, ``freedom``}, ``modified`` and ``hadamard``:
        {``tau``, ``deviation``}, ``fit``: {``shortest`` tau [s], ``model_error``, ``misfit``,
        ``freedom``, ``terms`` of the curve, their ``estimates`` and ``covariance``}, ``floor``:
        {``deviation``, ``tau``}, ``lines``: [{``frequency``, ``frequency_std`` and ``width`` [Hz],
        ``amplitude``, ``amplitude_std``, ``unit``, ``ratio`` to the background, ``p_value``,
        ``relation``}], ``thermal`` and its ``hysteresis`` with ``kh`` and ``width`` [K] of the
        catalogue's effect, ``warm_up``, ``reason``}}.

        A coefficient is {``value``, ``std``, ``low``, ``high``, ``unit``, ``needed``}; one that is
        not needed has the value null and the interval from 0 to its upper bound. What is not a
        number is null.
        """
        coefficients: dict[str, dict] = {}
        for (channel, term), s in self.coefficients.items():
            entry = _coefficient(s.mean, SI[channel.partition("_")[0]][term]) | {
                "spread": s.spread,
                "logs": s.logs,
            }
            coefficients.setdefault(channel, {})[term] = entry
        return plain(
            {"level": self.level, "logs": [_log(v) for v in self.logs], "part": coefficients}
        )


def floor(noise: Noise) -> tuple[float, float]:
    """The lowest Allan deviation and its cluster time, of those that at least ten clusters of the
    record made.
    """
    tau, deviation = noise.allan.tau, noise.allan.deviation
    legible = tau <= max(2 * tau[-1] / 10, tau[0])
    i = int(np.argmin(np.where(legible, deviation, np.inf)))
    return float(deviation[i]), float(tau[i])


def read_instability(noise: Noise) -> float:
    """B as it is read off the plot: the floor over 0.664 (Hidalgo 2012, table 3)."""
    return floor(noise)[0] / flicker_floor(1.0)


def _log(log: LogResult) -> dict[str, Any]:
    return {
        "name": log.name,
        "rows": log.rows,
        "duration": log.duration,
        "quality": [f.as_dict() for f in log.findings],
        "sensors": {k: _sensor(s) for k, s in log.sensors.items()},
    }


def _sensor(s: SensorResult) -> dict[str, Any]:
    density = (
        {c.name: s.psd.density[:, i] for i, c in enumerate(s.channels)}
        if len(s.psd.frequency)
        else {}
    )
    return {
        "sample_period": s.h,
        "samples": s.samples,
        "stretches": s.stretches,
        "stretches_used": s.used,
        "psd": {
            "frequency": s.psd.frequency,
            "density": density,
            "averages": s.psd.averages,
            "sides": 1,
            "unit": f"({SAMPLE[s.kind]})^2/Hz",
        },
        "lines_from": s.searched[0],
        "lines_to": s.searched[1],
        "channels": {c.name: _channel(c) for c in s.channels},
    }


def _channel(c: Channel) -> dict[str, Any]:
    out: dict[str, Any] = {
        "unit": SAMPLE[c.kind],
        "mean": c.mean,
        "reason": c.reason or None,
        "coefficients": None,
        "allan": None,
        "modified": None,
        "hadamard": None,
        "fit": None,
        "floor": None,
    }
    if c.noise is not None:
        n, fit = c.noise, c.noise.fit
        out |= {
            "coefficients": {t: _coefficient(fit[t], SI[c.kind][t]) for t in TERMS},
            "allan": _curve(n.allan)
            | {"low": n.allan.low, "high": n.allan.high, "freedom": n.allan.freedom},
            "modified": _curve(n.modified),
            "hadamard": _curve(n.hadamard),
            "as_measured": n.raw and _curve(n.raw),
            "fit": {
                "shortest": fit.shortest,
                "model_error": fit.model_error,
                "misfit": fit.fit.misfit,
                "freedom": fit.fit.freedom,
                "terms": "".join(fit.fit.estimates),
                "estimates": dict(fit.fit.estimates),
                "covariance": fit.fit.covariance,
            },
            "floor": dict(zip(("deviation", "tau"), floor(n), strict=True)),
        }
    lines = [
        {
            "frequency": v.frequency,
            "frequency_std": v.frequency_std,
            "width": v.width,
            "amplitude": v.amplitude,
            "amplitude_std": v.amplitude_std,
            "unit": SAMPLE[c.kind],
            "ratio": v.ratio,
            "p_value": v.p_value,
            "relation": v.relation.text if v.relation else None,
        }
        for v in c.lines
    ]
    warm_up = c.warm_up and {
        "amplitude": c.warm_up.amplitude,
        "std": c.warm_up.std,
        "time_constant": c.warm_up.tau,
        "p_value": c.warm_up.p_value,
        "unit": SAMPLE[c.kind],
    }
    return out | {"lines": lines, "thermal": _thermal(c), "warm_up": warm_up}


def _thermal(c: Channel) -> dict[str, Any] | None:
    t = c.thermal
    if t is None:
        return None
    h = t.hysteresis
    loop = h and {
        "opening": h.opening.value,
        "std": h.opening.std,
        "low": h.opening.low,
        "high": h.opening.high,
        "p_value": h.p_value,
        "warranted": h.warranted,
        "kh": h.kh,
        "width": h.width,
        "unit": SAMPLE[c.kind],
        "kh_unit": f"{SAMPLE[c.kind]}/K",
        "width_unit": "K",
    }
    powers = {n: "" if i == 0 else "/K" if i == 1 else f"/K^{i}" for i, n in enumerate(NAMES)}
    return {
        "order": t.order,
        "T0": t.T0,
        "unit": SAMPLE[c.kind],
        "bound": t.bound,
        "p_value": t.p_value,
        "hysteresis": loop,
        "hysteresis_reason": t.no_hysteresis,
        "coefficients": {
            n: {
                "value": v.value,
                "std": v.std,
                "low": v.low,
                "high": v.high,
                "unit": SAMPLE[c.kind] + powers[n],
            }
            for n, v in t.coefficients.items()
        },
    }


def _curve(c: Curve) -> dict[str, Any]:
    return {"tau": c.tau, "deviation": c.deviation}


def _coefficient(c: Coefficient, unit: str) -> dict[str, Any]:
    return {
        "value": c.value if c.needed else None,
        "std": c.std,
        "low": c.low,
        "high": c.high,
        "unit": unit,
        "needed": c.needed,
    }
