"""How lines are related: harmonics, sidebands of a modulated line, fractions of the sample rate.

Frequencies agree where they differ by no more than ``SIGMA`` standard errors. A relation is named
only where chance would hardly make any among as many lines (``CHANCE`` expected).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

import numpy as np

SIGMA = 4.0
"""Standard errors."""

ORDERS = range(2, 11)
"""Orders of the harmonics that are looked for."""

CHANCE = 0.05
"""Expected number of agreements by chance."""

DENOMINATORS = range(2, 11)
"""Denominators of the fractions of the sample rate that are looked for."""


class Tone(Protocol):
    """What must be known of a line: its frequency with standard error [Hz], and its amplitude."""

    frequency: float
    frequency_std: float
    amplitude: float


@dataclass(frozen=True)
class Relation:
    """The relation of a line to another one or to the sample rate, at ``of`` Hz.

    ``kind`` is "harmonic" (``order`` times ``of``), "sideband" (``order`` +1 above or -1 below
    ``of``), or "clock" (``share`` of the sample rate ``of``). A ``folded`` harmonic lies above half
    the sample rate.
    """

    kind: str
    of: float
    order: int = 0
    folded: bool = False
    share: Fraction | None = None

    @property
    def text(self) -> str:
        """The relation in words, such as ``2 x 20 Hz``."""
        if self.kind == "harmonic":
            return f"{self.order} x {self.of:.6g} Hz" + (", folded" if self.folded else "")
        if self.kind == "sideband":
            return f"{'upper' if self.order > 0 else 'lower'} sideband of {self.of:.6g} Hz"
        return f"{self.share} of the sample rate {self.of:.6g} Hz"


def folded(frequency: float, rate: float) -> float:
    """The frequency [Hz] at which one of ``frequency`` appears at the sample ``rate`` [Hz]."""
    return abs(frequency - rate * round(frequency / rate))


def relations(lines: Sequence[Tone], rate: float) -> list[Relation | None]:
    """The relation of each line, or None.

    The strongest of related lines is the base; it has at most a relation to the sample ``rate``
    [Hz].
    """
    found: dict[int, Relation] = {}
    bases: list[int] = []
    for i in sorted(range(len(lines)), key=lambda i: -lines[i].amplitude):
        relation = _harmonic(lines, i, bases, rate)
        if relation is None:
            bases.append(i)
        else:
            found[i] = relation
    found.update(_sidebands(lines, bases))
    for i in bases:
        clock = _clock(lines[i], rate, len(lines))
        if i not in found and clock is not None:
            found[i] = clock
    return [found.get(i) for i in range(len(lines))]


def _harmonic(lines: Sequence[Tone], i: int, bases: Sequence[int], rate: float) -> Relation | None:
    """The harmonic of a base that line i is: if possible one not folded, of the lowest order."""
    line, candidates = lines[i], []
    for b in bases:
        base = lines[b]
        for order in ORDERS:
            within = SIGMA * np.hypot(line.frequency_std, order * base.frequency_std)
            # Any line might agree with any order up to this one of any base.
            likely = len(lines) ** 2 * (order - 1) * 2 * within / (rate / 2) < CHANCE
            if likely and abs(folded(order * base.frequency, rate) - line.frequency) <= within:
                over = order * base.frequency > rate / 2
                candidates.append(
                    (over, order, Relation("harmonic", base.frequency, order, bool(over)))
                )
    return min(candidates, key=lambda c: c[:2])[2] if candidates else None


def _sidebands(lines: Sequence[Tone], free: Sequence[int]) -> dict[int, Relation]:
    """Pairs of ``free`` lines at equal distances from a stronger line."""
    found: dict[int, Relation] = {}
    for carrier in sorted(lines, key=lambda x: -x.amplitude):
        rest = [i for i in free if i not in found and lines[i].amplitude < carrier.amplitude]
        for a in rest:
            for b in rest:
                if (
                    a not in found
                    and b not in found
                    and _mirrored(lines[a], carrier, lines[b], lines)
                ):
                    found[a] = Relation("sideband", carrier.frequency, -1)
                    found[b] = Relation("sideband", carrier.frequency, 1)
    return found


def _mirrored(low: Tone, carrier: Tone, high: Tone, lines: Sequence[Tone]) -> bool:
    """Whether two lines are at equal distances from the carrier, and hardly by chance."""
    apart = carrier.frequency - low.frequency
    within = SIGMA * np.sqrt(
        low.frequency_std**2 + high.frequency_std**2 + 4 * carrier.frequency_std**2
    )
    if apart <= 0 or abs(low.frequency + high.frequency - 2 * carrier.frequency) > within:
        return False
    # Pairs about this carrier that could have agreed by chance.
    below = sum(0 < carrier.frequency - x.frequency <= 2 * apart for x in lines)
    above = sum(0 < x.frequency - carrier.frequency <= 2 * apart for x in lines)
    return below * above * 2 * within / (2 * apart) < CHANCE


def _clock(line: Tone, rate: float, count: int) -> Relation | None:
    """The fraction of the sample rate at which one of ``count`` lines is."""
    shares = {Fraction(p, q) for q in DENOMINATORS for p in range(1, q) if 2 * p <= q}
    within = SIGMA * line.frequency_std
    if count * len(shares) * 2 * within / (rate / 2) >= CHANCE:
        return None
    share = min(shares, key=lambda s: abs(float(s) * rate - line.frequency))
    return (
        Relation("clock", rate, share=share)
        if abs(float(share) * rate - line.frequency) <= within
        else None
    )
