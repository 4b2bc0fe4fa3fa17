"""Where the force of a reference acts, as it and the accelerometer show it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.band import BEYOND
from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.inputs import copied, own_rate
from pyimu.identification.fit.place import GRAVITY, HEADING
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.moving import (
    LEAST_ROWS,
    in_own_band,
    moving_rows,
    turned_onto,
)
from pyimu.identification.search.belief import CHANCE, most
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.recording.reference.band import COHERENCE

ROUNDS = 5
"""Steps in turn towards the mounting and the place."""

CLUSTER = 1.0
"""s; errors farther apart than that have nothing to do with each other."""

LEAST, MOST = 0.75, 1.5
"""Of the force that moves the body so much must be seen: less is that of other axes, more of
another unit."""

SHOWN = 0.5
"""Share of what gravity leaves that it must explain for a size to be seen."""

TOO_SMALL = 0.01
"""Share of the sensor's power below which that force tells nothing either way."""

STARTS = (0.0, 0.5 * np.pi, np.pi, -0.5 * np.pi)
"""rad; headings that the search begins with: a step of it finds what is nearer than that."""

BETTER = 0.5
"""Share of what the first start leaves that another must leave: of a body that stays level the
mounting takes any heading up."""

SAID = np.radians(1.0)
"""rad; a heading below is no more than how well cameras are levelled and aligned."""


@dataclass(frozen=True)
class _Rows:
    """What moves in a trial's own band: reference ``x`` and sensor ``y`` (m, 3) m/s^2, what a unit
    of each unknown adds to the reference, ``forces`` (k, m, 3), the force ``across`` (m, 3), and
    the ``time`` (m,) s.
    """

    x: np.ndarray
    y: np.ndarray
    across: np.ndarray
    forces: np.ndarray
    time: np.ndarray
    turns: bool

    @classmethod
    def of(cls, trial: Trial) -> _Rows:
        # A force that was given is compared as it is, sample by sample.
        seen = trial if trial.band_hz is None else in_own_band(trial)
        rows = moving_rows(seen)
        given = [trial.u[:, OWN[trial.kind]], trial.y, trial.place.across]
        given += [trial.place.forces[k].T for k in trial.place.where]
        x, y, across, *forces = (_centred(in_band(seen, v)[rows]) for v in given)
        return cls(x, y, across, np.array(forces), seen.row_time[rows], trial.free_rotation)

    @property
    def few(self) -> bool:
        return len(self.y) < LEAST_ROWS

    def found(self) -> tuple[np.ndarray, np.ndarray]:
        """The unknowns (k,), and the rotation (3, 3) of the mounting, by least squares."""
        place = np.zeros(len(self.forces))
        for _ in range(ROUNDS if self.turns else 1):
            moved = self.x + np.tensordot(place, self.forces, 1)
            turn = turned_onto(moved, self.y) if self.turns else np.eye(3)
            left = (self.y - self.x @ turn).ravel()
            place = np.linalg.lstsq(self._columns(turn), left, rcond=1e-6)[0]
        return place, turn

    def left(self, place: np.ndarray, turn: np.ndarray) -> float:
        """Sum of squares of what they leave."""
        return float(np.sum((self.y - (self.x + np.tensordot(place, self.forces, 1)) @ turn) ** 2))

    def headed(self, angle: float) -> _Rows:
        """The rows with the positions' world turned by an ``angle`` rad about the vertical."""
        sine, cosine, ahead = np.sin(angle), np.cos(angle), self.forces[-1]
        across = cosine * self.across + sine * ahead
        forces = [*self.forces[:-1], cosine * ahead - sine * self.across]
        x = self.x + across - self.across
        return replace(self, x=x, across=across, forces=np.array(forces))

    def errors(self, place: np.ndarray) -> np.ndarray:
        """Standard errors (k,) of the unknowns, whatever the spectrum of what they leave: it is
        taken to be independent from cluster to cluster (Liang and Zeger 1986, Biometrika 73).
        """
        known = self._columns(np.eye(3))
        left = (self.y - self.x).ravel() - known @ place
        inverse = np.linalg.pinv(known.T @ known)
        number = np.repeat((self.time - self.time[0]) // CLUSTER, 3).astype(int)
        each = [np.bincount(number, weights=c * left) for c in known.T]
        return np.sqrt(np.diag(inverse @ (np.array(each) @ np.array(each).T) @ inverse))

    def _columns(self, turn: np.ndarray) -> np.ndarray:
        return (self.forces @ turn).reshape(len(self.forces), -1).T


def _centred(values: np.ndarray) -> np.ndarray:
    return values - values.mean(axis=0) if len(values) else values


def placed(trial: Trial) -> Trial:
    """The trial with its reference force about where the sensor is, as far as the two show it."""
    if trial.place is None or not trial.segments:
        return trial
    rows, place = _Rows.of(trial), trial.place
    if rows.few:
        return trial
    u, own = copied(trial.u), OWN[trial.kind]
    if is_differentiated(trial):
        angle = _heading(rows)
        u[:, own] += place.headed(angle)
        rows, place = rows.headed(angle), place.by(u)
    u[:, own] += np.tensordot(rows.found()[0], place.forces[list(place.where)], 1).T
    return replace(trial, u=u, place=place)


def headed(trial: Trial) -> Trial:
    """The trial with the positions in the world of the attitudes, whose headings may count from
    other directions; that is said where it is more than ``SAID``.
    """
    if not is_differentiated(trial) or not trial.segments:
        return trial
    rows, place = _Rows.of(trial), trial.place
    angle = 0.0 if rows.few else _heading(rows)
    u = copied(trial.u)
    u[:, OWN[trial.kind]] += place.headed(angle)
    findings = trial.findings
    if abs(angle) > SAID:
        way = "counter-clockwise" if angle > 0.0 else "clockwise"
        turned = {"degrees": float(np.degrees(abs(angle))), "way": way}
        findings += (Finding("reference_heading", trial.kind, 1, turned),)
    return replace(with_force(trial, u), findings=findings)


def quietened(trial: Trial) -> Trial:
    """The trial with its force and the body's rate low-passed above its band: the noise
    of what is differentiated grows with the frequency, and what is not linear, as an arm's
    centripetal force, would bring it down into the band.
    """
    place = replace(trial.place, cutoff=BEYOND * trial.band_hz)
    u = copied(trial.u)
    for at in (OWN[trial.kind], COLUMNS["rate"]):
        u[:, at] = place.below(u[:, at], trial.segments)
    return with_force(replace(trial, place=place), u)


def with_force(trial: Trial, u: np.ndarray) -> Trial:
    """The trial with the force in inputs (n, N_INPUT), and what follows from it."""
    own, rate = OWN[trial.kind], own_rate(trial.kind)
    for a, b in trial.segments:
        if b - a > 1:
            u[a:b, rate] = np.gradient(u[a:b, own], trial.time[a:b], axis=0)
    return replace(trial, u=u, place=trial.place.by(u))


def at_the_point(trial: Trial) -> np.ndarray:
    """The force (n, 3) that the sensor shows, about where its reference force acts and in the axes
    of that.
    """
    rows, place = _Rows.of(trial), trial.place
    if rows.few:
        return trial.y
    found, turn = rows.found()
    away = np.zeros(len(place.forces))
    away[list(place.where)] = found
    return trial.y @ turn.T - np.tensordot(away[:GRAVITY], place.forces[:GRAVITY], 1).T


def is_differentiated(trial: Trial) -> bool:
    """Whether the force of a trial follows from positions or velocities."""
    return trial.place is not None and trial.place.gravity_std > 0.0


def _heading(rows: _Rows) -> float:
    """By how much the positions' world is turned about the vertical, rad."""
    best, least = 0.0, np.inf
    for start in STARTS:
        angle = start
        for _ in range(ROUNDS):
            angle += rows.headed(angle).found()[0][-1]
        there = rows.headed(angle)
        left = there.left(*there.found())
        if left < (BETTER if start else 1.0) * least:
            best, least = angle, left
    return float(np.angle(np.exp(1j * best)))


def at_the_sensor(trial: Trial) -> Trial:
    """A trial whose force was given as it is, unless it plainly acts at another point: an arm as
    short as a sensor's own may be its size effect.
    """
    if trial.place is None:
        return trial
    rows = _Rows.of(trial)
    if rows.few:
        return replace(trial, place=None)
    arm, _ = rows.found()
    longest = most("size_effect", trial.kind, "r")
    away = np.any(np.abs(arm) > longest + CHANCE * rows.errors(arm))
    return trial if away else replace(trial, place=None)


def is_borne_out(trial: Trial) -> bool:
    """Whether the accelerometer shows the force by which positions or velocities say that the body
    moves, beside gravity, in its size; true of a body that hardly does.

    Of an attitude and positions in worlds of different axes it does not, nor of millimetres.
    """
    rows = _Rows.of(trial)
    if rows.few:
        return True
    # In the band in which they cohere; what explains less there has another size or other axes.
    if trial.clock is not None and trial.clock.explained < COHERENCE:
        return False
    place, turn = rows.found()
    place[trial.place.where.index(HEADING)] = 0.0  # of the force that is judged
    upward = trial.place.where.index(GRAVITY)
    standing = trial.place.gravity * rows.forces[upward] + np.tensordot(place, rows.forces, 1)
    moving = (rows.x - trial.place.gravity * rows.forces[upward]) @ turn
    left, power = rows.y - standing @ turn, float(np.sum(moving**2))
    factor = float(np.sum(left * moving)) / max(power, 1e-300)
    explains = factor**2 * power > SHOWN * np.sum(left**2)
    if explains and factor > MOST:
        return False
    return factor > LEAST or power < TOO_SMALL * float(np.sum(rows.y**2))
