r"""Spectral lines: sines in a record's noise, with frequency, amplitude, standard errors and
significance.

Each bin of each level of ``psd``'s spectrum is held against the local background
(``line_background``). The significance of a line is that of its highest bin times the number of
bins looked at in all columns (Bonferroni; neighbouring bins repeat each other, so that noise
without lines gives a line somewhat more rarely than the level says). A strong line hides what it
leaks into: bins where it shows as much as noise scatters are not looked at again.

Lines are looked for from bin ``LOWEST`` of the longest windows on, where slow drifts end, to three
bins below half the sample rate; broad ones end earlier there, where a density may fall to zero. A
resonance is a line too, a broad one: nothing in a spectrum tells it from a disturbance.

Frequencies are those in the record, in which one above half the sample rate has been folded; what
the lines have to do with each other is in ``line_relations``. Noise in bursts has bins that depend
on each other, and may look like lines.
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
"""The lowest bin that is looked at, on the lowest level."""

MOST = 100
"""Lines of one column; a comb of more is no list."""

HIDDEN = 0.1
"""A bin is hidden where a line leaks into it this share of the scatter of its noise."""

PROMINENT = 1.5
"""A band of noise is called a line where it stands half as high again as the curve beneath it,
which no law demands to be smooth."""

SPREAD = 3.0
"""Standard deviations of a bin, which every line exceeds that is significant among thousands of
bins."""

SIDE = 17
"""Groups on either side of a band, its own included, in which it has to fall."""


@dataclass(frozen=True)
class Line:
    """One line of one ``column``.

    ``frequency`` [Hz] and ``amplitude`` (the peak of the sine, in the samples' unit) with standard
    errors; ``p_value`` for the whole search; ``ratio`` of the density at its highest bin to
    ``background``, the one-sided density beneath it; ``width`` [Hz], the standard deviation of its
    frequency, zero where it is as sharp as the window.
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
        """Root mean square of the line."""
        return self.amplitude / np.sqrt(2)


def find_lines(spectrum: SpectrumAccumulator, level: float = 1e-3) -> list[Line]:
    """Lines of all columns, by column and frequency; ``level`` is the probability to find any in
    stationary noise without lines.
    """
    if not 0 < level < 1:
        raise ValueError(f"the level {level} is not between 0 and 1")
    levels = spectrum.levels()
    columns = [_column(levels, c) for c in range(levels[0].density.shape[1] if levels else 0)]
    family = sum(int(view.scale.searched.sum()) for views in columns for view in views)
    found = []
    for c, views in enumerate(columns):
        own = _of_column(views, c, level, family)
        found += [
            replace(line, relation=r)
            for line, r in zip(own, relations(own, 1 / spectrum.h), strict=True)
        ]
    return found


def searched_range(spectrum: SpectrumAccumulator) -> tuple[float, float]:
    """Hz from which and up to which lines are looked for; nan where there is no spectrum."""
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
    """One scale of one level: its background, and each group's probability and ``height`` in
    standard deviations.

    Groups that are not, or no longer, looked at have the probability one.
    """

    scale: Scale
    under: Background
    chance: np.ndarray
    height: np.ndarray

    @classmethod
    def of(cls, scale: Scale) -> _View:
        under = background(scale)
        ratio = scale.density / under.density
        # Bin by bin any line counts that noise does not make; but neither a knee.
        prominent = (
            PROMINENT if scale.bins > 1 else min(PROMINENT, 1 + SPREAD / np.sqrt(under.averages))
        )
        seen = scale.searched & (ratio >= prominent) & _peaked(scale.density, prominent)
        # Heights choose between scales; the probabilities of strong lines are zero on all.
        return cls(
            scale,
            under,
            np.where(seen, under.chance(scale.density), 1.0),
            (ratio - 1) * np.sqrt(under.averages),
        )

    def hide(self, line: Line, fitted: Fitted) -> None:
        """What says nothing any more, once ``line`` has been found: what it covers, and leaks
        into.
        """
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
    """Mask of where it stands so high over something on either side: the knee of a low-pass does
    not, however bent it is.
    """
    smooth = uniform_filter1d(density, 3, mode="nearest")
    below = minimum_filter1d(smooth, SIDE, origin=(SIDE - 1) // 2, mode="nearest")
    above = minimum_filter1d(smooth, SIDE, origin=-((SIDE - 1) // 2), mode="nearest")
    return density >= prominent * np.maximum(below, above)


def _column(levels: Sequence[Level], column: int) -> list[_View]:
    return [
        _View.of(scale)
        for i, a in enumerate(levels)
        for scale in scales(a, column, LOWEST if i == len(levels) - 1 else 0)
    ]


def _of_column(views: Sequence[_View], column: int, p: float, family: int) -> list[Line]:
    found: list[Line] = []
    while len(found) < MOST:
        heights = [np.where(v.chance * family < p, v.height, 0.0) for v in views]
        view = views[int(np.argmax([h.max(initial=0.0) for h in heights]))]
        at = int(np.argmax(np.where(view.chance * family < p, view.height, 0.0)))
        if not view.chance[at] * family < p:
            break
        fitted = fit_line(view.scale, view.under, at)
        amplitude = np.sqrt(fitted.power)
        found.append(
            Line(
                column,
                *map(
                    float,
                    (
                        fitted.frequency,
                        fitted.frequency_std,
                        amplitude,
                        fitted.power_std / (2 * amplitude),
                        view.chance[at] * family,
                        view.scale.density[at] / view.under.density[at],
                        view.under.density[at],
                        fitted.width,
                    ),
                ),
            )
        )
        for v in views:
            v.hide(found[-1], fitted)
        view.chance[at] = 1.0
    return sorted(found, key=lambda x: x.frequency)
