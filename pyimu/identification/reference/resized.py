"""How far a smoothing of a reference went, by what the gyro shows once it is undone.

What judges a filter fits a gain beside it. Where a body moves at few frequencies, a filter that is
a little long and a gain that is a little large are alike to it, and the gain would be the sensor's
scale factor in the end. Of attitudes a filter that is off by a little leaves what one axis turns
another by, besides, which no gain makes, and which looks like coning.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.above import if_longer, smoothing_of, with_gyro_above
from pyimu.identification.reference.behind import Undo
from pyimu.identification.reference.moving import in_own_band, moving_rows
from pyimu.model.kinds import OWN
from pyimu.numerics.columns import unexplained
from pyimu.recording.reference.unsmoothed import TURNING, Smoothing, unsmoothed

MOST = 0.1
"""Share of a size by which one that was found may be off for what is left to be in proportion."""


def resized(trial: Trial) -> Undo | None:
    """What takes the smoothing out of the log of a ``trial`` by the size that leaves nothing that
    looks like it; None where none was taken out, or what is left says nothing of it.
    """
    smoothing = smoothing_of(trial, TURNING)
    if smoothing is None:
        return None
    longer = _longer(with_gyro_above(in_own_band(trial)), smoothing)
    if not abs(longer) < MOST:
        return None
    size = smoothing.size * (1.0 + longer)
    return partial(unsmoothed, smoothing=replace(smoothing, size=size))


def _longer(trial: Trial, smoothing: Smoothing) -> float:
    """By which share of its size the filter over a trial's reference is longer than the
    ``smoothing`` that was taken out; NaN where the trial does not say.

    By least squares beside a bias, all gains and a clock: by the motion as the sensor shows it,
    whose noise is little beside it, as that of what is left is the reference's.
    """
    own, rows = trial.u[:, OWN["gyro"]], moving_rows(trial)
    signals = (own, trial.y, slopes(trial, trial.y), if_longer(trial, smoothing))
    x, y, clock, made = (in_band(trial, v)[rows] for v in signals)
    along, weight = 0.0, 0.0
    for i in trial.axes:
        basis, _ = np.linalg.qr(np.column_stack([np.ones(len(x)), x[:, trial.axes], clock[:, i]]))
        left, column = (unexplained(basis, v[:, [i]])[:, 0] for v in (y, made))
        power = float(left @ left)
        if power > 0.0:
            along += float(column @ left) * len(left) / power
            weight += float(column @ column) * len(left) / power
    return -along / weight if weight else np.nan
