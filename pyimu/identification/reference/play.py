"""Whether a reference was taken before a gear with play, from what the gyro shows behind it.

What the gyro lacks after each reversal is no effect of a sensor: it depends on which way the body
turned last, and is one angle whatever the rate. Of play the gyro lacks all that the play says, no
less; a share of it that any other error leaves is not taken for play.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.columns import band_segments, band_time, in_band
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.trial import Trial, marked
from pyimu.identification.fit.whiten import Autoregressive
from pyimu.identification.reference.moving import LEAST_ROWS, in_own_band
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.numerics.columns import unexplained
from pyimu.recording.recording import Recording
from pyimu.recording.reference.play import JOINTS, Joint, stays_behind, without_play

LIKELIER = 50.0
"""nat that a play must explain beyond what one backward in time does, which makes a reference as
much quieter at rest: of logs without play none explains more than a few."""

WIDTHS = np.radians(0.01) * 4.0 ** np.arange(5)
"""rad; that are tried first, from a hundredth of a degree to that of a worn toy's servo; each
explains half and more of a play that is not three times as wide, or as narrow."""

STEP, NEAR = 2.0**0.25, 6
"""From width to width of those near to one that was found, and how many to either side."""

LEAST = 0.1
"""Share of what the first play explains that a further one must: what a body's swinging leaves of
one looks like a little of another."""

ACROSS = float(np.cos(np.radians(45.0)))
"""Cosine between the axes of two joints, in the mean, at most; else they are one."""

CLOSE = 1e-3
"""Share of a width to which it is found."""


def unplayed(trial: Trial) -> Callable[[Recording], Recording] | None:
    """What takes the play out of the reference of a gyro's log; None where there is none."""
    if trial.kind != "gyro" or trial.reference != "attitude" or len(trial.axes) < 3:
        return None
    widths: dict[Joint, float] = {}
    left, least = list(JOINTS), LIKELIER
    while left:
        judge = _Judge(_behind(trial, widths))
        if not judge.enough:
            return None
        gains = {(j, float(w)): judge.gain(j, float(w)) for j, w in product(left, WIDTHS)}
        (joint, width), gain = max(gains.items(), key=lambda one: one[1])
        if gain < least or gain - judge.gain(joint, width, backward=True) < LIKELIER:
            break
        widths[joint] = judge.width(joint, width)
        left = [j for j in left if _along(trial, j, joint) < ACROSS]
        least = max(least, LEAST * gain)
    if not widths:
        return None
    # Once more, each beside the others.
    for joint, width in widths.items() if len(widths) > 1 else ():
        others = {j: w for j, w in widths.items() if j != joint}
        widths[joint] = _Judge(_behind(trial, others)).width(joint, width)
    return partial(without_play, widths=widths)


def _along(trial: Trial, one: Joint, other: Joint) -> float:
    """Cosine between the axes of two joints, in the mean over the rows that are known."""
    rows = marked(trial.segments, len(trial.time))
    q = Rotation.from_quat(trial.u[rows, COLUMNS["attitude"]], scalar_first=True)
    return float(np.mean(np.abs(np.sum(one.axis(q) * other.axis(q), axis=1))))


def _behind(trial: Trial, widths: dict[Joint, float]) -> Trial:
    """The trial with the reference's rate as it is behind plays of ``widths``."""
    u = copied(trial.u)
    for joint, width in widths.items():
        u[:, OWN[trial.kind]] += _change(trial, joint, width)
    return replace(trial, u=u)


def _change(trial: Trial, joint: Joint, width: float, backward: bool = False) -> np.ndarray:
    """What a play changes of the reference's rate (n, 3) in rad/s."""
    out = np.zeros((len(trial.time), 3))
    for a, b in trial.segments:
        rate = trial.u[a:b, OWN[trial.kind]]
        q = trial.u[a:b, COLUMNS["attitude"]]
        axis = joint.axis(Rotation.from_quat(q, scalar_first=True))
        turns = np.sum(rate * axis, axis=1) * trial.h
        late = stays_behind(turns, width, backward)
        out[a:b] = axis * (np.gradient(late, trial.h) if b - a > 1 else late)[:, None]
    return out


class _Judge:
    """What plays explain of the gyro, beside its bias, its gains and two derivatives of the motion,
    which a clock, a bandwidth or a smoothed reference make.
    """

    def __init__(self, trial: Trial) -> None:
        self.trial = in_own_band(trial)
        rate = trial.u[:, OWN[trial.kind]]
        first = slopes(trial, rate)
        columns = np.column_stack([np.ones(len(rate)), rate, first, slopes(trial, first)])
        x, y = (in_band(self.trial, v) for v in (columns, trial.y))
        self.time, self.segments = band_time(self.trial), band_segments(self.trial)
        self.enough = len(y) > LEAST_ROWS * x.shape[1]
        if not self.enough:
            return
        left = y - x @ np.linalg.lstsq(x, y)[0]
        self.known = []
        for shown, rest in zip(y.T, left.T, strict=True):
            noise = Autoregressive.fit([(rest, self.time, self.segments)])
            white = self._white(noise, np.column_stack([x, shown]))
            basis, _ = np.linalg.qr(white[:, :-1])
            self.known.append((noise, basis, unexplained(basis, white[:, -1])))

    def gain(self, joint: Joint, width: float, backward: bool = False) -> float:
        """nat that a play of a ``width`` explains."""
        change = in_band(self.trial, _change(self.trial, joint, width, backward))
        gain = 0.0
        for column, (noise, basis, left) in zip(change.T, self.known, strict=True):
            moved = unexplained(basis, self._white(noise, column[:, None])[:, 0])
            gain -= 0.5 * len(left) * np.log(np.sum((left - moved) ** 2) / np.sum(left**2))
        return float(gain)

    def width(self, joint: Joint, near: float) -> float:
        """The width of a play that explains most, within a factor of three of one that is near."""
        tried = near * STEP ** np.arange(-NEAR, NEAR + 1)
        best = max(tried, key=lambda w: self.gain(joint, float(w)))
        found = minimize_scalar(
            lambda x: -self.gain(joint, float(np.exp(x))),
            bounds=(np.log(best / STEP), np.log(best * STEP)),
            method="bounded",
            options={"xatol": CLOSE},
        )
        return float(np.exp(found.x))

    def _white(self, noise: Autoregressive, columns: np.ndarray) -> np.ndarray:
        return noise.whiten(columns, self.time, self.segments)
