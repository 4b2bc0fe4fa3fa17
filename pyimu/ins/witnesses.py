"""What else a log measures of its motion, and where that says that a rest is none.

A constant speed is a rest to every inertial sensor. Positions, velocities, a speed and a reference
tell the two apart, where they go a way that is far above their noise. They are weighed against the
sensors, too: a way that jumps, or comes up within a second, is none that a body goes which feels no
push, and the fault is theirs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding
from pyimu.ins.measured import Fixes
from pyimu.ins.track import Reference
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording
from pyimu.recording.reference.white_noise import white_noise

MOVED, MOVED_BY, MOVED_AT = 0.1, 10.0, 0.05
"""m; what a body goes at least during a rest that is none; how many standard deviations of a
position; and how fast, m/s: a receiver's position wanders by more than its noise, but no faster."""

EVEN = 0.2
"""Of a way: how far off the straight line from its start to its end, RMS, it may be. What jumps is
off by 0.29 of the step at least; noise of a tenth of the way, by 0.14 to 0.17."""

STRAIGHT = 0.7
"""Share of the ways that were seen in one rest by which it must have gone on in the end."""

FASTER = 0.1
"""m/s; least speed that counts as one: that of a receiver at rest is above 0, too. Assumed."""

SPEED_BY = 5.0
"""How many standard deviations of its mean over a second it must be."""

UNFELT = 0.5
"""m/s^2; a change of a speed that no body has which looks still: over a second a tenth of it
shows. Assumed."""

REFERENCE = "reference"
"""Name of a witness that is no measurement."""

SEEN_BY = 2.0
"""How many times the least way that a position shows a speed must have gone to be refuted by it."""

FRESH = 0.5
"""Share of a time in which a way is looked for that no shorter one in it has shown."""

SHORTEST = 1.0
"""s; over which is looked, and its doubles."""


@dataclass(frozen=True)
class Witness:
    """What measures a motion: the ``name`` of it, times ``at`` (m,) s, and ``values`` (m, d): the
    places in m, or the velocities in m/s of what is ``fast``, with the standard deviation ``std``.
    """

    name: str
    at: np.ndarray
    values: np.ndarray
    std: float
    fast: bool = False

    def moves(self, time: np.ndarray, still: np.ndarray) -> np.ndarray:
        """Marks (n,) of the rows of the rests ``still`` (n,), at their ``time`` (n,) s, that are
        none.
        """
        found = np.zeros(len(time), dtype=bool)
        for start, stop in runs(still):
            own = slice(*np.searchsorted(self.at, [time[start], time[stop - 1] + 1e-9]))
            seen = list(self._by_speed(own) if self.fast else self._by_way(own))
            seen = seen if self._is_straight(seen) else []
            longest = 0.0
            for first, last, beside in seen:
                a, b = np.searchsorted(time, [first - beside, last + beside + 1e-9])
                found[max(a, start) : min(b, stop)] = True
                longest = max(longest, beside)
            for a, b in runs(~found[start:stop]):  # too short to show that they move, too
                if time[start + b - 1] - time[start + a] < longest:
                    found[start + a : start + b] = True
        return found

    def _is_straight(self, seen: list[tuple[float, float, float]]) -> bool:
        """Whether what was seen in one rest goes one way: what looks still does not turn, and what
        wanders, as a receiver's errors do over seconds, goes to and fro.
        """
        steps = []
        for first, last, _ in seen:
            values = self.values[slice(*np.searchsorted(self.at, [first, last + 1e-9]))]
            steps.append(values.mean(axis=0) if self.fast else values[-1] - values[0])
        ways = np.array(steps)
        if not len(ways):
            return False
        gone = float(np.linalg.norm(ways, axis=1).sum())
        return float(np.linalg.norm(ways.sum(axis=0))) > STRAIGHT * gone

    def way(self, first: float, last: float) -> float:
        """m; from the place at one time to that at another."""
        own = slice(*np.searchsorted(self.at, [first, last + 1e-9]))
        at, values = self.at[own], self.values[own]
        if not len(at):
            return 0.0
        if not self.fast:
            return float(np.linalg.norm(values[-1] - values[0]))
        return float(np.linalg.norm(np.trapezoid(values, at, axis=0)))

    def _by_way(self, own: slice) -> Iterator[tuple[float, float, float]]:
        """From when to when s the places go a way that is even, by the shortest times that show
        one, and how near to that s it may have begun.
        """
        at, place, length = self.at[own], self.values[own], SHORTEST
        least = max(MOVED, MOVED_BY * self.std)
        free = np.ones(len(at), dtype=bool)
        while len(at) > 2 and length <= at[-1] - at[0]:
            found = [
                (a, b)
                for a, b in _windows(at, length)
                if free[a : b + 1].mean() >= FRESH
                and _is_way(at[a : b + 1], place[a : b + 1], least)
            ]
            for a, b in found:
                free[a : b + 1] = False
                yield at[a], at[b], length / 2
            length *= 2

    def _by_speed(self, own: slice) -> Iterator[tuple[float, float, float]]:
        """From when to when s a mean over a second is a speed; none where the speed changes as
        nothing does that looks still.
        """
        at, values = self.at[own], self.values[own]
        if len(at) < 2:
            return
        begins = np.arange(at[0], max(at[-1] - SHORTEST, at[0]) + SHORTEST / 2, SHORTEST / 2)
        edges = np.searchsorted(at, [begins, begins + SHORTEST]).T
        seen = edges[:, 1] > edges[:, 0]
        begins, edges = begins[seen], edges[seen]
        means = np.array([np.median(values[a:b], axis=0) for a, b in edges])
        # Beside a gap they are further apart, and any speed may come up in it.
        next_to = begins[2:] - begins[:-2] < 1.5 * SHORTEST
        changes = np.linalg.norm(means[2:] - means[:-2], axis=1)
        if np.any(changes[next_to] > UNFELT * SHORTEST):
            return
        for (a, b), mean in zip(edges, means, strict=True):
            least = max(FASTER, SPEED_BY * self.std / np.sqrt(b - a))
            if np.linalg.norm(mean) > least:
                yield at[a], at[b - 1], SHORTEST / 2


def _windows(at: np.ndarray, length: float) -> Iterator[tuple[int, int]]:
    """The first and the last of the times (m,) in each ``length`` s, a quarter of it apart."""
    starts = np.arange(at[0], at[-1] - length + length / 8, length / 4)
    for a in np.unique(np.searchsorted(at, starts - 1e-9)):
        b = int(np.searchsorted(at, at[a] + length - 1e-9))
        if a + 1 < b < len(at):
            yield int(a), b


def _is_way(at: np.ndarray, place: np.ndarray, least: float) -> bool:
    """Whether places (m, d) at times (m,) go ``least`` m or more, faster than ``MOVED_AT`` and
    evenly.
    """
    seconds, step = at[-1] - at[0], place[-1] - place[0]
    way = float(np.linalg.norm(step))
    if way < max(least, MOVED_AT * seconds):
        return False
    off = place - place[0] - np.outer((at - at[0]) / seconds, step)
    return float(np.sqrt(np.mean(np.sum(off**2, axis=1)))) < EVEN * way


def witnesses_of(
    recording: Recording, fixes: Fixes | None, reference: Reference | None
) -> list[Witness]:
    """What of a recording tells a motion beside gyro and accelerometer, the measurements first."""
    out, time = [], recording.time
    if fixes is not None and len(fixes.rows):
        claimed = float(np.sqrt(np.median(fixes.columns["position_variance"][fixes.rows])))
        out += _of_places("position", time[fixes.rows], fixes.position, claimed)
    if fixes is not None and np.any(rows := fixes.columns.get("velocity_valid", np.zeros(1)) > 0):
        values = np.column_stack([fixes.columns[f"velocity_measured[{i}]"] for i in (1, 2, 3)])
        claimed = float(np.sqrt(np.median(fixes.columns["velocity_variance"][rows])))
        known = _known_axes(values[rows])
        out.append(Witness("velocity", time[rows], known, claimed, fast=True))
    if recording.speed is not None and np.isfinite(recording.speed).any():
        rows = np.isfinite(recording.speed)
        speed = recording.speed[rows][:, None]
        std = recording.speed_std
        claimed = white_noise(speed) if std is None else float(np.nanmedian(std[rows]))
        out.append(Witness("speed", time[rows], speed, claimed, fast=True))
    if reference is not None:
        out += _of_places(REFERENCE, time[reference.rows], reference.position, 0.0)
    return out


def _of_places(name: str, at: np.ndarray, place: np.ndarray, claimed: float) -> list[Witness]:
    """The witness that places (m, 3) are, by the larger of the ``claimed`` and the shown noise."""
    known = _known_axes(place)
    noise = white_noise(known)
    noise = claimed if not np.isfinite(noise) else max(noise, claimed)
    return [Witness(name, at, known, noise)] if noise or len(at) >= 8 else []


def _known_axes(values: np.ndarray) -> np.ndarray:
    """The values (m, 3) of the axes that are known in each row."""
    return values[:, np.isfinite(values).all(axis=0)]


def denied(
    time: np.ndarray, still: np.ndarray, witnesses: list[Witness]
) -> tuple[np.ndarray, list[Finding]]:
    """Marks (n,) of the rows of the rests ``still`` (n,) that a witness says to be none, and what
    it says.
    """
    marks, out = np.zeros(len(time), dtype=bool), []
    for witness in witnesses:
        found = witness.moves(time, still) & ~marks
        if witness.fast:
            found &= ~_refuted(witness, time, found, [w for w in witnesses if not w.fast])
        if found.any():
            out.append(_finding(witness.name, time, found))
        marks |= found
    return marks, out


def _refuted(
    witness: Witness, time: np.ndarray, found: np.ndarray, places: list[Witness]
) -> np.ndarray:
    """Marks (n,) of what a speed says to move and positions to stand, that would show its way: of
    wheels that slip, or of a counter that hangs.
    """
    marks = np.zeros(len(time), dtype=bool)
    for start, stop in runs(found):
        seen = []
        for place in places:
            # Where a place is known, and only there, it tells.
            a, b = np.searchsorted(place.at, [time[start], time[stop - 1] + 1e-9])
            ends = (place.at[a], place.at[b - 1]) if b - a > 1 else (0.0, 0.0)
            said = witness.way(*ends)
            if b - a > 1 and said > SEEN_BY * max(MOVED, MOVED_BY * place.std):
                seen.append(place.way(*ends) < said / SEEN_BY)
        marks[start:stop] = bool(seen) and all(seen)
    return marks


def _finding(name: str, time: np.ndarray, found: np.ndarray) -> Finding:
    parts = runs(found)
    seconds = [float(time[b - 1] - time[a]) for a, b in parts]
    detail = {"first": float(time[parts[0][0]]), "seconds": sum(seconds), "longest": max(seconds)}
    return Finding("rest_denied", name, len(parts), detail)


def rests_that_move(
    time: np.ndarray, still: np.ndarray, witnesses: list[Witness]
) -> Iterator[Finding]:
    """What a witness says of the rests ``still`` (n,) by which the path was made: how far a body
    went that was to rest.
    """
    for witness in witnesses:
        marks = witness.moves(time, still)
        if witness.fast:
            marks &= ~_refuted(witness, time, marks, [w for w in witnesses if not w.fast])
        rests = [(a, b) for a, b in runs(still) if marks[a:b].any()]
        if rests:
            detail = {
                "largest": max(witness.way(time[a], time[b - 1]) for a, b in rests),
                "seconds": float(sum(time[b - 1] - time[a] for a, b in runs(marks))),
                "first": float(time[rests[0][0]]),
            }
            yield Finding("rest_moves", witness.name, len(rests), detail)
