"""The compiled step gives the bits of casadi's virtual machine, and its absence goes unnoticed."""

import numpy as np
import pytest

import pyimu
from pyimu import native
from pyimu.attitude import attitude_ukf
from pyimu.block import step_through


@pytest.fixture
def blocks():
    part = pyimu.part("imt30")
    return [part.block, attitude_ukf(part)]


def inputs(block, rows, rng):
    u = rng.standard_normal((rows, len(block.inputs)))
    u[:, [i for i, v in enumerate(block.inputs) if v.kind == "boolean"]] = rng.integers(0, 2, (rows, 1))
    u[rows // 2] = np.nan
    return u


def test_compiled_step_equals_the_virtual_machine_bit_for_bit(blocks, monkeypatch):
    monkeypatch.setattr(native, "WORTHWHILE", 0)
    for block in blocks:
        rng = np.random.default_rng(1)
        u, w = inputs(block, 400, rng), rng.standard_normal((400, len(block.noise)))
        s = np.array(block.initial(block.start)[0], dtype=float).ravel()
        want = np.empty((400, len(block.outputs)))
        last = step_through(block.step, s.copy(), u, block.start, w, np.array([block.sample_period]), want)
        assert native.compiled(block.step, 400) is not None
        y, state = block.run(u, w=w)
        np.testing.assert_array_equal(y, want)
        np.testing.assert_array_equal(state, last)


def test_without_a_compiler_the_run_is_the_same(blocks, monkeypatch):
    u = inputs(blocks[0], 50, np.random.default_rng(2))
    want = blocks[0].run(u)[0]
    monkeypatch.setattr(native, "WORTHWHILE", 0)
    monkeypatch.setenv("CC", "no-such-compiler")
    native._load.cache_clear()
    np.testing.assert_array_equal(blocks[0].run(u)[0], want)
    native._load.cache_clear()


def test_short_runs_are_not_compiled(blocks):
    assert native.compiled(blocks[0].step, 100) is None
