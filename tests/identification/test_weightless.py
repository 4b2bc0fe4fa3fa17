"""Logs whose forces are without gravity, as phones give them."""

from dataclasses import replace

from test_reference_world import sways

import pyimu
from pyimu.recording.quality.inspect import inspect


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
