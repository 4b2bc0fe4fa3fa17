"""A reference that says what a body was told to do, which it follows as behind a low-pass filter:
set points of a motion platform, a gimbal or an arm.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN
from pyimu.recording.reference.band import COHERENCE, passed
from pyimu.report.numbers import quantity

SLOWEST = 4.0
"""Hz; a low-pass of a sensor passes half the power at a higher frequency: its filters begin at 5 Hz
(``LONGEST_OWN``)."""

FRAME = 8.0
"""s; of which the spectra are made, an eighth of a hertz apart."""

LEAST_FRAMES = 12
"""Of which there must be so many: of unrelated signals three axes explain a quarter then."""

BESIDE = 3
"""Frequencies that must be coherent on either side of the one at which half the power passes."""


def told(trials: Iterable[Trial]) -> str:
    """Why a reference tells nothing of a gyro: the gyro shows its motion as behind a low-pass
    filter that is slower than any of a sensor. Nothing where none does so.
    """
    for trial in trials:
        cutoff = followed_up_to(trial)
        if cutoff:
            return (
                f"the gyro of {trial.name} follows its reference as behind a low-pass filter of "
                f"{quantity(cutoff, 'Hz', 2)}, which is slower than any of a sensor: it says what "
                "the body was told to do, or the gyro was smoothed before it was written"
            )
    return ""


def followed_up_to(trial: Trial) -> float:
    """The frequency [Hz] at which a gyro shows half the power of its reference, where the two
    cohere there and on either side, and it is below ``SLOWEST``; else zero.

    The gain is that of the linear filter of all axes that explains most (Bendat and Piersol 2010,
    chapter 7), over its value at the lowest coherent frequencies.
    """
    if trial.kind != "gyro" or trial.reference not in ("attitude", "rate"):
        return 0.0
    axes, kept = list(trial.axes), np.zeros(len(trial.time), dtype=bool)
    for start, stop in trial.segments:
        kept[start:stop] = True
    shown = np.where(kept[:, None], trial.y[:, axes], np.nan)
    given = trial.u[:, OWN[trial.kind]][:, axes]
    frequency, share, gain = passed(trial.time, shown, given, FRAME, LEAST_FRAMES)
    seen = np.flatnonzero((share >= COHERENCE) & (frequency > 0.0))
    if len(seen) < 2 * BESIDE + 1:
        return 0.0
    half = gain[seen[:BESIDE]].mean() / np.sqrt(2.0)
    above = np.flatnonzero(gain[seen] >= half)
    last = int(above[-1]) if len(above) else 0
    damped = seen[last + 1 : last + 1 + BESIDE]
    if last < BESIDE or len(damped) < BESIDE or damped[-1] - seen[last] > 2 * BESIDE:
        return 0.0
    cutoff = float(frequency[seen[last]])
    return cutoff if cutoff < SLOWEST else 0.0
