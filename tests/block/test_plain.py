"""What units compute is plain arithmetic, and right to a few units of the last place."""

import re

import casadi as ca
import numpy as np
import pytest

import pyimu
from pyimu.block.c_code import c_code
from pyimu.block.plain import plain_function
from pyimu.fmu.package import BLOCKS
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.symbolic import elementary
from pyimu.symbolic.elementary import arc_tangent

CALL = re.compile(r"\b(a?(?:sin|cos|tan)h?|atan2|exp|expm1|log|log1p|pow|hypot|erf|cbrt)\(")

Extended = np.longdouble

RNG = np.random.default_rng(2)
ANGLES = np.concatenate([RNG.standard_normal(20_000) * s for s in (1e-9, 1e-3, 1.0, 1e3, 1e5)])
SHARES = RNG.uniform(-1, 1, 50_000)
POWERS = np.concatenate([RNG.uniform(-700, 700, 50_000), RNG.standard_normal(50_000)])
SMALL = np.concatenate([POWERS, RNG.standard_normal(50_000) * 1e-7])
POSITIVE = np.exp(np.concatenate([POWERS, RNG.standard_normal(50_000) * 1e-7]))

CASES = [
    (elementary.sine, np.sin, ANGLES, 2),
    (elementary.cosine, np.cos, ANGLES, 2),
    (elementary.tangent, np.tan, ANGLES, 5),
    (elementary.arc_sine, np.arcsin, SHARES, 2),
    (elementary.arc_cosine, np.arccos, SHARES, 2),
    (elementary.exponential, np.exp, POWERS, 2),
    (elementary.exponential_less_one, np.expm1, SMALL, 5),
    (elementary.logarithm, np.log, POSITIVE, 2),
    (elementary.hyperbolic_tangent, np.tanh, ANGLES, 5),
    (elementary.hyperbolic_sine, np.sinh, POWERS, 5),
    (elementary.hyperbolic_cosine, np.cosh, POWERS, 5),
]


def evaluated(function, *columns):
    symbols = [ca.SX.sym(n) for n in "xy"[: len(columns)]]
    made = ca.Function("f", symbols, [function(*symbols)])
    return made(*[c.reshape(1, -1) for c in columns]).full().ravel()


@pytest.mark.skipif(
    np.finfo(np.longdouble).nmant < 60, reason="needs numbers that are longer than a double"
)
@pytest.mark.parametrize(
    ("ours", "theirs", "x", "most"), CASES, ids=lambda v: getattr(v, "__name__", "")
)
def test_a_function_is_right_to_the_stated_last_places(ours, theirs, x, most):
    exact = theirs(x.astype(Extended))
    place = np.spacing(np.abs(exact.astype(float)))
    assert np.max(np.abs(evaluated(ours, x) - exact) / place) <= most


def test_functions_end_where_numbers_do():
    x = np.array([0.0, 1e3, -1e3, np.inf, -np.inf, np.nan])
    y = np.array([0.0, 1.0, np.inf, -1.0, np.nan])
    with np.errstate(all="ignore"):
        np.testing.assert_array_equal(evaluated(elementary.exponential, x), np.exp(x))
        np.testing.assert_array_equal(evaluated(elementary.exponential_less_one, x), np.expm1(x))
        np.testing.assert_array_equal(evaluated(elementary.hyperbolic_sine, x), np.sinh(x))
        np.testing.assert_array_equal(evaluated(elementary.logarithm, y), np.log(y))
    assert np.isnan(evaluated(elementary.sine, np.array([np.inf, np.nan]))).all()


def test_a_whole_power_is_a_product_and_that_of_a_constant_an_exponential():
    x = ca.SX.sym("x")
    made = plain_function("f", [x], [ca.vertcat(x**3, x**-2, 3**x, ca.atan(x))])
    assert not calls([made])
    wanted = [1.7**3, 1.7**-2, 3**1.7, np.arctan(1.7)]
    np.testing.assert_allclose(made(1.7).full().ravel(), wanted, rtol=1e-15)


def test_what_has_no_call_is_left_as_it_is():
    """With its names, options and empty places."""
    x = ca.SX.sym("x", ca.Sparsity.lower(2))
    made = plain_function("f", [x], [ca.sin(x)], ["x"], ["y"], {"cse": True})
    assert made.sparsity_out(0) == ca.Sparsity.lower(2) and made.name_out() == ["y"]
    np.testing.assert_allclose(
        made(ca.DM([[1, 0], [2, 3]])).full(), np.sin([[1, 0], [2, 3]]), rtol=1e-15
    )


def test_the_angle_of_a_point_is_by_plain_arithmetic():
    y, x = RNG.standard_normal((2, 1000))
    plain = plain_function("f", (s := [ca.SX.sym("y"), ca.SX.sym("x")]), [ca.atan2(*s)])
    assert not calls([plain])
    np.testing.assert_array_equal(
        plain(y.reshape(1, -1), x.reshape(1, -1)).full().ravel(), evaluated(arc_tangent, y, x)
    )


@pytest.mark.parametrize("name", BLOCKS)
def test_a_unit_calls_no_function_of_the_c_library(name):
    block = BLOCKS[name](pyimu.part("imt30"))
    assert not calls([block.step, block.initial])


def test_a_sensor_with_every_effect_calls_none():
    sensors = {
        kind: Sensor(kind, {e.name: e.start() for e in CATALOGUE.values() if kind in e.sensors})
        for kind in ("gyro", "accel")
    }
    block = Part("everything", 100.0, **sensors).block
    assert not calls([block.step, block.initial])


def calls(functions):
    """Functions of the C library, beside those that are exact, in the C of casadi functions."""
    return set(CALL.findall(c_code("code", functions)))
