"""The optical reference of the paper's rover: an attitude that is right to 0.1 to 0.2 deg."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from pyimu.numerics.columns import columns_at

WANDER = np.deg2rad(0.1)
"""rad; slow error of the optical reference, Hidalgo 2012, section 6.1: 0.1 to 0.2 deg. As standard
deviation, so that most of it stays within 0.2."""

WANDER_TIME = 20.0
"""s; over which the slow error is smoothed. Assumed; the paper says nothing of it."""

NOISE = np.deg2rad(0.01)
"""rad; its white noise from sample to sample. Assumed."""


def optical_reference(
    q: np.ndarray, sample_rate: float, rng: np.random.Generator, every: int = 1
) -> np.ndarray:
    """The attitude ``q`` (n, 4) of ``sample_rate`` Hz as the optical reference gives it, (n, 4).

    Its slow error is drawn at each ``every``-th sample and goes straight between them.
    """
    knots = -(-len(q) // every) + (every > 1)
    slow = gaussian_filter1d(
        rng.standard_normal((knots, 3)), WANDER_TIME * sample_rate / every, axis=0
    )
    slow *= WANDER / slow.std()
    if every > 1:
        at = np.arange(len(q)) / every
        slow = columns_at(at, np.arange(knots), slow)
    error = slow + NOISE * rng.standard_normal(slow.shape)
    seen = Rotation.from_rotvec(error) * Rotation.from_quat(q, scalar_first=True)
    return seen.as_quat(scalar_first=True)
