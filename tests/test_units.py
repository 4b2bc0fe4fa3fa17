"""The unit table against pint, which does the arithmetic, and the grammar against what it must
refuse.
"""

import math
import re
from fractions import Fraction

import numpy as np
import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pyimu import units
from pyimu.units import UnitError, convert, nearest, parse, same_dimension, to_degc

REGISTRY = pint.UnitRegistry()
PINT_NAMES = {
    "1": "dimensionless",
    "%": "percent",
    "g": "standard_gravity",
    "mg": "millistandard_gravity",
    "ug": "microstandard_gravity",
    "degC": "delta_degC",
    "K": "kelvin",
    "h": "hour",
    "min": "minute",
    "T": "tesla",
    "mT": "millitesla",
    "uT": "microtesla",
    "nT": "nanotesla",
    "arcsec": "arcsecond",
}
SI = {"rad": "rad", "s": "s", "m": "m", "K": "kelvin", "V": "volt", "T": "tesla"}

COMPOUNDS = {
    "deg/sqrt(h)": {"rad": 1, "s": -1 / 2},
    "deg/h/sqrt(h)": {"rad": 1, "s": -3 / 2},
    "deg/s/sqrt(Hz)": {"rad": 1, "s": -1 / 2},
    "rad/s/(m/s^2)": {"rad": 1, "m": -1, "s": 1},
    "ug/sqrt(Hz)": {"m": 1, "s": -3 / 2},
    "mg/K": {"m": 1, "s": -2, "K": -1},
    "deg/h/g": {"rad": 1, "m": -1, "s": 1},
    "m/s/sqrt(s)": {"m": 1, "s": -3 / 2},
    "1/sqrt(Hz)": {"s": 1 / 2},
    "rad/s/(m/s^2)^2": {"rad": 1, "m": -2, "s": 3},
    "s^-1": {"s": -1},
    "%/K": {"K": -1},
    "uT * m": {"T": 1, "m": 1},
}


def by_pint(text):
    """Factor of ``text`` to SI, with pint's own table and arithmetic."""
    spelled = re.sub(r"sqrt\(([^()]*)\)", r"(\1)**0.5", text).replace("^", "**")
    spelled = re.sub(r"%|[A-Za-z]+", lambda m: PINT_NAMES.get(m[0], m[0]), spelled)
    quantity = REGISTRY.Quantity(1, spelled)
    target = REGISTRY.dimensionless
    for base, exponent in zip(units.BASES, parse(text).dimension):
        target = target * REGISTRY.Unit(SI[base]) ** float(exponent)
    return quantity.to(target, "Gaussian").magnitude  # pint's gauss is a CGS unit


@pytest.mark.parametrize("atom", [a for a in units.ATOMS if a != "1"])
def test_atom_factor_is_that_of_pint(atom):
    assert parse(atom).factor == pytest.approx(by_pint(atom), rel=1e-13)


@pytest.mark.parametrize("text", COMPOUNDS)
def test_compound_factor_is_that_of_pint(text):
    assert parse(text).factor == pytest.approx(by_pint(text), rel=1e-13)


@pytest.mark.parametrize("text", COMPOUNDS)
def test_compound_dimension(text):
    assert parse(text).dimension == tuple(
        Fraction(COMPOUNDS[text].get(base, 0)) for base in units.BASES
    )


def expressions():
    """Texts of the grammar."""
    atom = st.sampled_from(units.ATOMS)
    power = st.builds("{}^{}".format, atom, st.integers(-3, 3))
    leaf = atom | power | st.builds("sqrt({})".format, atom)
    return st.recursive(
        leaf, lambda e: st.builds("({}){}({})".format, e, st.sampled_from("*/"), e), max_leaves=5
    )


@given(expressions(), st.floats(-1e3, 1e3))
def test_round_trip_through_si(text, value):
    unit = parse(text)
    si = units.Unit(1.0, unit.dimension, "SI")
    assert convert(convert(value, unit, si), si, unit) == pytest.approx(
        value, rel=1e-12, abs=1e-300
    )


@given(expressions(), expressions())
def test_product_and_quotient(a, b):
    product, quotient = parse(f"({a})*({b})"), parse(f"({a})/({b})")
    assert product.factor == pytest.approx(parse(a).factor * parse(b).factor, rel=1e-12)
    assert product.dimension == tuple(x + y for x, y in zip(parse(a).dimension, parse(b).dimension))
    assert quotient.dimension == tuple(
        x - y for x, y in zip(parse(a).dimension, parse(b).dimension)
    )


@given(expressions())
def test_square_of_root_is_identity(text):
    assert parse(f"sqrt({text})^2").factor == pytest.approx(parse(text).factor, rel=1e-12)
    assert parse(f"sqrt({text})^2").dimension == parse(text).dimension


@given(st.text(max_size=12))
def test_any_text_is_a_unit_or_a_unit_error(text):
    try:
        assert parse(text).factor > 0
    except UnitError as error:
        assert "\n" not in str(error)


@pytest.mark.parametrize(
    "text, says",
    [
        ("", "a unit is missing"),
        ("deg/", "a unit is missing"),
        ("deg s", "unexpected 's'"),
        ("m//s", "missing before '/'"),
        ("sqrt h", "'(' is missing"),
        ("(rad", "')' is missing"),
        ("rad)", "unexpected ')'"),
        ("rad^0.5", "not a unit"),
        ("rad^s", "a power must be an integer"),
        ("2*s", "unknown '2'"),
        ("dps", "did you mean deg/s"),
        ("deg/sec", "did you mean s?"),
        ("gram", "unknown 'gram'"),
        ("°/s", "did you mean deg?"),
        ("G", "gauss"),
        ("RAD", "did you mean rad"),
        ("hz", "did you mean Hz"),
        ("degg/s", "did you mean deg"),
        ("foo", "known are"),
    ],
)
def test_refused_with_reason(text, says):
    with pytest.raises(UnitError, match=re.escape(says)):
        parse(text)


def test_unit_must_be_text():
    with pytest.raises(UnitError, match="must be text"):
        parse(3)


def test_g_is_standard_gravity():
    assert convert(1.0, "g", "m/s^2") == 9.80665


def test_angle_random_walk_of_one_degree_per_root_hour():
    assert convert(1.0, "deg/sqrt(h)", "rad/sqrt(s)") == pytest.approx(
        math.pi / 180 / 60, rel=1e-15
    )


def test_rate_is_not_a_frequency():
    assert not same_dimension("rad/s", "1/s")
    with pytest.raises(
        UnitError, match=r"'1/s' cannot be converted to 'rad/s': s\^-1 is not rad s\^-1"
    ):
        convert(1.0, "1/s", "rad/s")


def test_array_keeps_its_shape():
    assert convert(np.ones((4, 3)), "deg", "rad").shape == (4, 3)
    assert isinstance(convert(1, "deg", "rad"), float)


def test_thermometer_has_an_offset_and_a_difference_has_none():
    assert to_degc(273.15, "K") == 0.0
    assert np.array_equal(to_degc([20.0, 21.0], "degC"), [20.0, 21.0])
    assert convert(1.0, "K", "degC") == 1.0


def test_thermometer_refuses_millivolts():
    with pytest.raises(UnitError, match="must be in degC or K"):
        to_degc(1.0, "mV")


def test_nearest_name():
    assert nearest("gyr_x", ["gyro_x", "accel_x"]) == "gyro_x"
    assert nearest("GYRO_X", ["gyro_x", "accel_x"]) == "gyro_x"
    assert nearest("humidity", ["gyro_x", "accel_x"]) is None
