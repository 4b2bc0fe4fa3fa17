"""The square-root form makes the estimates of the filter of 13 sigma points."""

import casadi as ca
import numpy as np
import pytest
from attitude_cases import (
    WHITE,
    H,
    covariance_of,
    drive,
    error,
    eventful_drive,
    inputs,
    output,
    parameters,
    part,
    rover_rate,
)
from places import measured
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.attitude.filter.memory import ESTIMATE
from pyimu.attitude.filter.sigma_point_filter import sigma_point_filter
from pyimu.attitude.filter.square_root import square_root_filter
from pyimu.attitude.filter.tolerances import REAL
from pyimu.block.block import Run
from pyimu.symbolic.linear import triangular

EPS = np.finfo(float).eps
STEP = 100 * EPS
"""Rounding of a step, relative: an entry is a sum of up to 22 products, twice in a row, of each of
which every factor is rounded."""

ALIGNED = np.array([0.01, 0.01, 0.001, 1e-3, 1e-3, 1e-3])


def factor_of(state: np.ndarray) -> np.ndarray:
    """The factor (9, 9) in a state of the square-root form."""
    upper = np.zeros((9, 9))
    upper[np.triu_indices(6)] = state[7:28]
    upper[:6, 6:] = state[31:49].reshape(3, 6).T
    upper[6 + np.triu_indices(3)[0], 6 + np.triu_indices(3)[1]] = state[49:55]
    return upper.T


def whole_covariance_of(state: np.ndarray) -> np.ndarray:
    """The covariance (9, 9) in a state of the other form."""
    upper = np.zeros((9, 9))
    upper[:6, :6] = np.triu(covariance_of(state))
    upper[:6, 6:] = state[31:49].reshape(3, 6).T
    upper[6 + np.triu_indices(3)[0], 6 + np.triu_indices(3)[1]] = state[49:55]
    return upper + np.triu(upper, 1).T


def put(state: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """The state with the upper triangle of ``matrix`` (9, 9) in it."""
    out = state.copy()
    out[7:28], out[31:49] = matrix[:6, :6][np.triu_indices(6)], matrix[:6, 6:].T.ravel()
    out[49:55] = matrix[6:, 6:][np.triu_indices(3)]
    return out


def test_triangular_factor_is_that_of_the_product_but_keeps_its_small_pivots():
    """Against numpy's QR to rounding times the condition, its product to rounding; where that is
    singular to rounding, its Cholesky factor has lost a pivot that this one has.
    """
    wide, rng = ca.SX.sym("a", 5, 8), np.random.default_rng(0)
    function = ca.Function("f", [wide], [ca.densify(triangular(wide))])
    for spread in (1.0, 1e-3, 1e-9):
        a = np.diag(spread ** np.linspace(0, 1, 5)) @ rng.normal(size=(5, 8))
        a[1] = a[0] + spread * a[1]
        lower = np.array(function(a))
        r = np.linalg.qr(a.T, mode="r").T
        want = r * np.sign(np.diag(r))
        assert np.array_equal(lower, np.tril(lower))
        rows = np.linalg.norm(a, axis=1)
        condition = np.linalg.cond(a / rows[:, None])
        assert np.abs((lower - want) / rows[:, None]).max() < STEP * condition
        assert np.abs((lower @ lower.T - a @ a.T) / np.outer(rows, rows)).max() < STEP
    # 1 + 1e-18 is 1: the pivot of the product is rounding, that of the rows is right.
    assert lower[1, 1] == pytest.approx(want[1, 1], rel=1e-6)
    product = a @ a.T
    pivot = product[1, 1] - product[1, 0] ** 2 / product[0, 0]
    assert abs(pivot / want[1, 1] ** 2 - 1) > 0.1


def test_a_step_from_random_estimates_is_that_of_the_other_form():
    """One sample from a random covariance of a random attitude, bias and velocity: with an update
    by the velocity, by gravity, by neither, and beyond the innovation gate.

    What rounding leaves in a factor or a covariance is relative to the estimate before; the
    measurement makes the estimate smaller by ``shrunk``.
    """
    plain, root = sigma_point_filter(part()), square_root_filter(part())
    rng, kinds = np.random.default_rng(2), set()
    p = parameters(plain, latitude=0.8)
    start = np.array(plain.initial(plain.start_inputs, p)[0]).ravel()
    for i in range(60):
        std = np.array([[0.02, 0.2, 0.02][i % 3]] * 3 + [1e-3] * 3 + [0.3] * 3)
        a = std[:, None] * rng.normal(size=(9, 14)) / 14**0.5
        q = Rotation.random(random_state=rng)
        before = start.copy()
        before[:4], before[4:7] = q.as_quat(scalar_first=True), 0.01 * rng.normal(size=3)
        before[28:31] = 0.05 * rng.normal(size=3)
        force = q.apply([0, 0, 9.80665], inverse=True) + 0.2 * rng.normal(size=3)
        force = force + (i % 4 == 3) * 3 * rng.normal(size=3)
        u = inputs(1, gyro=rng.normal(size=3), accel=force)
        lower = np.linalg.cholesky(a @ a.T)
        y, s = plain.run(u, p=p, state=put(before, lower @ lower.T))
        z, r = root.run(u, p=p, state=put(before, lower.T))
        after, factor = whole_covariance_of(s), factor_of(r)
        assert (np.diag(factor) > 0).all()
        scale = np.sqrt(np.diag(after))
        shrunk = np.linalg.cond((a @ a.T) / np.outer(std, std)) * max(1, (std / scale).max() ** 2)
        off = (factor @ factor.T - after) / np.outer(scale, scale)
        assert np.abs(off).max() < STEP * shrunk
        moved = error(z[:, :4], Rotation.from_quat(y[:, :4], scalar_first=True))
        assert (np.abs(moved) < STEP * shrunk * scale[:3]).all()
        np.testing.assert_allclose(r[ESTIMATE:], s[ESTIMATE:], rtol=1e-9, atol=1e-12)
        kinds.add((bool(y[0, 16]), int(y[0, 18])))
    assert len(kinds) >= 3


def same(plain, root, u, p):
    """Assert that both forms make the same estimates of rows ``u``, relative to their std.

    The heading is learnt from nothing for many samples: what rounding adds at each then adds up.
    """
    (y, _), (z, r) = plain.run(u, p=p), root.run(u, p=p)
    std, bound = output(plain, y, "std"), len(u) * STEP
    turned = error(output(root, z, "q"), Rotation.from_quat(y[:, :4], scalar_first=True))
    assert (np.abs(turned) < bound * std[:, :3]).all()
    bias = output(root, z, "gyro_bias") - output(plain, y, "gyro_bias")
    assert (np.abs(bias) < bound * std[:, 3:]).all()
    np.testing.assert_allclose(output(root, z, "std"), std, rtol=bound)
    for name in ("quasi_static", "status"):
        np.testing.assert_array_equal(output(root, z, name), output(plain, y, name))
    return y, factor_of(r)


@pytest.mark.long
def test_square_root_form_is_the_other_over_ten_minutes():
    """60,000 samples with pushes, rests, missing rows, headings late and on time, and zero rates:
    each sample adds its rounding at most.
    """
    n = 60_000
    gyro, accel, heading, told, still = eventful_drive(n)
    told &= np.arange(n) > n // 2
    late = np.where(told, np.arange(n) % 30, 0)
    gyro[20_000:20_030, 1], accel[25_000:25_100] = np.nan, np.nan
    u = inputs(
        n,
        gyro=gyro,
        accel=accel,
        heading=heading[np.arange(n) - late],
        heading_variance=4e-4,
        heading_valid=told,
        heading_age=late * H,
        stationary=still & (np.arange(n) > n // 4),
    )
    plain, root = sigma_point_filter(part()), square_root_filter(part())
    y, factor = same(plain, root, u, parameters(plain, std0=ALIGNED, latitude=0.8))
    assert (output(plain, y, "nis") > 0).any() and (output(plain, y, "status") > 0).any()
    assert (np.diag(factor) > 0).all()


@pytest.mark.long
def test_square_root_form_is_the_other_on_a_measured_recording():
    """A minute of a body moved by hand, with the noise that it shows at rest."""
    log = pyimu.read_recording(measured("broad_11_undisturbed_slow_translation_B"))
    rows = slice(0, 17_000)
    found = pyimu.attitude.run(log)
    known = part(2e-4, 3e-4, 2e-3)
    known = type(known)("measured", 1 / log.sample_period, known.gyro, known.accel)
    u = inputs(17_000, gyro=log.gyro[rows], accel=log.accel[rows])
    u[~np.isfinite(u)] = np.nan
    plain, root = sigma_point_filter(known), square_root_filter(known)
    own = {n: found.parameters[n] for n in found.parameters if n[:5] in ("q0[1]", "bias0", "std0[")}
    p = parameters(plain, **own, rate_noise=2e-3)
    same(plain, root, u, p)


def far_start(n: int, known) -> tuple:
    """Rows (n, 12) of a drive, seen by the noise of ``known``, and settings that know of its start
    no more than where up is to a third of a radian.
    """
    world, rng = drive(rover_rate(n)), np.random.default_rng(4)
    n_gyro, n_accel = (
        float(np.ravel(s.values["angle_random_walk"]["N"])[0]) for s in (known.gyro, known.accel)
    )
    gyro = world.rate + [0.2, -0.1, 0.3] + n_gyro / H**0.5 * rng.standard_normal((n, 3))
    accel = world.force + n_accel / H**0.5 * rng.standard_normal((n, 3))
    start = Rotation.from_rotvec([0.3, -0.2, 0.5]).as_quat(scalar_first=True)
    return inputs(n, gyro=gyro, accel=accel), {"q0": start, "std0": [0.3, 0.3, 1.5, 0.3, 0.3, 0.3]}


@pytest.mark.long
@pytest.mark.parametrize("motion, power", [(REAL, 1), ({}, 2)], ids=["real", "ideal"])
@pytest.mark.parametrize("noise", [(1e-3, 2e-4, 1e-2), (6e-5, 3e-6, 5e-4)])
def test_covariance_stays_definite_where_attitude_and_bias_are_hardly_known(noise, motion, power):
    """The velocity takes part in the sigma points: linear shares beside them were not definite.

    A step's rounding counts as often as the factor's condition says: attitude and bias are known
    from each other to a five hundredth. Where an ideal sensor shows that the body hardly moves it
    is a ten thousandth, and the covariance loses digits by its own condition, the square.
    """
    plain, root = sigma_point_filter(part(*noise)), square_root_filter(part(*noise))
    u, start = far_start(1500, part(*noise))
    p = parameters(plain, **start, **motion)
    forms = [Run(block, len(u), p=p) for block in (plain, root)]
    for i in range(len(u)):
        for form in forms:
            form.advance(u[i : i + 1])
        covariance, factor = whole_covariance_of(forms[0].state), factor_of(forms[1].state)
        scale = np.sqrt(np.diag(covariance))
        assert np.linalg.eigvalsh(covariance / np.outer(scale, scale))[0] > 0
        assert (np.diag(factor) > 0).all()
    off = (factor @ factor.T - covariance) / np.outer(scale, scale)
    condition = np.linalg.cond(factor / scale[:, None])
    assert np.abs(off).max() < len(u) * EPS * condition**power


def test_factor_kept_in_single_precision_serves_where_a_covariance_does_not():
    """Sensors without noise to speak of: tilt and bias are known from each other to 1e-4 and less,
    the square of which single precision does not hold beside 1, its root it does.
    """
    known = part(1e-7, 1e-10, 1e-6)
    u, start = far_start(400, known)
    blocks = [sigma_point_filter(known), square_root_filter(known)]
    p = parameters(blocks[0], **start, **WHITE)
    want = output(blocks[0], blocks[0].run(u, p=p)[0], "std")[-1]
    plain, root = (Run(block, len(u), p=p) for block in blocks)
    definite = True
    for i in range(len(u)):
        y = root.advance(u[i : i + 1])
        root.state[:] = root.state.astype(np.float32)
        assert (np.diag(factor_of(root.state))[:6] > 0).all()
        if definite:
            plain.advance(u[i : i + 1])
            plain.state[:] = plain.state.astype(np.float32)
            definite = np.linalg.eigvalsh(covariance_of(plain.state))[0] > 0
    assert not definite
    np.testing.assert_allclose(output(blocks[1], y, "std")[0], want, rtol=0.01)
