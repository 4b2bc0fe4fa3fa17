r"""Spectral lines: sines in a record's noise, with standard errors and significance.

Each bin of each level of the spectrum of ``psd`` is compared with the local ``background``. The
significance of a line is that of its highest bin times the number of bins searched in all columns
(Bonferroni; neighbouring bins are correlated, so that noise without lines gives false alarms
somewhat more rarely than asked for). A strong line hides the bins that it leaks into: those to
which it adds much of the scatter of the noise are not searched again.

Lines are looked for from bin ``LOWEST`` of the longest windows on, where slow drifts end, to three
bins below half the sample rate; broad ones not so far up, because a density may fall to zero there.
A resonance is a broad line, too: nothing in a spectrum tells it from a disturbance.

Frequencies are those in the record, in which one above half the sample rate has been folded.
``relations`` says how the lines are related to each other. Noise in bursts has bins that depend on
each other, and may look like lines.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import minimum_filter1d, uniform_filter1d

from pyimu.characterization.spectrum.background import Background, Scale, background, scales
from pyimu.characterization.spectrum.line_fit import Fitted, fit_line
from pyimu.characterization.spectrum.psd import Level, SpectrumAccumulator
from pyimu.characterization.spectrum.relations import Relation, relations

LOWEST = 16
"""The lowest bin that is searched on the lowest level."""

MOST = 100
"""The most lines of one column that are listed."""

HIDDEN = 0.1
"""A bin is hidden where a line leaks into it this share of the scatter of its noise."""

PROMINENT = 1.5
"""A band of noise is called a line where its density is so many times that of the curve beneath
it: the density of noise need not be smooth."""

SPREAD = 3.0
"""Standard deviations of a bin, exceeded by every line that is significant among thousands of
bins."""

SIDE = 17
"""Groups on either side of a band, its own included, within which its density has to fall."""


@dataclass(frozen=True)
class Line:
    """One line of one ``column``.

    ``frequency`` [Hz] and ``amplitude`` (the peak of the sine, in the samples' unit) have standard
    errors; ``p_value`` is that of the whole search. ``ratio`` is that of the density at the highest
    bin to ``background``, the one-sided density beneath it. ``width`` [Hz] is the standard
    deviation of its frequency, zero where it is as sharp as the window.
    """

    column: int
    frequency: float
    frequency_std: float
    amplitude: float
    amplitude_std: float
    p_value: float
    ratio: float
    background: float
    width: float
    relation: Relation | None = None

    @property
    def rms(self) -> float:
        """Root mean square of the line, in the samples' unit."""
        return self.amplitude / np.sqrt(2)


def find_lines(spectrum: SpectrumAccumulator, false_alarm: float = 1e-3) -> list[Line]:
    """Lines of all columns, by column and frequency.

    ``false_alarm`` is the probability of finding any in stationary noise without lines. Raises
    ValueError where it is not between 0 and 1.
    """
    if not 0 < false_alarm < 1:
        raise ValueError(f"the probability {false_alarm} is not between 0 and 1")
    levels = spectrum.levels()
    columns = [_column(levels, c) for c in range(levels[0].density.shape[1] if levels else 0)]
    family = sum(int(view.scale.searched.sum()) for views in columns for view in views)
    found = []
    for c, views in enumerate(columns):
        own = _of_column(views, c, false_alarm, family)
        found += [
            replace(line, relation=r)
            for line, r in zip(own, relations(own, 1 / spectrum.h), strict=True)
        ]
    return found


def searched_range(spectrum: SpectrumAccumulator) -> tuple[float, float]:
    """Lowest and highest frequency [Hz] of the search; nan where there is no spectrum."""
    levels = spectrum.levels()
    looked = [
        s.frequency[s.searched]
        for i, a in enumerate(levels)
        for s in scales(a, 0, LOWEST if i == len(levels) - 1 else 0)
    ]
    found = [f for f in looked if len(f)]
    return (
        (float(min(f[0] for f in found)), float(max(f[-1] for f in found)))
        if found
        else (np.nan, np.nan)
    )


@dataclass
class _View:
    """One scale of one level in the search: its background, and how far each group stands out.

    ``chance`` (m,) is the probability that noise alone makes a group as high; it is one for groups
    that are not, or no longer, searched. ``height`` (m,) is in standard deviations.
    """

    scale: Scale
    under: Background
    chance: np.ndarray
    height: np.ndarray

    @classmethod
    def of(cls, scale: Scale) -> _View:
        """The view at the start of the search."""
        under = background(scale)
        ratio = scale.density / under.density
        # Bin by bin any line counts that noise does not make, but the knee of a filter does not.
        prominent = (
            PROMINENT if scale.bins > 1 else min(PROMINENT, 1 + SPREAD / np.sqrt(under.averages))
        )
        seen = scale.searched & (ratio >= prominent) & _peaked(scale.density, prominent)
        # Heights choose between scales, because the probabilities of strong lines are zero on all.
        return cls(
            scale,
            under,
            np.where(seen, under.chance(scale.density), 1.0),
            (ratio - 1) * np.sqrt(under.averages),
        )

    def hide(self, line: Line, fitted: Fitted) -> None:
        """Take the groups that ``line`` covers or leaks into out of the search."""
        width, f = self.scale.level.resolution, self.scale.frequency
        reach = width * self.scale.bins / 2
        d = np.maximum((np.abs(f - line.frequency) - reach) / width, 2.0)
        # The envelope of what leaks, beyond the first side lobe.
        leaked = line.amplitude**2 / (3 * width) / (np.pi * d * (d**2 - 1)) ** 2
        hidden = (f >= fitted.low - reach) & (f <= fitted.high + reach)
        if line.width <= width:
            hidden |= (d < 3) | (
                leaked > HIDDEN * self.under.density / np.sqrt(self.under.averages)
            )
        self.chance[hidden] = 1.0


def _peaked(density: np.ndarray, prominent: float) -> np.ndarray:
    """Mask (m,) of the groups that stand out by the factor ``prominent`` on both sides.

    The knee of a low-pass does not, however sharp it is.
    """
    smooth = uniform_filter1d(density, 3, mode="nearest")
    below = minimum_filter1d(smooth, SIDE, origin=(SIDE - 1) // 2, mode="nearest")
    above = minimum_filter1d(smooth, SIDE, origin=-((SIDE - 1) // 2), mode="nearest")
    return density >= prominent * np.maximum(below, above)


def _column(levels: Sequence[Level], column: int) -> list[_View]:
    """All scales of all levels of one column."""
    return [
        _View.of(scale)
        for i, a in enumerate(levels)
        for scale in scales(a, column, LOWEST if i == len(levels) - 1 else 0)
    ]


def _of_column(views: Sequence[_View], column: int, p: float, family: int) -> list[Line]:
    """Lines of one column, by frequency; the highest is found first and hidden for the others.

    ``p`` is the probability of a false alarm among all ``family`` groups searched.
    """
    found: list[Line] = []
    while len(found) < MOST:
        heights = [np.where(v.chance * family < p, v.height, 0.0) for v in views]
        view = views[int(np.argmax([h.max(initial=0.0) for h in heights]))]
        at = int(np.argmax(np.where(view.chance * family < p, view.height, 0.0)))
        if not view.chance[at] * family < p:
            break
        fitted = fit_line(view.scale, view.under, at)
        found.append(_line(view, at, column, fitted, family))
        for v in views:
            v.hide(found[-1], fitted)
        view.chance[at] = 1.0
    return sorted(found, key=lambda x: x.frequency)


def _line(view: _View, at: int, column: int, fitted: Fitted, family: int) -> Line:
    """The line whose highest group is the one at index ``at`` of a view."""
    amplitude = np.sqrt(fitted.power)
    return Line(
        column,
        frequency=float(fitted.frequency),
        frequency_std=float(fitted.frequency_std),
        amplitude=float(amplitude),
        amplitude_std=float(fitted.power_std / (2 * amplitude)),
        p_value=float(view.chance[at] * family),
        ratio=float(view.scale.density[at] / view.under.density[at]),
        background=float(view.under.density[at]),
        width=float(fitted.width),
    )
