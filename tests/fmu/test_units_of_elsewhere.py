"""Units of the part imt30 that another machine built, in the folder PYIMU_UNITS: here they give the
bits of Python, noise and all.

So that what is cross-compiled for a platform is run on it, as in .github/workflows/tests.yml.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from pyimu.fmu import FORMS, simulate, simulate_blocks
from pyimu.fmu.build import file_name
from pyimu.model.part_file import part

FOLDER = os.environ.get("PYIMU_UNITS")

pytestmark = pytest.mark.skipif(FOLDER is None, reason="needs units, in a folder PYIMU_UNITS")

BLOCK = part("imt30").block


@pytest.mark.parametrize("form", FORMS)
def test_the_sensor_gives_the_bits_of_python(form):
    rng = np.random.default_rng(8)
    start = np.array([v.start for v in BLOCK.inputs])
    inputs = start + 0.1 * rng.standard_normal((20_000, len(start)))
    run = simulate_blocks if form == "block" else simulate
    unit = Path(FOLDER, file_name(BLOCK.name, form))
    outputs = run(unit, inputs, sample_period=BLOCK.sample_period, start_values={"seed": 11})
    np.testing.assert_array_equal(outputs[1:], BLOCK.run(inputs, seed=11)[0])
