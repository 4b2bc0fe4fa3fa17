"""Whether the noise that was chosen has the spectrum that the residual has.

The likeliest of the kinds that there are need not be the right one: a line whose frequency wanders
looks like Gauss-Markov noise, as both are slow and random. Whittle (1953): where the spectrum is
right, the squares of the cells of an octave have the chi-squared distribution of their count about
it, each octave by itself. What a level of its own in each octave explains is held against what the
chosen kinds do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc, digamma

from pyimu.identification.formula.constancy import REST
from pyimu.identification.formula.screen import UNEXPLAINED
from pyimu.identification.noise.choose import Axis, Term
from pyimu.identification.noise.explained import Explained
from pyimu.model.catalogue import CATALOGUE
from pyimu.report.numbers import joined, number


@dataclass(frozen=True)
class Misfit:
    """How the spectrum of an axis differs from that of the noise ``names`` that was chosen.

    The ``share`` is that of what these explain which levels of octaves explain beyond them, with
    the ``chance`` of as much by noise of these kinds; ``ratio`` the power at ``hz``, where it is
    clearest, over what they have there.
    """

    names: tuple[str, ...]
    share: float
    chance: float
    hz: float
    ratio: float

    @property
    def shape(self) -> str:
        there = f"{number(self.ratio, 2)} times as strong at {number(self.hz, 2)} Hz"
        kinds = joined([CATALOGUE[n].term.partition(",")[0] for n in self.names])
        return f"noise of another spectrum than {kinds}, {there}"


def misfits_of(found: Explained) -> dict[int, Misfit]:
    """The axes whose spectrum is not that of the noise that was chosen for them, beyond chance and
    by more than a matter of form.
    """
    chosen = found.state.found
    each = {i: _misfit(axis, chosen.get(i, ())) for i, axis in found.state.axes.items()}
    made = {i: m for i, m in each.items() if m is not None}
    return {i: m for i, m in made.items() if m.share > REST and m.chance * len(made) < UNEXPLAINED}


def _misfit(axis: Axis, terms: tuple[Term, ...]) -> Misfit | None:
    """How the spectrum of an axis differs from its noise; None where none was chosen, or it has no
    part of the likelihood.
    """
    slow = [t for t in terms if not t.kind.follows]
    gain = _gain(axis, slow)
    if not gain > 0.0:
        return None
    count, power, hz = _octaves(axis)
    twice = power - count - count * np.log(power / count)
    # Of a few squares it is more in the mean than of many, where it is one.
    usual = count * (np.log(count / 2.0) - digamma(count / 2.0))
    excess = 0.5 * float(np.sum(twice - usual))
    most = int(np.argmax(np.where(power > count, twice, 0.0)))
    return Misfit(
        tuple(t.kind.name for t in slow),
        excess / gain,
        float(chdtrc(len(count), np.sum(twice / usual))),
        float(hz[most]),
        float(power[most] / count[most]),
    )


def _gain(axis: Axis, terms: list[Term]) -> float:
    """Log-likelihood [nat] that kinds of noise gain on an axis."""
    less = axis.spectrum
    for place in sorted((t.place for t in terms), reverse=True):
        less = less.without(place)
    return axis.spectrum.fit()[1] - less.fit()[1] if terms else 0.0


def _octaves(axis: Axis) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of each octave of frequency (o,) the count of values, the sum of their squares over their
    variance, and its mean frequency [Hz].
    """
    cells, bands = axis.spectrum, axis.bands
    variance = cells.base + cells.fit()[0] @ cells.free
    hz = np.sqrt(bands.turn) / (2 * np.pi * bands.h)
    _, octave = np.unique(np.floor(np.log2(hz / hz.min())), return_inverse=True)
    count = np.bincount(octave, cells.count)
    power = np.bincount(octave, cells.squares / variance)
    return count, power, np.bincount(octave, hz * cells.count) / count
