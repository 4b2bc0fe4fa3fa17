"""Rates beyond a gyro's range, drawn as the body turned before and after.

A gyro that is driven to its limit shows the limit, and a filter that takes it at its word misses
whole turns: a wand swung at 420 deg/s and more loses 60 deg in each swing. In a log the samples
after the span are there as well. A cubic that leaves the range with the slope of the samples before
and comes back with that of those after (Hermite's; of all curves with these ends the one of least
bending) has most of what was lost. From how many samples the slopes are taken, and how far off the
cubic is, the log says itself: by spans in which its rates are known, cut off by hand at a lower
level (``_judged``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from pyimu.attitude.error import root_mean_square
from pyimu.attitude.filter.variables import USUAL
from pyimu.model.part import Part
from pyimu.recording.clock import runs
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.recording import Recording

WAYS = ((2, 1), (3, 1), (4, 1), (6, 1), (8, 1), (12, 1), (3, 2), (4, 2), (6, 2), (8, 2))
"""Samples from which a slope is taken on either side, and the degree of the polynomial that gives
it."""

CUT = tuple(np.arange(0.3, 0.95, 0.1))
"""Shares of the limit at which known spans are cut off to see how well the cubic restores them."""

LEAST = 5
"""Known spans without which nothing is drawn."""

MOST = 500
"""Known spans that are judged; of more, so many evenly spread."""

ALIKE = 3.0
"""Spans are judged by known ones that last neither so many times longer nor shorter."""

UNTOLD, UNTOLD_LONGEST = 0.5, 0.3
"""Part of the turn drawn by which it is off in a span of at most so many s of which the log does
not tell. Spans of seven logs of BROAD, REPOIMU and MoRPINet, cut off by hand at 0.3 to 0.9 of the
largest rate, are off by 0.2 to 0.45 of it, RMS; of longer ones, in which a body turns on evenly,
the cubic has up to ten times too much."""

UNTOLD_WAYS = ((6, 2), (4, 2), (3, 2), (3, 1), (2, 1))
"""How such a span is drawn: the first is the best of these logs."""

NEAR = 0.05
"""Share of the limit by which samples that pile up there may be off it, by corrections made after
it. What piles up farther below is no limit."""

SHORTEST = 2
"""Samples at the limit; a single one is drawn by the filter as the sample before."""


@dataclass(frozen=True)
class Span:
    """Rows ``first`` to ``stop`` at the limit, between samples that are known."""

    first: int
    stop: int


@dataclass(frozen=True)
class Axis:
    """The rates of an axis (n,) rad/s, its ``limit``, and the rows (n,) that are ``lost`` to it.

    ``known`` (n,) are those from which a slope may be taken; ``edges`` the rows at which a segment
    ends.
    """

    rate: np.ndarray
    limit: float
    lost: np.ndarray
    edges: np.ndarray

    def cut(self, share: float) -> Axis:
        """The same, cut off at a ``share`` of the limit."""
        level = share * self.limit
        return replace(
            self,
            rate=np.clip(self.rate, -level, level),
            limit=level,
            lost=np.abs(self.rate) >= level,
        )

    def spans(self) -> list[Span]:
        """Where rates are lost; spans between which fewer samples are known than a slope takes are
        one.
        """
        found: list[Span] = []
        for first, stop in runs(self.lost):
            if found and first - found[-1].stop < SHORTEST:
                found[-1] = Span(found[-1].first, stop)
            else:
                found.append(Span(first, stop))
        return [s for s in found if s.stop - s.first >= SHORTEST]

    def drawn(self, span: Span, window: int, degree: int) -> np.ndarray | None:
        """By how much (m,) the rates of a span lie beyond the limit; None where its ends are not
        known well enough.
        """
        first, stop = span.first - window, span.stop + window
        if first < 0 or stop > len(self.rate):
            return None
        before, after = self.rate[first : span.first], self.rate[span.stop : stop]
        inside = np.any((self.edges > first) & (self.edges < stop))
        lost = self.lost[first : span.first].any() or self.lost[span.stop : stop].any()
        sign = self.sign(span)
        if inside or lost or sign == 0 or not np.isfinite([*before, *after]).all():
            return None
        cubic = _cubic(before, after, span.stop - span.first, degree)
        return np.maximum(sign * cubic - self.limit, 0.0)

    def sign(self, span: Span) -> float:
        """On which side of the range a span lies."""
        return float(np.sign(np.nansum(self.rate[span.first : span.stop])))


@dataclass(frozen=True)
class Cubics:
    """How spans are drawn: by the first of ``ways`` (window and degree) that a span has room for,
    times ``share``, none longer than ``longest`` samples. They are off by the part ``off`` of the
    turn that they draw; without them the rates are off by ``held`` rad/s.
    """

    ways: Sequence[tuple[int, int]]
    share: float
    longest: int
    off: float
    held: float

    def drawn(self, axis: Axis, span: Span) -> np.ndarray | None:
        """By how much (m,) the rates of a span lie beyond the limit, None where nothing tells."""
        if span.stop - span.first > self.longest:
            return None
        found = (axis.drawn(span, *way) for way in self.ways)
        return next((self.share * d for d in found if d is not None), None)


def beyond_range(recording: Recording, part: Part) -> tuple[Recording, float]:
    """The recording with the rates of spans at the gyro's limit drawn beyond it (``by_axis``), and
    the standard deviation in rad/s of the rates that were drawn, 0 where none were.

    Where an axis stays at its limit, or samples are missing, the filter's own ``lost_rate_std`` is
    the least: it has one for all rates that are lost.
    """
    drawn, stds = by_axis(recording, part)
    most = max(std or 0.0 for std in stds)
    if most == 0:
        return recording, 0.0
    unknown = None in stds or not np.isfinite(recording.gyro).all()
    return drawn, max(most, USUAL["lost_rate_std"] if unknown else 0.0)


def by_axis(
    recording: Recording, part: Part, untold: bool = False
) -> tuple[Recording, list[float | None]]:
    """The recording with the rates of spans at the gyro's limit drawn beyond it.

    The limit is that of ``part``, which has what the samples pile up at. Gives, too, the standard
    deviation of each axis in rad/s of the rates that were drawn, as a rate that stays the same for
    a span: 0 without spans. Each axis of which ``LEAST`` known spans say that drawing helps is
    drawn; others stay at their limit, and have None. With ``untold`` short spans of which the log
    does not tell are drawn as those of other bodies go on (``UNTOLD``), and an axis that has longer
    ones has None.
    """
    limits = part.gyro.clips_from
    if recording.gyro is None or not np.isfinite(limits).any():
        return recording, [0.0] * 3
    gyro, stds = recording.gyro.copy(), list[float | None]()
    edges = np.array([first for first, _ in recording.segments[1:]], dtype=int)
    for column, limit in zip(gyro.T, limits, strict=True):
        lost = np.abs(column) >= limit
        if np.isfinite(limit):
            lost |= clipped(column) & (np.abs(column) >= (1 - NEAR) * limit)
        std: float | None = 0.0
        if np.isfinite(limit) and lost.any():
            longest = round(UNTOLD_LONGEST / recording.sample_period) if untold else 0
            column[:], std = _drawn(Axis(column.copy(), float(limit), lost, edges), longest)
        stds.append(std)
    same = np.array_equal(gyro, recording.gyro, equal_nan=True)
    return recording if same else replace(recording, gyro=gyro), stds


def _drawn(axis: Axis, longest: int) -> tuple[np.ndarray, float | None]:
    """The rates of an axis with its spans drawn, and the standard deviation of these in rad/s: 0
    without spans, None where nothing tells how to draw them. Those of up to ``longest`` samples are
    drawn although the log does not tell.
    """
    spans, out = axis.spans(), axis.rate.copy()
    if not spans:
        return out, 0.0
    judged = _judged(axis, spans)
    ways = [] if judged is None else [judged]
    ways += [Cubics(UNTOLD_WAYS, 1.0, longest, UNTOLD, 0.0)] if longest else []
    errors, told = [], True
    for span in spans:
        found = ((cubics, cubics.drawn(axis, span)) for cubics in ways)
        cubics, beyond = next((f for f in found if f[1] is not None), (judged, None))
        if beyond is not None:
            out[span.first : span.stop] = axis.sign(span) * (axis.limit + beyond)
            errors.append(cubics.off * np.sum(beyond))
        elif longest or cubics is None:
            told = False
        else:
            errors.append(cubics.held * (span.stop - span.first))
    if not told:
        return out, None
    return out, root_mean_square(errors) / root_mean_square([s.stop - s.first for s in spans])


def _judged(axis: Axis, spans: list[Span]) -> Cubics | None:
    """The cubics, by how well they restore known spans of about the length of ``spans``.

    None where they restore none, or too few are like those that are lost.
    """
    lasting = root_mean_square([s.stop - s.first for s in spans])
    true, lengths = [], []
    found: dict[tuple[int, int], list[float]] = {way: [] for way in WAYS}
    known = list(_known(axis, lasting))
    for cut, span in known[:: -(-len(known) // MOST) or 1]:
        drawn = {way: cut.drawn(span, *way) for way in WAYS}
        if any(d is None for d in drawn.values()):
            continue
        inside = slice(span.first, span.stop)
        true.append(float(np.sum(np.abs(axis.rate[inside]) - cut.limit)))
        lengths.append(span.stop - span.first)
        for way, values in drawn.items():
            found[way].append(float(np.sum(values)))
    if len(true) < LEAST:
        return None
    shares = {way: _share(np.array(true), np.array(turns)) for way, turns in found.items()}
    errors = {way: root_mean_square(true - shares[way] * np.array(found[way])) for way in WAYS}
    ways = sorted(WAYS, key=lambda way: errors[way])
    best = ways[0]
    restored = shares[best] * root_mean_square(found[best])
    if restored <= 0:
        return None
    held = root_mean_square(true) / root_mean_square(lengths)
    return Cubics(ways, shares[best], max(lengths), errors[best] / restored, held)


def _share(true: np.ndarray, drawn: np.ndarray) -> float:
    """The part of what is ``drawn`` that is ``true``, by least squares; 1 at most."""
    square = float(drawn @ drawn)
    return float(np.clip(true @ drawn / square, 0.0, 1.0)) if square > 0 else 0.0


def _known(axis: Axis, lasting: float) -> Iterator[tuple[Axis, Span]]:
    """Spans of which the rates are known, of about the ``lasting`` samples of those that are not,
    each with the axis as cut off for it.
    """
    for share in CUT:
        cut = axis.cut(share)
        for span in cut.spans():
            alike = lasting / ALIKE <= span.stop - span.first <= lasting * ALIKE
            if alike and not axis.lost[span.first : span.stop].any():
                yield cut, span


def _cubic(before: np.ndarray, after: np.ndarray, count: int, degree: int) -> np.ndarray:
    """The ``count`` samples of Hermite's cubic between the samples ``before`` and ``after``."""
    (left, rise), (right, fall) = _end(before, degree), _end(after[::-1], degree)
    u = np.arange(1, count + 1) / (count + 1)
    bend = (count + 1) * u * (1 - u)
    return (
        left * (1 + 2 * u) * (1 - u) ** 2
        + right * u**2 * (3 - 2 * u)
        + bend * (rise * (1 - u) + fall * u)
    )


def _end(samples: np.ndarray, degree: int) -> tuple[float, float]:
    """Value and slope per sample of a polynomial through ``samples`` at the last of them."""
    value, slope = _weights(len(samples), degree) @ samples
    return float(value), float(slope)


@cache
def _weights(count: int, degree: int) -> np.ndarray:
    """(2, count): what value and slope of ``_end`` have of each sample, by least squares."""
    at = np.arange(1 - count, 1)
    return np.linalg.pinv(np.vander(at, degree + 1, increasing=True))[:2]
