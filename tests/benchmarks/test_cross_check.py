"""What benchmarks/cross_check.py writes lies where the FMI cross-check looks for it."""

import csv

import numpy as np
import pytest
from cross_check import SAMPLES, check

from pyimu.plant.low_pass import low_pass


def rows(path):
    """The names and the numbers of a CSV."""
    with path.open(newline="") as file:
        names, *lines = csv.reader(file)
    return names, np.array(lines, dtype=float)


@pytest.mark.parametrize("form", (2, 3))
def test_a_unit_its_reference_and_its_result(tmp_path, form):
    block = low_pass(0.01)
    assert check(block, form, tmp_path)
    (unit,) = tmp_path.glob(f"fmus/{form}.0/cs/*/pyimu/*/LowPass/LowPass.fmu")
    (passed,) = tmp_path.glob(f"results/{form}.0/cs/*/fmpy/*/pyimu/*/LowPass/passed")
    names, reference = rows(unit.with_name("LowPass_ref.csv"))
    again, found = rows(passed.with_name("LowPass_out.csv"))
    assert names == again == ["time", *(v.name for v in block.outputs)]
    np.testing.assert_array_equal(found, reference)
    _, inputs = rows(unit.with_name("LowPass_in.csv"))
    assert len(inputs) == SAMPLES and len(reference) == SAMPLES + 1
    y, _ = block.run(inputs[:, 1:])
    np.testing.assert_array_equal(reference[1:, 1:], y)
    options = dict(
        line.split(", ") for line in unit.with_name("LowPass_ref.opt").read_text().splitlines()
    )
    assert float(options["StopTime"]) == SAMPLES * 0.01 and float(options["StepSize"]) == 0.01
