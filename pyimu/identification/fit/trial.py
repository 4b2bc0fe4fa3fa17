"""One log as one sensor's regression sees it.

What was measured, what the reference says went in, which rows count.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.band import Band
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.place import Place
from pyimu.identification.fit.reduction import Reduction, Rows
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.clock import runs
from pyimu.recording.coarse import came_in_bursts
from pyimu.recording.reference.force import ORDER
from pyimu.recording.reference.unlagged import ADAPTS, LAG

SETTLE = 32
"""Rows at the start of a segment that are not counted: nobody knows what a lag or delay remembers
from before it."""

HELD_OUT = 0.3
"""Share of each log, mostly its end, that is held out where no log is named for it."""

ASKED, LEAST_FITTED, LEAST_HELD, TRIED = 0.01, 0.2, 0.1, 21
"""Of an axis, its power over that of the strongest from which on it must be fitted; the share of
its power that the fitted rows must have; the mean share that the others have at least; and how many
places for these are tried."""

ROUNDED = 1e-18
"""Power over that of what stays the same, below which nothing but rounding changes."""

HEAD = 30.0
"""Seconds of motion at the start of a held-out log from which what belongs to the log is
estimated."""

MOVING = 0.2
"""Share of the reference's root mean square above which a row counts as moving: at rest it shows no
mounting and no clock, but its own noise."""

OWN_LAG = frozenset({"time_offset", LAG, ADAPTS})
"""Findings of a reference whose clock somebody has set by hand, or which lagged: what is late
beside it is what they left."""

MEASURED = ("rate", "force")
"""References that were measured themselves, and not differentiated."""

TURNS = ("rate", "attitude")
"""References that show all of a gyro's motion."""

NO_DIGITS = (0.0, 0.0, 0.0)


def leaves_a_lag(finding: Finding) -> bool:
    """Whether a finding says where a lag is from that is none of the sensor's: what was done to the
    reference, or samples that waited to be read.
    """
    return finding.kind in OWN_LAG or came_in_bursts(finding)


class Doubt(IntEnum):
    """Whether a reference has noise that is not white: ``NONE`` where that is known, ``OPEN`` where
    an effect may have left what looks like it, ``LIKELY`` where the sensor's own signal has little
    of it, and it is there in quiet as in motion.
    """

    NONE, OPEN, LIKELY = range(3)


@dataclass(frozen=True)
class Trial:
    """Rows of one log for one sensor.

    ``y`` (n, 3) measured, ``u`` (n, N_INPUT) reference inputs (at their start values where nobody
    knows them), ``known`` the signals that are really known, ``axes`` those that the reference
    covers, ``segments`` the ranges without gap. ``reference`` is "rate", "attitude", "heading",
    "course", "force", "position", "velocity", "gravity" or "static"; ``free_rotation`` says that
    the reference's mounting is not known, ``place`` what is not known of where its force acts.
    ``parent`` names the fitted trial that has the same power-on, if any, and
    ``earlier`` (m, N_INPUT) are the inputs of the log before the first row, if any; ``left_out``
    (n,) marks samples that are missing or carry no information (spikes, repeats, at a limit),
    heeded where no band mixes them with their neighbours. ``band_hz`` is the band of a derived
    reference, at most ``band_limit``; ``clock`` what was taken out of the reference's clock; ``up``
    (3,) the direction upward in the sensor's axes where the reference knows only the turn about it;
    ``digits`` (3,) the steps to which the numbers of a measured reference were rounded, 0 where
    none is seen; ``noise`` (n, 3) a draw of the reference's noise, where it has any to speak of,
    and ``noise_error`` (3,) the standard error of its power over that power, ``doubt`` whether it
    may have noise that was not drawn. ``reduction`` is how samples become rows where these are
    whole stretches of the log. ``samples`` (m, 3) are those of the reference at times of its own,
    where it was measured itself. ``healed`` (n, 3) is what was taken off samples that look like
    spikes, where there are any; ``limited`` (n, 3) marks those that lie where the output stops and
    that a band would spread. ``undamped`` (n, 3) is what the reference shows of the sensor's own
    signal where ``u`` has it as a sensor does that damps a little. ``reference_apart`` says that
    another clock gave the reference its times; a rate that was differentiated has nothing above
    ``cutoff`` Hz in ``u``; ``seen_at`` (m,) s are the times of the attitudes that it was made of.
    ``bent`` (n, 3) is by how much more an effect bends the sensor's own
    signal than what the reference shows of it.
    """

    name: str
    kind: str
    h: float
    time: np.ndarray
    y: np.ndarray
    u: np.ndarray
    segments: list[tuple[int, int]]
    known: frozenset[str]
    reference: str
    band_hz: float | None = None
    axes: tuple[int, ...] = (0, 1, 2)
    free_rotation: bool = False
    parent: str | None = None
    earlier: np.ndarray | None = None
    left_out: np.ndarray | None = None
    findings: tuple[Finding, ...] = ()
    band_limit: float | None = None
    clock: Clock | None = None
    digits: tuple[float, ...] = NO_DIGITS
    noise: np.ndarray | None = None
    noise_error: tuple[float, ...] = (0.0, 0.0, 0.0)
    doubt: Doubt = Doubt.NONE
    up: np.ndarray | None = None
    reduction: Reduction | None = None
    place: Place | None = None
    samples: np.ndarray | None = None
    healed: np.ndarray | None = None
    limited: np.ndarray | None = None
    undamped: np.ndarray | None = None
    reference_apart: bool = False
    cutoff: float = np.inf
    seen_at: np.ndarray | None = None
    bent: Mapping[str, np.ndarray] = field(default_factory=dict)

    @cached_property
    def band(self) -> Band:
        return Band() if self.band_hz is None else Band.below(self.band_hz, 1.0 / self.h)

    @cached_property
    def row_segments(self) -> list[tuple[int, int]]:
        """Ranges of rows that regression draws on.

        The segments once settled, less what is left out.
        """
        settled = [
            (a + (0 if self.reference == "static" else min(SETTLE, (b - a) // 4)), b)
            for a, b in self.segments
        ]
        if self.left_out is None or self.band_hz is not None:
            return settled
        return [(a + i, a + j) for a, b in settled for i, j in runs(~self.left_out[a:b])]

    @cached_property
    def row_time(self) -> np.ndarray:
        """Times (m,) s of the rows that its band gives."""
        return self.time[self.band.centres(self.row_segments)]

    @cached_property
    def moved(self) -> dict[int, Trial]:
        """The trial with its reference moved by its noise up (1) and down (-1), as
        ``errors_in_variables`` puts it here once it is asked for.
        """
        return {}

    @property
    def derivatives(self) -> int:
        """How often what the reference is from was differentiated, at least once."""
        return ORDER.get(self.reference, 1)

    @property
    def differs(self) -> bool:
        """Whether its reference was differentiated once."""
        measured = self.band_hz is None or self.reference in MEASURED
        return not measured and self.derivatives == 1

    @property
    def any_turn(self) -> bool:
        """Whether a turn of the whole triad is not the sensor's to answer for."""
        return self.free_rotation or (self.reduction is not None and self.reduction.any_turn)

    def precedes(self, held: Trial) -> bool:
        """Whether its rows all come before those that are ``held`` out of the same log, or none are
        held out at once.
        """
        if held.reduction is not None or not len(held.time):
            return True
        last = self.segments[-1][1] - 1 if self.segments else len(self.time) - 1
        return bool(held.time[0] > self.time[last])

    @property
    def count(self) -> int:
        if self.reduction is not None:
            return self.reduction.samples
        return sum(b - a for a, b in self.row_segments)

    def left(self, sensor: Sensor, predicted: np.ndarray) -> np.ndarray:
        """What is measured beyond what a model ``predicted`` (n, 3), each (n, 3), with what its
        effects bend as the sensor's own signal has it.
        """
        out = self.y - predicted
        for name, values in self.bent.items():
            if name in sensor.values and sensor.acts(name):
                out = out - values
        return out

    def rows(self, sensor: Sensor, bias: np.ndarray) -> Rows:
        """What the stretches that are this trial's rows say under a model and a ``bias`` (3,)."""
        return self.reduction.rows(sensor, self.y - bias, self.u, self.segments, self.h)

    def part(self, start: int, stop: int, **changes) -> Trial:
        """Rows start to stop as a trial of their own."""
        inside = [
            (max(a, start) - start, min(b, stop) - start)
            for a, b in self.segments
            if b > start and a < stop
        ]
        flags = None if self.left_out is None else self.left_out[start:stop]
        earlier = self.u[:start]
        if self.earlier is not None:
            earlier = np.concatenate([self.earlier, earlier])
        return replace(
            self,
            time=self.time[start:stop],
            y=self.y[start:stop],
            u=self.u[start:stop],
            segments=inside,
            left_out=flags,
            healed=None if self.healed is None else self.healed[start:stop],
            limited=None if self.limited is None else self.limited[start:stop],
            undamped=None if self.undamped is None else self.undamped[start:stop],
            bent={name: values[start:stop] for name, values in self.bent.items()},
            earlier=earlier if len(earlier) else None,
            noise=None if self.noise is None else self.noise[start:stop],
            place=None if self.place is None else self.place.part(start, stop),
            **changes,
        )

    def split(self, held_out: float) -> tuple[Trial, Trial]:
        """The rows to fit, and the ``held_out`` of those that a reference covers to judge by: the
        last of them, or where these have nearly all that turns or pushes an axis, as where one axis
        is turned after another, others that leave each of them more.

        Of rows that are not samples none is held out: each is judged by a fit to the others.
        """
        if self.reduction is not None:
            return self, replace(self, parent=self.name)
        rows = np.concatenate([np.arange(a, b) for a, b in self.segments] or [np.arange(0)])
        if len(rows) < 2:
            return self, self.part(len(self.time), len(self.time), parent=self.name)
        count = len(rows) - round(len(rows) * (1.0 - held_out))
        first = self._held_from(rows, count)
        start = int(rows[first]) if first < len(rows) else len(self.time)
        if first + count >= len(rows):
            return self.part(0, start), self.part(start, len(self.time), parent=self.name)
        stop = int(rows[first + count])
        around = [(a, min(b, start)) for a, b in self.segments if a < start]
        around += [(max(a, stop), b) for a, b in self.segments if b > stop]
        return replace(self, segments=around), self.part(start, stop, parent=self.name)

    def _held_from(self, rows: np.ndarray, count: int) -> int:
        """The first of ``count`` of the ``rows`` (m,) to hold out."""
        last = len(rows) - count
        if self.place is not None or self.reference == "static" or not 0 < count < len(rows):
            return last
        x = self.u[:, OWN[self.kind]][rows][:, list(self.axes)]
        sums = np.vstack([np.zeros(x.shape[1]), np.cumsum((x - x.mean(axis=0)) ** 2, axis=0)])
        rounding = ROUNDED * np.sum(x**2)
        sums = sums[:, sums[-1] > max(ASKED * float(sums[-1].max()), rounding)]
        if not sums.size:
            return last
        starts = np.unique(np.linspace(0, last, TRIED).astype(int))
        held = (sums[starts + count] - sums[starts]) / sums[-1]
        fitted = 1.0 - held.max(axis=1)
        if fitted[-1] >= LEAST_FITTED:
            return last
        fitted[held.mean(axis=1) < LEAST_HELD] = 0.0
        best = int(np.argmax(fitted))
        return int(starts[best]) if fitted[best] >= LEAST_FITTED else last

    def head(self) -> tuple[Trial, Trial]:
        """The rows with the first ``HEAD`` seconds of motion, at most half, and the rest."""
        moved = np.cumsum(self._moves()) * self.h
        at = int(np.searchsorted(moved, HEAD)) + 1
        at = min(at, len(self.time) // 2)
        return self.part(0, at), self.part(at, len(self.time))

    def _moves(self) -> np.ndarray:
        """The rows (n,) that move; all of them where nothing but rest is to be seen."""
        x = self.u[:, OWN[self.kind]]
        inside = marked(self.segments, len(x))
        if not self.free_rotation or not inside.any():
            return np.ones(len(x), dtype=bool)
        # A force is gravity mostly, also at rest: what is differentiated has an attitude beside it.
        speed = np.linalg.norm(x if self.place is None else self.u[:, OWN["gyro"]], axis=1)
        return inside & (speed >= MOVING * np.sqrt(np.mean(speed[inside] ** 2)))


def known_to_all(trials: Iterable[Trial]) -> frozenset[str]:
    """The signals that every one of trials knows."""
    return frozenset.intersection(*(t.known for t in trials))


def counted(trial: Trial, axis: int) -> np.ndarray:
    """The samples (k,) of an axis that regression draws on, less what stands in for others."""
    rows = marked(trial.row_segments, len(trial.y))
    if trial.healed is not None:
        rows &= trial.healed[:, axis] == 0.0
    return trial.y[rows, axis]


def marked(segments: list[tuple[int, int]], n: int) -> np.ndarray:
    """Flags (n,) that are true inside the ranges (start, stop): the contrary of ``runs``."""
    flags = np.zeros(n, dtype=bool)
    for a, b in segments:
        flags[a:b] = True
    return flags
