"""Samples that look like spikes, and that the reference bears out: the body was struck.

A foot that meets the ground, or a robot a kerb, has single samples far off their neighbours, as a
corrupt row has. Where these stand in for it, the force that the reference saw is missing, and an
effect is made of it. Of the two, what the reference shows about the sample tells which it was.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN
from pyimu.recording.clock import runs

BORNE_OUT = 0.5
"""Share of a spike that must be in the sensor for the reference to fit: of a corrupt sample it is
none, of a true one all, and the half is the border of what is likelier in noise of any size."""


def as_struck(trial: Trial) -> Trial:
    """The trial with the samples that its reference bears out as they were measured."""
    if trial.healed is None or trial.band_hz is None or not trial.segments:
        return trial
    axes = list(trial.axes)
    shape = in_band(trial, trial.healed[:, axes])
    near = (shape != 0.0).any(axis=1)
    left = _left(trial, near)
    if left is None:
        return trial
    weight = 1.0 / np.maximum(np.var(left[~near], axis=0), 1e-300)
    kept = np.zeros(len(trial.y), dtype=bool)
    centres = trial.band.centres(trial.row_segments)
    for first, stop in runs(near):
        own, miss = shape[first:stop], left[first:stop]
        # What the neighbours' value is off by is the sample's share of what was taken off it.
        share = float(np.sum(miss * own * weight) / np.sum(own * own * weight))
        if share < -BORNE_OUT:
            kept[centres[first] - trial.band.half : centres[stop - 1] + trial.band.half + 1] = True
    if not kept.any():
        return trial
    healed = np.where(kept[:, None], trial.healed, 0.0)
    return replace(trial, y=trial.y + healed, healed=trial.healed - healed)


def _left(trial: Trial, near: np.ndarray) -> np.ndarray | None:
    """What the reference, as it is mounted and placed, leaves of the sensor (m, axes) in the band,
    by the rows that are not ``near`` spikes; None where these are too few.
    """
    axes = list(trial.axes)
    y, x = (in_band(trial, v[:, axes]) for v in (trial.y, trial.u[:, OWN[trial.kind]]))
    forces = [] if trial.place is None else [trial.place.forces[k].T for k in trial.place.unknown]
    arms = [in_band(trial, f[:, axes]) for f in forces]
    known = np.column_stack([np.ones(len(y)), x, *arms])
    if np.count_nonzero(~near) < 4 * known.shape[1]:
        return None
    found = np.linalg.lstsq(known[~near], y[~near], rcond=None)[0]
    return y - known @ found
