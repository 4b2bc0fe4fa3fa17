"""Samples far off their neighbours are kept where the reference shows that the body was struck."""

from dataclasses import replace

import numpy as np
import pytest

from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.struck import as_struck
from pyimu.model.kinds import OWN
from pyimu.model.signals import N_INPUT

H, N, BAND = 0.01, 4000, 8.0
STRUCK, CORRUPT = (700, 1900, 3100), (1200, 2600)


def trial(seed: int, kind: str) -> Trial:
    """A body that is struck three times, and two corrupt samples, all of which neighbours stand in
    for; the sensor's scale factor is 1 % off, and it is mounted askew.
    """
    rng = np.random.default_rng(seed)
    t = H * np.arange(N)
    tones = rng.uniform(0.3, 3.0, (4, 3))
    moved = sum(np.sin(2 * np.pi * f * t[:, None] + rng.uniform(0, 6, 3)) for f in tones)
    off = np.zeros((2, N, 3))
    off[0, STRUCK, :] = rng.uniform(10, 20, (3, 3)) * rng.choice([-1, 1], (3, 3))
    off[1, CORRUPT, :] = rng.uniform(10, 20, (2, 3))
    u = np.zeros((N, N_INPUT))
    u[:, OWN[kind]] = moved + off[0] + 0.3 * rng.standard_normal((N, 3))
    turn = 1.01 * np.eye(3) + 0.02 * rng.standard_normal((3, 3))
    measured = (moved + off[0]) @ turn + off[1] + 0.02 * rng.standard_normal((N, 3))
    healed = off[0] @ turn + off[1]
    rows = ("log", kind, H, t, measured - healed, u, [(0, N)])
    return Trial(*rows, frozenset(), "attitude", BAND, healed=healed)


@pytest.mark.parametrize("kind", ["gyro", "accel"])
@pytest.mark.parametrize("seed", range(5))
def test_what_the_reference_saw_is_kept_and_what_it_did_not_see_is_not(seed, kind):
    before = trial(seed, kind)
    after = as_struck(before)
    changed = np.flatnonzero((after.y != before.y).any(axis=1))
    assert changed.tolist() == list(STRUCK)
    assert np.allclose(after.y[list(STRUCK)], (before.y + before.healed)[list(STRUCK)])
    assert np.flatnonzero(after.healed.any(axis=1)).tolist() == list(CORRUPT)


def test_a_part_of_a_trial_has_its_own_spikes():
    whole = trial(9, "accel")
    assert np.array_equal(whole.part(1000, 3000).healed, whole.healed[1000:3000])
    assert as_struck(whole.part(1000, 1500)).y.tolist() == whole.y[1000:1500].tolist()


def test_without_spikes_nothing_is_done():
    clean = replace(trial(10, "gyro"), healed=None)
    assert as_struck(clean) is clean
