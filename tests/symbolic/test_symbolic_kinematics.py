"""The symbolic kinematics, each compared with another derivation: scipy's rotations, a matrix
exponential, Van Loan's method.
"""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from pyimu.symbolic import earth, linear, mrp, quaternion
from pyimu.symbolic import process_noise as noise
from pyimu.symbolic.van_loan import van_loan

ROUNDING = 1e-14
angles = st.floats(-3.0, 3.0)
vectors = st.tuples(angles, angles, angles).map(np.array)


def scipy_of(q) -> Rotation:
    return Rotation.from_quat(np.array(q).ravel(), scalar_first=True)


def quaternion_of(rotation: Rotation) -> ca.DM:
    return ca.DM(rotation.as_quat(scalar_first=True))


def distance(a: Rotation, b: Rotation) -> float:
    return (a.inv() * b).magnitude()


@given(vectors, vectors, vectors)
@settings(max_examples=50, deadline=None)
def test_product_rotation_and_matrix_are_scipys(a, b, v):
    ra, rb = Rotation.from_rotvec(a), Rotation.from_rotvec(b)
    qa, qb = quaternion_of(ra), quaternion_of(rb)
    assert distance(scipy_of(quaternion.product(qa, qb)), ra * rb) < ROUNDING
    np.testing.assert_allclose(
        np.array(quaternion.rotate(qa, ca.DM(v))).ravel(), ra.apply(v), atol=1e-13
    )
    np.testing.assert_allclose(np.array(quaternion.to_matrix(qa)), ra.as_matrix(), atol=ROUNDING)
    assert distance(scipy_of(quaternion.conjugate(qa)), ra.inv()) < ROUNDING


@given(vectors)
@settings(max_examples=50, deadline=None)
def test_exponential_is_scipys_rotation_vector(a):
    for scale in (1.0, 1e-2, 1e-5, 1e-12, 0.0):
        assert (
            distance(
                scipy_of(quaternion.exponential(ca.DM(scale * a))), Rotation.from_rotvec(scale * a)
            )
            < ROUNDING
        )


def test_exponential_is_continuous_where_series_takes_over():
    edge = 2 * np.sqrt(quaternion.SMALL)
    below, above = (quaternion.exponential(ca.DM([edge * (1 + e), 0, 0])) for e in (-1e-15, 1e-15))
    np.testing.assert_allclose(np.array(below), np.array(above), atol=5e-16)


def test_exponential_has_first_and_second_derivatives_at_zero():
    a = ca.SX.sym("a", 3)
    q = quaternion.exponential(a)
    slope, curvature = ca.jacobian(q, a), ca.hessian(q[0], a)[0]
    at_zero = ca.Function("f", [a], [slope, curvature])(np.zeros(3))
    np.testing.assert_array_equal(np.array(at_zero[0]), np.vstack([np.zeros(3), np.eye(3) / 2]))
    np.testing.assert_allclose(np.array(at_zero[1]), -np.eye(3) / 4, atol=1e-16)


def test_step_is_the_matrix_exponential_of_the_kinematics():
    rate, h, q = (
        np.array([0.3, -1.2, 2.0]),
        0.7,
        Rotation.from_rotvec([0.4, 0.5, -0.6]).as_quat(scalar_first=True),
    )
    x, y, z = rate
    half_rate = np.array([[0, -x, -y, -z], [x, 0, z, -y], [y, -z, 0, x], [z, y, -x, 0]]) / 2
    ours = np.array(quaternion.step(ca.DM(q), ca.DM(rate), h)).ravel()
    np.testing.assert_allclose(ours, expm(half_rate * h) @ q, atol=ROUNDING)


def test_hidalgo_discrete_kinematics_vector_first_are_the_same_rotation():
    """The paper's attitude matrix turns world into body axes and composes in the other order; the
    four numbers are the same.
    """
    rate, h, q = (
        np.array([0.3, -1.2, 2.0]),
        0.1,
        Rotation.from_rotvec([0.4, 0.5, -0.6]).as_quat(scalar_first=True),
    )
    size = np.linalg.norm(rate)
    psi, c = np.sin(size * h / 2) * rate / size, np.cos(size * h / 2)
    cross = np.array([[0, -psi[2], psi[1]], [psi[2], 0, -psi[0]], [-psi[1], psi[0], 0]])
    omega = np.block([[c * np.eye(3) - cross, psi[:, None]], [-psi[None, :], np.array([[c]])]])
    paper = omega @ np.roll(q, -1)
    ours = np.array(quaternion.step(ca.DM(q), ca.DM(rate), h)).ravel()
    np.testing.assert_allclose(np.roll(ours, -1), paper, atol=ROUNDING)


@given(st.floats(-3.1, 3.1), st.floats(-1.5, 1.5), st.floats(-3.1, 3.1))
@settings(max_examples=50, deadline=None)
def test_euler_angles_are_scipys_and_come_back(roll, pitch, yaw):
    q = quaternion.from_euler(ca.DM(roll), ca.DM(pitch), ca.DM(yaw))
    assert distance(scipy_of(q), Rotation.from_euler("ZYX", [yaw, pitch, roll])) < ROUNDING
    np.testing.assert_allclose(
        np.array(quaternion.to_euler(q)).ravel(), [roll, pitch, yaw], atol=2e-13
    )


def test_nose_up_is_negative_pitch_and_yaw_starts_in_the_east():
    def forward(*euler: float) -> np.ndarray:
        return np.array(
            quaternion.rotate(quaternion.from_euler(*map(ca.DM, euler)), ca.DM([1, 0, 0]))
        ).ravel()

    assert forward(0, -0.3, 0)[2] > 0
    np.testing.assert_allclose(forward(0, 0, np.pi / 2), [0, 1, 0], atol=1e-15)


@pytest.mark.parametrize("a", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("f", [1.0, 2.6, 4.0])
def test_crassidis_markley_mrp_comes_back(a, f):
    for angle in (1e-9, 0.1, 1.0, 2.5):
        q = quaternion_of(Rotation.from_rotvec(angle * np.array([2.0, -1.0, 2.0]) / 3))
        p = mrp.from_quaternion(q, a, f)
        np.testing.assert_allclose(np.array(mrp.to_quaternion(p, a, f)), np.array(q), atol=ROUNDING)


@pytest.mark.parametrize(
    "a, f, share", [(0.0, 2.0, 1.0), (0.5, 3.0, 1.0), (1.0, 4.0, 1.0), (1.0, 1.0, 0.25)]
)
def test_mrp_is_the_rotation_vector_to_second_order_and_a_quarter_of_it_for_unit_f(a, f, share):
    r = ca.SX.sym("r", 3)
    p = mrp.from_quaternion(quaternion.exponential(r), a, f)
    slope = ca.Function("slope", [r], [ca.jacobian(p, r)])
    curvature = ca.Function("curvature", [r], [ca.jacobian(ca.jacobian(p, r), r)])
    np.testing.assert_allclose(np.array(slope(np.zeros(3))), share * np.eye(3), atol=1e-16)
    np.testing.assert_allclose(np.array(curvature(np.zeros(3))), 0, atol=1e-16)


@pytest.mark.parametrize("degrees", [0.0, 45.0, 70.0, 90.0])
def test_normal_gravity_lies_between_equator_and_pole(degrees):
    """Somigliana's formula in its first form, by both semi-axes and the gravity at their ends (NIMA
    TR8350.2, table 3.4), whose digits allow 1e-9.
    """
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    a, b, equator, pole = 6378137.0, 6356752.3142, 9.7803253359, 9.8321849378
    ends = a * equator * c**2 + b * pole * s**2
    closed = ends / np.sqrt((a * c) ** 2 + (b * s) ** 2)
    assert abs(earth.normal_gravity(np.radians(degrees)) - closed) < 1e-9


@pytest.mark.parametrize("latitude", [-1.2, 0.0, 0.9])
def test_earth_rate_is_the_polar_axis_turned_into_east_north_up(latitude):
    """The frame at longitude zero: east is y of the Earth, up lies in the meridian."""
    up, east = np.array([np.cos(latitude), 0, np.sin(latitude)]), np.array([0, 1.0, 0])
    axes = np.array([east, np.cross(up, east), up])
    np.testing.assert_allclose(
        np.array(earth.earth_rate(latitude)).ravel(), axes @ [0, 0, 7.292115e-5], atol=1e-20
    )


@pytest.mark.parametrize("h", [1e-3, 0.7])
def test_hidalgo_process_noise_is_van_loans_without_rotation(h):
    n, k = np.array([0.2, 0.3, 0.25]), np.array([0.3, 0.1, 0.2])
    a = np.block([[np.zeros((3, 3)), -np.eye(3)], [np.zeros((3, 6))]])
    exact = van_loan(a, np.diag([*n**2, *k**2]), h)
    np.testing.assert_allclose(
        np.array(noise.process_noise(ca.DM(n), ca.DM(k), h)), exact, rtol=1e-13, atol=1e-18
    )


def test_cholesky_and_forward_substitution_are_numpys():
    rng = np.random.default_rng(1)
    root = rng.standard_normal((6, 6))
    p, b = root @ root.T + 0.1 * np.eye(6), rng.standard_normal((6, 2))
    lower = linear.cholesky(ca.DM(p))
    np.testing.assert_allclose(np.array(lower), np.linalg.cholesky(p), atol=1e-13)
    np.testing.assert_allclose(
        np.array(linear.forward(lower, ca.DM(b))),
        np.linalg.solve(np.linalg.cholesky(p), b),
        atol=1e-12,
    )
    np.testing.assert_array_equal(
        np.array(linear.unpack(linear.pack(ca.DM(p)), 6)), np.triu(p) + np.triu(p, 1).T
    )


def test_cholesky_of_a_singular_matrix_is_finite():
    assert np.isfinite(np.array(linear.cholesky(ca.DM.ones(6, 6)))).all()
