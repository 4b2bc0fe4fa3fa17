"""A reference attitude in another order, or in other axes, is said beside the error it makes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_attitude_headed import hand, robot, turning

from pyimu import attitude
from pyimu.identification.reference.order import ORDERS as OF_CLOSE
from pyimu.recording.reference.orders import ORDERS

NED = Rotation.from_matrix([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
FRD = Rotation.from_matrix(np.diag([1, -1, -1]))


def as_quat(rotation: Rotation) -> np.ndarray:
    return rotation.as_quat(scalar_first=True)


WRITTEN = {
    "scalar last (x, y, z, w)": lambda r: r.as_quat(),
    "world to body": lambda r: as_quat(r.inv()),
    "a world of north-east-down": lambda r: as_quat(NED.inv() * r),
    "a body of forward-right-down": lambda r: as_quat(r * FRD),
    "north-east-down and forward-right-down": lambda r: as_quat(NED.inv() * r * FRD),
    "world to body, in north-east-down and forward-right-down": lambda r: as_quat(
        (NED.inv() * r * FRD).inv()
    ),
}


@pytest.fixture(scope="module")
def found():
    """A run over a hand that turns, and the true attitude."""
    recording, _ = turning(hand())
    result = attitude.run(recording)
    rng = np.random.default_rng(1)
    reference = Rotation.from_quat(result.q, scalar_first=True) * Rotation.from_rotvec(
        rng.normal(0, 0.01, (len(recording), 3))
    )
    return result, reference


def beside(result, q):
    return replace(result, recording=replace(result.recording, ref_q=q))


@pytest.mark.parametrize("order", WRITTEN)
def test_the_order_that_fits_is_named(found, order):
    result, reference = found
    seen = beside(result, WRITTEN[order](reference))
    (finding,) = [f for f in seen.findings if f.kind == "reference_order"]
    assert finding.detail["as"] == order
    lines = seen.report().splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("  error"))
    assert f"read as {order}, ref_q is" in lines[at + 1] and finding.detail["rms"] < 0.05


@pytest.mark.parametrize(
    "off",
    [
        0.0,
        pytest.param(0.05, marks=pytest.mark.long),
        0.5,
        pytest.param(1.5, marks=pytest.mark.long),
    ],
)
def test_one_that_is_as_stated_is_left_alone(found, off):
    """However far the estimate is off."""
    result, reference = found
    rng = np.random.default_rng(2)
    away = reference * Rotation.from_rotvec(off * rng.normal(size=(len(result.time), 3)))
    for q in (as_quat(away), as_quat(Rotation.from_rotvec([0, 0, off]) * reference)):
        assert not [f for f in beside(result, q).findings if f.kind == "reference_order"]


def test_of_a_level_robot_too():
    recording, yaw = turning(robot())
    truth = Rotation.from_euler("z", yaw[:, None])
    result = attitude.run(recording)
    right = beside(result, as_quat(truth))
    assert not [f for f in right.findings if f.kind == "reference_order"]
    down = beside(result, as_quat(NED.inv() * truth * FRD))
    assert [f.kind for f in down.findings if "order" in f.kind] == ["reference_order"]


def test_orders_are_those_of_close():
    assert OF_CLOSE is ORDERS
