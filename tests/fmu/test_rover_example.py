"""The example that wires the rover's units with fmpy: short, and what it prints is Python's."""

import subprocess
import sys

import numpy as np
from places import CHECKOUT

from pyimu.attitude import attitude_ukf
from pyimu.model.part_file import part
from pyimu.plant.low_pass import low_pass
from pyimu.plant.rover_drive import rover_drive

EXAMPLE = CHECKOUT / "examples" / "rover_fmpy.py"
SECONDS = 61.0


def in_python(n):
    """Errors of heading, pitch and roll in deg after n samples.

    Each unit in turn takes the samples of the one before: in the example a unit steps after the one
    that feeds it, so that nothing is late.
    """
    imt30 = part("imt30")
    drive, estimator = rover_drive(imt30.sample_period), attitude_ukf(imt30)
    names = [v.name for v in drive.outputs]
    truth = drive.run(np.tile(drive.start_inputs, (n, 1)))[0]
    first, columns = names.index("rate[1]"), names.index("temperature")
    moved = np.column_stack([truth[:, first : first + 6], truth[:, columns]])
    measured = imt30.block.run(moved, seed=1)[0]
    smooth = low_pass(imt30.sample_period).run(measured[:, :6])[0]
    u = np.tile(estimator.start_inputs, (n, 1))
    u[:, :7] = np.column_stack([smooth, measured[:, 6]])
    p = estimator.start.copy()
    p[[v.name for v in estimator.parameters].index("latitude")] = np.deg2rad(52.22)
    found = estimator.run(u, p=p)[0][-1]
    shown = [v.name for v in estimator.outputs]
    return [
        np.rad2deg(found[shown.index(name)] - truth[-1, names.index(name)])
        for name in ("yaw", "pitch", "roll")
    ]


def test_the_example_prints_the_errors_of_the_chain_in_python():
    """A second into the turn, to the last figure that it prints."""
    assert len(EXAMPLE.read_text(encoding="utf-8").splitlines()) < 60
    done = subprocess.run(
        [sys.executable, EXAMPLE, str(SECONDS)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    *_, last = done.stdout.splitlines()
    assert last.split()[0] == "61.0" and float(last.split()[1]) > 0.1
    want = in_python(round(SECONDS / part("imt30").sample_period))
    np.testing.assert_allclose([float(w) for w in last.split()[2:]], want, atol=0.5e-3 + 1e-9)
