"""One sensor of one log: its spectrum, its lines, and its channels one after the other."""

from __future__ import annotations

import itertools
from collections.abc import Container
from dataclasses import dataclass

import numpy as np

from pyimu.characterization.allan.pooled import used_segments
from pyimu.characterization.channel import LEAST, analyse_noise, compensate, fit_again
from pyimu.characterization.log_samples import Say
from pyimu.characterization.outcome import Channel, NoiseAnalysis, Overview, SensorResult
from pyimu.characterization.samples import PIECE, Samples
from pyimu.characterization.spectrum.bandwidth import Bandwidth, find_bandwidth
from pyimu.characterization.spectrum.lines import Line, find_lines, searched_range
from pyimu.characterization.spectrum.psd import Psd, SpectrumAccumulator, window_length
from pyimu.characterization.store import Store
from pyimu.characterization.temperature.fit import ThermalFit, fit_thermal
from pyimu.characterization.temperature.warm_up import WarmUp
from pyimu.errors import UserError
from pyimu.model.part import AXES
from pyimu.report.figures import BINS

MEMORY = 0.8
"""Memory of white noise through a low-pass, times the corner: at 0.8 / f_c the covariance of one of
first order, exp(-2 pi f_c t), has fallen to 0.7 %, and a moving average's is over."""

SHORT = 32
"""Samples of the correlation time below which Gauss-Markov noise may be that of a low-pass."""


@dataclass(frozen=True)
class SensorAnalysis:
    """A sensor of the log ``log``, and what its channels have in common.

    ``wrapped`` are the columns whose integers wrapped around. A roll-off is ``not_its_own`` where
    the log moves, or values between two samples were interpolated. ``level`` is the probability
    of the intervals, ``T0`` the temperature [degC] at which the bias is given, None for its mean.
    """

    log: str
    samples: Samples
    wrapped: Container[str]
    not_its_own: bool
    level: float
    T0: float | None
    store: Store
    say: Say

    def result(self) -> SensorResult:
        """The sensor characterised; a channel that cannot be says why."""
        samples = self.samples
        self.say(f"{self.log}: {samples.kind}, spectrum", None)
        spectrum = _spectrum(samples, self.say)
        lines, psd = find_lines(spectrum), spectrum.result()
        channels = tuple(
            self._channel(axis, tuple(v for v in lines if v.column == axis), psd)
            for axis in range(len(AXES))
        )
        return SensorResult(
            kind=samples.kind,
            h=samples.h,
            samples=len(samples),
            segments=len(samples.segments),
            closed=len(samples.segments) - len(samples.stretches),
            segments_used=len(used_segments(samples.stretches)),
            longest=samples.longest,
            psd=psd,
            fitted=np.column_stack([_fitted_density(c.noise, psd.frequency) for c in channels]),
            channels=channels,
            searched=searched_range(spectrum),
        )

    def _column(self, axis: int) -> str:
        return f"{self.samples.kind}_{AXES[axis]}"

    def _channel(self, axis: int, lines: tuple[Line, ...], psd: Psd) -> Channel:
        samples, reason = self.samples, self._reason(axis)
        noise, thermal, thermal_reason, warm_up = None, None, reason, None
        bandwidth = None
        if not reason:
            thermal, thermal_reason = self._thermal(axis)
            try:
                noise, warm_up = self._noise(axis, thermal, lines)
                noise, bandwidth = self._through_low_pass(axis, noise, lines, psd)
            except UserError as error:
                reason = str(error)
        return Channel(
            self._column(axis),
            np.nan if axis in samples.absent else float(np.mean(samples.columns[axis])),
            _overview(samples, axis),
            noise,
            reason,
            lines,
            thermal,
            thermal_reason,
            warm_up,
            bandwidth,
        )

    def _through_low_pass(
        self, axis: int, noise: NoiseAnalysis, lines: tuple[Line, ...], psd: Psd
    ) -> tuple[NoiseAnalysis, Bandwidth | None]:
        """The noise of a channel with what its low-pass does to it, and where that rolls off."""
        found = None if self.not_its_own else self._bandwidth(axis, noise, lines, psd)
        if found is None:
            return noise, None
        memory = MEMORY / found.frequency.value
        return fit_again(noise, self.samples, lines, self.level, memory), found

    def _bandwidth(
        self, axis: int, noise: NoiseAnalysis, lines: tuple[Line, ...], psd: Psd
    ) -> Bandwidth | None:
        """Where the noise of a channel rolls off, if it does."""
        if not len(psd.frequency):
            return None
        fit, h = noise.fit, self.samples.h
        # White noise through a low-pass of first order is Gauss-Markov noise of a short time.
        short = (g.drive * g.time for g in fit.markov if g.time < SHORT * h)
        white = 2 * (fit.estimates.get("N", 0.0) ** 2 + sum(q**2 for q in short))
        share = np.minimum(white / _fitted_density(noise, psd.frequency), 1.0)
        density = psd.density[:, axis]
        f = psd.frequency
        return find_bandwidth(f, density, psd.averages, share, lines, h, self.level)

    def _reason(self, axis: int) -> str:
        """Why a channel cannot be characterised; empty where it can."""
        samples, column = self.samples, self.samples.columns[axis]
        if axis in samples.absent:
            return samples.absent[axis]
        if samples.longest < LEAST:
            return f"{samples.longest} samples without gap are too few, at least {LEAST} are needed"
        if np.all(column == column[0]):
            return "it is constant"
        wrapped = self._column(axis) in self.wrapped
        return "its integers wrapped around, unwrap them first" if wrapped else ""

    def _thermal(self, axis: int) -> tuple[ThermalFit | None, str]:
        """The effect of temperature, or None and the reason why there is none."""
        if self.samples.averages is None:
            return None, "the log has no temperature"
        try:
            return fit_thermal(self.samples.averages, axis, self.level, self.T0), ""
        except UserError as error:
            return None, str(error)

    def _noise(
        self, axis: int, thermal: ThermalFit | None, lines: tuple[Line, ...]
    ) -> tuple[NoiseAnalysis, WarmUp | None]:
        """Noise and warm-up of a channel. Raises UserError where there is no noise."""
        label = f"{self.log}: {self._column(axis)}"
        self.say(f"{label}: temperature and warm-up", None)
        compensated, warm_up = compensate(self.samples, axis, thermal, self.store)
        noise = analyse_noise(
            self.samples,
            axis,
            compensated,
            lines,
            self.level,
            self.store,
            lambda text: self.say(f"{label}: {text}", None),
        )
        return noise, warm_up


def _spectrum(samples: Samples, say: Say) -> SpectrumAccumulator:
    spectrum, done = SpectrumAccumulator(samples.h, window_length(samples.longest)), 0
    for start, stop in samples.segments:
        for a in range(start, stop, PIECE):
            b = min(a + PIECE, stop)
            spectrum.add(np.column_stack([c[a:b] for c in samples.columns]))
            done += b - a
            say(f"{samples.kind}: spectrum", done / len(samples))
        spectrum.end_segment()
    return spectrum


def _fitted_density(noise: NoiseAnalysis | None, frequency: np.ndarray) -> np.ndarray:
    """One-sided density (m,) of the fitted noise, nan where there is none."""
    if noise is None:
        return np.full(len(frequency), np.nan)
    return 2 * noise.fit.psd_two_sided(frequency)


def _overview(samples: Samples, axis: int) -> Overview:
    edges = np.unique(np.linspace(0, len(samples), min(BINS, len(samples)) + 1).astype(int))
    column, bins = samples.columns[axis], list(itertools.pairwise(edges))
    if axis in samples.absent:
        column = np.full(len(samples), np.nan)
    low, mean, high = (
        np.array([f(column[a:b]) for a, b in bins]) for f in (np.min, np.mean, np.max)
    )
    return Overview(np.array([samples.time[(a + b) // 2] for a, b in bins]), low, mean, high)
