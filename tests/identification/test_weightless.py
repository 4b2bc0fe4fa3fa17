"""Logs whose forces are without gravity, as phones give them."""

from dataclasses import replace

import numpy as np
from test_reference_world import sways

import pyimu
from pyimu.recording.quality.inspect import inspect
from pyimu.recording.recording import Recording


def test_forces_without_gravity_are_no_accelerometers():
    """Where gravity is missing its lack was a formula of the accelerometer."""
    log = sways()
    weightless = replace(log, accel=log.accel * 0.02)
    (said,) = [f for f in inspect(weightless) if f.kind == "no_gravity"]
    assert 0.1 < said.detail["magnitude"] < 0.3
    assert not [f for f in inspect(log) if f.kind == "no_gravity"]
    closed = pyimu.close(weightless)
    assert not closed.added and not closed.formulas
    assert "the forces of hand are without gravity" in closed.report()
    assert closed.verdict == "undecidable"


def test_forces_of_a_body_that_is_turned_over_have_gravity():
    """Their middle is none."""
    rows = np.repeat(np.vstack([np.eye(3), -np.eye(3)]), 500, axis=0)
    force = 9.80665 * rows + 0.01 * np.random.default_rng(3).standard_normal(rows.shape)
    log = Recording.from_arrays(
        "faces", time=0.01 * np.arange(len(rows)), gyro=np.zeros(rows.shape), accel=force
    )
    assert not [f for f in inspect(log) if f.kind == "no_gravity"]
