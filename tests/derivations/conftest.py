"""What tests of the printed results share."""

import pytest

from pyimu.derivations import DERIVATIONS, Derived, Result
from pyimu.derivations.model import Check
from pyimu.derivations.process_noise.printed import PRINTED


@pytest.fixture(scope="session")
def quick():
    """Results whose checks are made up: they do not matter to printing."""
    checks = (
        Check("a & b_c of 50 %, `F**2 = 0`", 3, 1.25e-15, 2e-13),
        Check("another", 1, 0.0, 1.0),
    )
    return Derived(
        tuple(Result(d, checks, tuple(d.tables(d)) if d is PRINTED else ()) for d in DERIVATIONS)
    )
