"""The Earth's rate and that of the way over it as signals of a log."""

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.trials import gyro_trial
from pyimu.model.signals import COLUMNS
from pyimu.recording.recording import Recording

LATITUDE, EARTH, RADIUS = 0.8, 7.292115e-5, 6371008.8
SPEED = np.array([20.0, -5.0, 0.0])


def log(**more) -> Recording:
    time = np.arange(400) * 0.02
    turn = Rotation.from_euler("zyx", np.column_stack([0.5 * time, 0.1 * np.sin(time), 0.2 * time]))
    n = len(time)
    groups = {
        "gyro": np.random.default_rng(1).normal(0.0, 0.01, (n, 3)) + 0.5,
        "ref_rate": np.tile([0.5, 0.1, 0.2], (n, 1)) + 0.01 * np.sin(time)[:, None],
        "ref_q": turn.as_quat(scalar_first=True),
        "latitude": np.full(n, LATITUDE),
        "ref_velocity": np.tile(SPEED, (n, 1)),
    }
    return Recording(name="log", time=time, **{**groups, **more})


def in_body(world) -> np.ndarray:
    q = log().ref_q
    return Rotation.from_quat(q, scalar_first=True).apply(world, inverse=True)


def test_both_rates_follow_from_attitude_latitude_and_velocity():
    """Groves 2013, 2.123 and 5.44, in east-north-up, turned by scipy."""
    t = gyro_trial(log())
    assert {"earth_rate", "transport_rate"} <= t.known
    earth = EARTH * np.array([0.0, np.cos(LATITUDE), np.sin(LATITUDE)])
    way = np.array([-SPEED[1], SPEED[0], SPEED[0] * np.tan(LATITUDE)]) / RADIUS
    # Sums of nine products of numbers below one round to some 1e-15 of the rate.
    for name, world in (("earth_rate", earth), ("transport_rate", way)):
        np.testing.assert_allclose(t.u[:, COLUMNS[name]], in_body(world), atol=1e-13 * EARTH / 1e-2)


def test_a_latitude_that_is_given_stands_for_the_column():
    t = gyro_trial(log(latitude=None), latitude=LATITUDE)
    np.testing.assert_array_equal(
        t.u[:, COLUMNS["earth_rate"]], gyro_trial(log()).u[:, COLUMNS["earth_rate"]]
    )
    assert not {"earth_rate", "transport_rate"} & gyro_trial(log(latitude=None)).known


def test_a_differentiated_reference_holds_the_earths_rate_and_not_the_ways():
    t = gyro_trial(log(ref_rate=None, gyro=log().ref_rate))
    assert t.reference == "attitude"
    assert "earth_rate" not in t.known and "transport_rate" in t.known


def test_cells_that_are_missing_are_filled():
    q = np.array(log().ref_q)
    q[100] = np.nan
    latitude = np.full(400, np.nan)
    latitude[::7] = LATITUDE
    t = gyro_trial(replace(log(), ref_q=q, latitude=latitude))
    assert "earth_rate" in t.known and np.isfinite(t.u[:, COLUMNS["earth_rate"]]).all()
