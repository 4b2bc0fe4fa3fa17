"""The clock of a log's reference, as a trial carries it."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace

import numpy as np

LONGEST_OWN = 0.05
"""s; a lag above it is no sensor's: bandwidths begin at some 5 Hz."""

WIDE = 5.0
"""Standard errors of a lag as it was measured, of which a fit may make use: it sees the same rows,
but weighs them better."""


@dataclass(frozen=True)
class ClockChange:
    """What a fit finds beside a measured clock: ``offset`` s later at ``middle`` s of the log, and
    ``drift`` s more each second.
    """

    middle: float
    offset: float = 0.0
    drift: float = 0.0

    def moved(self, order: int, change: float) -> ClockChange:
        if order == 0:
            return replace(self, offset=self.offset + change)
        return replace(self, drift=self.drift + change)

    def at(self, time: np.ndarray) -> np.ndarray:
        return self.offset + self.drift * (time - self.middle)


@dataclass(frozen=True)
class Slip:
    """A clock that jumps by ``size`` s at ``time`` s of the log, which is known to ``std`` s."""

    time: float
    std: float
    size: float

    def as_dict(self) -> dict[str, float]:
        return asdict(self)


@dataclass(frozen=True)
class Clock:
    """How much later than its reference says a sensor shows the motion of a log.

    ``late`` (k,) s at ``time`` (k,) s of the log, one entry where the clocks keep step; ``std`` is
    the standard error in s. ``explained`` is the share of the sensor's power that the reference
    then accounts for. ``own`` s are left beside it for the effects of the sensor that make it
    late; ``taken_out`` says whether ``late`` was taken out of the reference, or is too small for
    that. ``skew`` is by how much ``late`` grows in a second, with its standard error, where it
    does so steadily but for ``slips``; None where the clocks keep step or the lag wanders.
    ``doubtful`` says that an effect may have made it look as if it drifted; ``unsure`` are the
    spans [s] in which nobody knows whether it has slipped yet; ``changed`` says that one lag stands
    for one that seemed to change. By up to ``apart`` s it may be off, where it was measured without
    a lag that the sensor has. ``or_sensor`` says that the sensor may be late as well, which one log
    with a reference on another clock does not tell.
    """

    time: np.ndarray
    late: np.ndarray
    std: float
    explained: float
    own: float = 0.0
    taken_out: bool = False
    skew: tuple[float, float] | None = None
    slips: tuple[Slip, ...] = ()
    doubtful: bool = False
    unsure: tuple[tuple[float, float], ...] = ()
    changed: bool = False
    apart: float = 0.0
    or_sensor: bool = False

    @property
    def keeps_step(self) -> bool:
        return len(self.late) == 1

    def kept_in_step(self) -> Clock:
        """One lag, the mean, in place of one that changes, known to as much as that scatters."""
        std = max(self.std, float(np.ptp(self.late) / np.sqrt(12.0)))
        late = np.array([self.mean])
        one = replace(self, time=self.time[:1], late=late, std=std)
        return replace(one, skew=None, slips=(), changed=True)

    @property
    def is_seen(self) -> bool:
        return bool(np.isfinite(self.std))

    @property
    def is_steady(self) -> bool:
        """Whether the lag is one number, or a straight line but for its slips."""
        return self.keeps_step or self.skew is not None

    @property
    def mean(self) -> float:
        return float(np.mean(self.late))

    def less(self, delay: float) -> Clock:
        """The clock when ``delay`` s of it are the sensor's own."""
        return replace(self, late=self.late - delay, own=delay)

    def room(self, seconds: float) -> dict[int, float]:
        """Standard deviations of what a fit to ``seconds`` of a log may find beside the lag, by the
        order in time.

        The offset, in s, is left alone where it may be the sensor's own, and where there seemed to
        be none; the drift never is.
        """
        drift = {1: WIDE * self.std * np.sqrt(12.0) / seconds}
        if self.apart:
            return {0: self.apart, **drift}
        return {0: WIDE * self.std, **drift} if self.taken_out and not self.own else drift

    def corrected(
        self, change: ClockChange, std: float, first: float, last: float, least: float = WIDE
    ) -> Clock:
        """The clock with what a fit found beside it, from ``first`` to ``last`` s, ``std`` being
        the standard error of its drift; a new drift below so many of them as ``least`` is none.
        """
        if self.skew is None and abs(change.drift) <= least * std:
            change = replace(change, drift=0.0)
        drifts = self.keeps_step and change.drift != 0.0
        time = np.array([first, last]) if drifts else self.time
        was = None if self.skew is None else self.skew[0]
        skew = (change.drift + (was or 0.0), std) if drifts or was is not None else None
        return replace(self, time=time, late=self.at(time) + change.at(time), skew=skew)

    def back(self) -> Clock:
        """The clock that undoes this one, once it is taken out."""
        skew = None if self.skew is None else (-self.skew[0], self.skew[1])
        return replace(self, late=-self.late, skew=skew)

    def as_dict(self) -> dict[str, float | bool | None]:
        """Its figures in s, as they were measured, for report.json."""
        figures = {
            "late": self.mean + self.own,
            "std": self.std,
            "least": float(self.late.min()) + self.own,
            "most": float(self.late.max()) + self.own,
            "left_to_sensor": self.own,
        }
        known = {k: v if np.isfinite(v) else None for k, v in figures.items()}
        return known | {"taken_out": self.taken_out}

    def at(self, time: np.ndarray) -> np.ndarray:
        late = np.interp(time, self.time, self.late)
        if self.skew is None:
            return late
        return late + self.skew[0] * (time - np.clip(time, self.time[0], self.time[-1]))
