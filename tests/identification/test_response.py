"""The answer to a whole log at once: against the sample by sample block, against differences,
against casadi's own machine.
"""

import casadi as ca
import numpy as np
import pytest
from catalogue_cases import CASES, H, everything, excited, motion, own, run
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pyimu.block.program import program
from pyimu.block.vectorised import BLOCK, over_rows, split_over_rows
from pyimu.identification.fit.response import (
    _memory,
    after_dynamics,
    before_dynamics,
    dynamics,
    has_memory,
    impulse_response,
    is_step,
    memoryless,
    predict,
)
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor
from pyimu.model.signals import N_INPUT

SEGMENTS = [(0, 700), (700, 705), (730, 1500)]
SEEDS = st.integers(0, 2**32 - 1)
MEMORYLESS = [
    (name, kind)
    for name, kind in CASES
    if not CATALOGUE[name].states and not is_step(CATALOGUE[name], kind)
]
AFTER_DYNAMICS = [(name, kind) for name, kind in MEMORYLESS if CATALOGUE[name].stage != "motion"]
STAIRCASES = {"quantization", "angle_quantization"}


def chain(kind: str) -> Sensor:
    """Delay, lag, gain, bias and limit together."""
    limit = 1.1 if kind == "gyro" else 9.0
    sensor = Sensor(
        kind,
        {
            "time_delay": {"td": 2.3 * H},
            "lag": {"wn": 60.0, "zeta": 0.6},
            "scale_factor": {"s": [0.02, -0.03, 0.01]},
            "turn_on_bias": {"b0": [0.1, -0.2, 0.05]},
            "saturation": {"limit": [limit, 1.3 * limit, 0.0]},
        },
    )
    return sensor.with_values(
        "misalignment", m=0.01 * (np.arange(9.0).reshape(3, 3) - 4.5) * (1 - np.eye(3))
    )


def assert_follows_the_block(sensor: Sensor, u: np.ndarray) -> None:
    """Each segment starts anew, as a run of its own does, but for what is remembered of other
    signals, which a gap does not end.
    """
    segments = [(0, len(u))] if has_memory(sensor.chain) else SEGMENTS
    y = predict(sensor, u, segments, H)
    for a, b in segments:
        step_by_step = run(sensor, u[a:b])
        np.testing.assert_allclose(
            y[a:b], step_by_step, atol=1e-11 * np.abs(u[:, own(sensor.kind)]).max()
        )


@pytest.mark.parametrize("kind", ["gyro", "accel"])
def test_predict_is_the_block_sample_by_sample(kind):
    u = motion(1500, seed=1)
    sensor = chain(kind)
    y = predict(sensor, u, SEGMENTS, H)
    clipped = np.abs(y[:, 0]) == sensor.values["saturation"]["limit"][0]
    assert 0.02 < clipped.mean() < 0.9
    assert_follows_the_block(sensor, u)


@pytest.mark.parametrize(
    ("name", "kind"), [(n, k) for n, k in CASES if not is_step(CATALOGUE[n], k)]
)
def test_predict_of_one_effect_is_the_block(name, kind):
    sensor = excited(name, kind)
    # At the usual small share a lag takes minutes; one that dies away within the segment is the
    # test here.
    assert_follows_the_block(
        sensor.with_values("lag", wn=20.0) if name == "lag" else sensor, motion(1500, seed=2)
    )


def test_dynamics_and_tail_share_the_chain_between_them():
    sensor = everything("gyro")
    parts = [
        *before_dynamics(sensor).values,
        *dynamics(sensor).values,
        *after_dynamics(sensor).values,
    ]
    assert len(parts) == len(set(parts)) and set(sensor.values) - set(parts) == STAIRCASES


@pytest.mark.parametrize(
    ("effect", "values"),
    [
        ("lag", {"wn": 7.0, "zeta": 0.4}),
        ("lag", {"wn": 90.0, "zeta": 1.4}),
        ("time_delay", {"td": 0.077}),
    ],
)
def test_impulse_response_is_complete(effect, values):
    """The gain at standstill is one, so nothing of the response is cut off."""
    response = impulse_response(Sensor("gyro", {effect: values}), H)
    np.testing.assert_allclose(response.sum(axis=0), 1.0, atol=1e-11)


@settings(max_examples=3, deadline=None)
@given(seed=SEEDS)
@pytest.mark.parametrize(("name", "kind"), AFTER_DYNAMICS)
def test_tail_jacobian_is_the_central_difference_of_predict(name, kind, seed):
    sensor = excited(name, kind)
    u = motion(200, seed=seed)
    rest = after_dynamics(sensor)
    response = memoryless(rest.chain)
    _, slope, entries = response(list(u.T), rest.p, H)
    p, segments = sensor.p, [(0, 200)]
    for j, slot in enumerate(sensor.slots):
        step = np.cbrt(np.finfo(float).eps) * max(abs(p[j]), 1e-3)
        high, low = (
            predict(sensor.with_p(p + d * np.eye(len(p))[j]), u, segments, H) for d in (step, -step)
        )
        expected = (high - low) / (2 * step)
        found = np.zeros_like(expected)
        for e in np.flatnonzero(response.slot == j):
            found[:, response.axis[e]] = entries[e]
        # A corner (of a limit) within a step of a sample has no difference to compare with.
        smooth = np.abs(high + low - 2 * predict(sensor, u, segments, H)) < 1e-3 * step * (
            1 + np.abs(expected)
        )
        assert smooth.mean() > 0.98
        atol = 1e-6 * np.abs(expected).max(initial=1e-3)
        np.testing.assert_allclose(
            found[smooth], expected[smooth], rtol=1e-6, atol=atol, err_msg=slot.name
        )
    _check_slope(sensor, u, slope)


def _check_slope(sensor: Sensor, u: np.ndarray, slope: np.ndarray) -> None:
    """The slope against the own input, likewise."""
    first, segments = own(sensor.kind).start, [(0, len(u))]
    for k in range(3):
        step = 1e-5 * np.eye(N_INPUT)[first + k]
        high, middle, low = (predict(sensor, u + d, segments, H) for d in (step, 0 * step, -step))
        smooth = np.abs(high + low - 2 * middle) < 1e-8
        assert smooth.mean() > 0.98
        np.testing.assert_allclose(slope[:, :, k][smooth], ((high - low) / 2e-5)[smooth], atol=1e-6)


def machine(function: ca.Function, rows: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """The same by casadi's virtual machine, row by row."""
    return np.array([np.array(function(row, fixed)).ravel() for row in rows])


@settings(max_examples=5, deadline=None)
@given(seed=SEEDS)
@pytest.mark.parametrize(("name", "kind"), [(n, k) for n, k in CASES if not CATALOGUE[n].states])
def test_over_rows_is_the_virtual_machine(name, kind, seed):
    """Output and Jacobian of every effect without memory, at random inputs and coefficients of
    either sign, where no number overflows: what zero times infinity is, is left to either. A sum
    whose terms nearly cancel keeps the rounding of its terms.
    """
    sensor = Sensor(kind, {name: {}})
    c = sensor.chain
    y = c.step(c.start, c.u, c.p, np.zeros(len(sensor.noise)), H)[1]
    function = ca.Function(
        "f", [c.u, c.p], [ca.densify(ca.vertcat(y, ca.vec(ca.jacobian(y, ca.vertcat(c.u, c.p)))))]
    )
    rng = np.random.default_rng(seed)
    rows = rng.standard_normal((20, N_INPUT)) * 10.0 ** rng.uniform(-3, 3, N_INPUT)
    rows[rng.random(rows.shape) < 0.1] = 0.0
    p = rng.standard_normal(len(sensor.slots)) * (rng.random(len(sensor.slots)) < 0.9)
    expected = machine(function, rows, p)
    finite = np.isfinite(expected).all(axis=1)
    assume(finite.any())
    found = over_rows(function, rows.T, p)
    terms = np.maximum(1.0, np.abs(rows).max(axis=1)) * max(1.0, float(np.abs(p).max(initial=0.0)))
    rounding = 1e-14 * np.abs(expected) + 1e-15 * terms[:, None]
    assert np.all(np.abs(found[finite] - expected[finite]) <= rounding[finite])


def test_over_rows_knows_every_elementary_operation():
    x = ca.SX.sym("x", 2)
    a, b = x[0], x[1]
    functions = (
        ca.exp,
        ca.log,
        ca.sqrt,
        ca.sin,
        ca.cos,
        ca.tan,
        ca.asin,
        ca.acos,
        ca.atan,
        ca.sinh,
        ca.cosh,
        ca.tanh,
        ca.floor,
        ca.ceil,
        ca.fabs,
        ca.sign,
        ca.logic_not,
    )
    unary = [*(f(a) for f in functions), a * a, 2 * a, 1 / a, -a]
    functions = (
        ca.eq,
        ca.ne,
        ca.logic_and,
        ca.logic_or,
        ca.fmin,
        ca.fmax,
        ca.fmod,
        ca.copysign,
        ca.atan2,
        ca.hypot,
    )
    binary = [
        *(f(a, b) for f in functions),
        a + b,
        a - b,
        a * b,
        a / b,
        a**b,
        a**2.5,
        a < b,
        a <= b,
        ca.if_else(a < b, a, b),
    ]
    function = ca.Function("f", [x, ca.SX.sym("p", 0)], [ca.densify(ca.vertcat(*unary, *binary))])
    rng = np.random.default_rng(1)
    corners = [[0.0, 0.0], [0.5, 0.5], [-0.5, 0.0], [0.0, 2.0]]
    rows, none = (
        np.concatenate([rng.uniform(-1, 1, (30, 2)), rng.uniform(0.1, 4, (30, 2)), corners]),
        np.zeros(0),
    )
    np.testing.assert_allclose(
        over_rows(function, rows.T, none), machine(function, rows, none), rtol=1e-13, atol=1e-15
    )


def test_what_never_changes_is_not_evaluated_and_what_nobody_wants_is_zero():
    """Of many rows the columns that never change are known beforehand; of a few they are not."""
    x, p = ca.SX.sym("x", 3), ca.SX.sym("p", 3)
    a, b, c = ca.vertsplit(x)
    made = [a * b + p[0] * ca.sin(c), ca.if_else(p[1] > 0, a, b), p[2] * a + b / p[2], a - p[0]]
    made += [ca.if_else(b > 1, a, c), b * 2, p[0] * a, ca.fmax(a, b) * p[2]]
    function = ca.Function("f", [x, p], [ca.densify(ca.vertcat(*made))])
    columns = np.random.default_rng(3).standard_normal((3, 3 * BLOCK))
    columns[1], fixed = 2.5, np.array([0.0, -1.0, 1.0])
    pieces = [over_rows(function, columns[:, k : k + 100], fixed) for k in range(0, 3 * BLOCK, 100)]
    found = over_rows(function, columns, fixed)
    np.testing.assert_array_equal(found, np.concatenate(pieces))
    np.testing.assert_allclose(found[:20], machine(function, columns.T[:20], fixed), rtol=1e-14)
    wanted = np.arange(len(made)) % 3 == 0
    whole, others = split_over_rows(function, columns, fixed, 3, wanted)
    np.testing.assert_array_equal(np.column_stack([whole, *others]), found * wanted)


def test_over_rows_refuses_what_it_does_not_know():
    x = ca.SX.sym("x")
    with pytest.raises(NotImplementedError, match="numpy twin"):
        over_rows(
            ca.Function("f", [x, ca.SX.sym("p", 0)], [ca.erf(x)]), np.ones((1, 2)), np.zeros(0)
        )


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_only_rounding_is_a_staircase(name, kind):
    assert is_step(CATALOGUE[name], kind) == (name in STAIRCASES)


def test_a_memory_is_one_step_in_all_chains_that_have_it():
    """So that it is compiled once, whatever else the model has."""
    alone = Sensor("gyro", {"thermal_hysteresis": {}})
    beside = alone.with_values("scale_factor").with_values("thermal_bias")
    (step, read, of), (other, also_read, also_of) = (_memory(one.chain) for one in (alone, beside))
    assert read == also_read and len(of) == len(also_of) == 1
    assert [beside.slots[k].parameter for k in also_of] == ["width"]
    texts = [program(one).instructions for one in (step, other)]
    assert texts[0] == texts[1]
