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
from pyimu.characterization.report.coefficients import (
    DENSITY_UNIT,
    SAMPLE_UNIT,
    SECOND_N_UNIT,
    UNITS,
)
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS
from pyimu.report.numbers import SCRIPTS, SHOWN, pretty, quantity
from pyimu.units import UnitError, convert, nearest, parse, same_dimension, to_degc

REGISTRY = pint.UnitRegistry()
PLAIN = {raised: plain for plain, raised in SCRIPTS.items()}
PINT_NAMES = {
    "degF": "delta_degF",
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
    "mdeg": "millidegree",
    "rev": "turn",
    "mgauss": "milligauss",
    "ugauss": "microgauss",
    "arcmin": "arcminute",
    "kn": "knot",
    "mi": "mile",
    "ft": "foot",
    "LSB": "count_of_a_converter",
    **units.ALIASES,
}
REGISTRY.define("count_of_a_converter = [counts_of_a_converter]")
SI = {
    "rad": "rad",
    "s": "s",
    "m": "m",
    "K": "kelvin",
    "V": "volt",
    "T": "tesla",
    "LSB": "count_of_a_converter",
}
PRINTED = {
    "dps": "deg/s",
    "deg/hr": "deg/h",
    "dph": "deg/h",
    "mdps": "mdeg/s",
    "kph": "km/h",
    "knots": "kn",
    "mph": "mi/h",
    "mdps/√Hz": "mdeg/s/sqrt(Hz)",
    "µg": "ug",
    "μg": "ug",
    "ug/rtHz": "ug/sqrt(Hz)",
    "μg/√Hz": "ug/sqrt(Hz)",
    "m/s2": "m/s^2",
    "m/s²/√Hz": "m/s^2/sqrt(Hz)",
    "°/s": "deg/s",
    "º/s": "deg/s",
    "°/√hr": "deg/sqrt(h)",
    "deg/rt-hr": "deg/sqrt(h)",
    "m/s/√(h)": "m/s/sqrt(h)",
    "°C": "degC",
    "℃": "K",
    "rpm": "rev/min",
    "LSB/g": "LSB/g",
    "LSB/dps": "LSB/(deg/s)",
    "LSB/(°/s)": "LSB/(deg/s)",
    "LSB/°/s": "LSB/(deg/s)",
    "LSB/deg/sec": "LSB/(deg/s)",
    "mV/°/s": "mV/(deg/s)",
    "mg/LSB": "mg/LSB",
    "mdps/digit": "mdeg/s/LSB",
    "ppm/°C": "ppm/K",
    "%/°C": "%/K",
    "(°/s)/g": "deg/s/g",
    "1/(rad·s⁻¹)": "s/rad",
    "sec": "s",
    "deg/Hr": "deg/h",
    "°/√ Hr": "deg/sqrt(h)",
    "°/s/√\xa0Hz": "deg/s/sqrt(Hz)",
    "µg/√H\u0305z\u0305": "ug/sqrt(Hz)",
    "µg/Hz^0.5": "ug/sqrt(Hz)",
    "µg/Hz^1/2": "ug/sqrt(Hz)",
    "µg/Hz^(1/2)": "ug/sqrt(Hz)",
    "µg/Hz½": "ug/sqrt(Hz)",
    "µg·Hz^−1/2": "ug/sqrt(Hz)",
    "µg Hz⁻¹ᐟ²": "ug/sqrt(Hz)",
    "°/h^(3/2)": "deg/h/sqrt(h)",
    "m/s^1.5": "m/s/sqrt(s)",
    "m/s**2": "m/s^2",
    "m s⁻²": "m/s^2",
    "m·s−2": "m/s^2",
    "m.s-2": "m/s^2",
    "° s⁻¹": "deg/s",
    "rad.s^-1": "rad/s",
    "°∕s": "deg/s",
    "°⁄√h": "deg/sqrt(h)",
    "% / ° C": "%/K",
    "dps/deg C": "deg/s/K",
    "％": "%",
    "arc sec": "arcsec",
    "mgrms": "mg",
    "mg (1σ)": "mg",
    "°/s, rms": "deg/s",
    "milli-g": "mg",
    "SPS": "Hz",
    "samples/s": "Hz",
    "samples/sec": "Hz",
    "samples/second": "Hz",
    "days": "day",
    "msec": "ms",
    "uGauss": "ugauss",
    "°K": "K",
}
"""Units as data sheets print them, in the spelling of the table."""

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


@pytest.mark.parametrize("text", PRINTED)
def test_a_unit_as_a_data_sheet_prints_it_is_that_of_the_table(text):
    assert parse(text).dimension == parse(PRINTED[text]).dimension
    assert parse(text).factor == pytest.approx(by_pint(PRINTED[text]), rel=1e-13)


@pytest.mark.parametrize("alias", units.ALIASES)
def test_an_alias_is_one_factor(alias):
    """LSB/dps is LSB/(deg/s), and the square of dps that of deg/s."""
    whole = parse(f"({units.ALIASES[alias]})")
    assert parse(f"m/{alias}").factor == pytest.approx(1 / whole.factor, rel=1e-15)
    assert parse(f"{alias}^2").dimension == tuple(2 * e for e in whole.dimension)


def shown_units():
    """Every unit in which a number is said: those people use, those of coefficients and columns."""
    of_effects = {
        Sensor(kind).unit(q.unit)
        for e in CATALOGUE.values()
        for kind in e.triads
        for q in e.parameters.values()
    }
    tables = {
        u
        for units_of in (UNITS, SAMPLE_UNIT, SECOND_N_UNIT, DENSITY_UNIT)
        for u in _leaves(units_of)
    }
    people = {unit for shown in SHOWN.values() for unit, _ in shown}
    return sorted(of_effects | tables | people | set(SHOWN) | {s.unit for s in SIGNALS.values()})


def _leaves(table):
    return [u for v in table.values() for u in (_leaves(v) if isinstance(v, dict) else [v])]


@given(st.sampled_from(shown_units()), st.sampled_from("*/"), st.sampled_from(shown_units()))
def test_whatever_is_printed_is_read_again(unit, operator, other):
    """The sign of a root, a raised power, a micro sign, alone and within a product."""
    for text in (unit, f"({unit}){operator}({other})"):
        again = parse(pretty(text) or "1")
        assert again.dimension == parse(text).dimension
        assert again.factor == pytest.approx(parse(text).factor, rel=1e-13)


@given(st.sampled_from(sorted(SHOWN)), st.floats(1e-12, 1e6))
def test_a_quantity_that_is_printed_is_read_again(si, value):
    """To the three figures that are printed, whatever the unit of its size."""
    figure, _, unit = quantity(value, si).partition(" ")
    mantissa, _, exponent = figure.partition("×10")
    number = float(mantissa) * 10.0 ** int(exponent.translate(PLAIN) or 0)
    assert convert(number, unit or "1", si) == pytest.approx(value, rel=5.1e-3)


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


@given(expressions(), st.floats(-1e3, 1e3).filter(lambda v: v == 0 or abs(v) > 1e-100))
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
        ("deg/s s", "unexpected 's'; behind a '/' write '*' or '/' before it"),
        ("% FS", "a share of the range has the range's unit"),
        ("%FSR", "a share of the range has the range's unit"),
        ("% of FSO", "a share of the range has the range's unit"),
        ("°/s p-p", "a figure from peak to peak is no rms"),
        ("mg/bit", "did you mean LSB?"),
        ("Gs", "gauss (field) or g (gravity)"),
        ("m/s^2/2", "unknown '2'"),
        ("m//s", "missing before '/'"),
        ("sqrt/h", "'(' is missing"),
        ("(rad", "')' is missing"),
        ("rad)", "unexpected ')'"),
        ("rad^0.3", "not a unit"),
        ("rad^1/3", "unknown '3'"),
        ("rad^s", "a power must be an integer"),
        ("2*s", "unknown '2'"),
        ("dpss", "known are"),  # of short words that are like another by chance, too
        ("deg/secs", "known are"),
        ("deg/secondes", "did you mean second"),
        ("mG", "did you mean mgauss (field) or mg (gravity)?"),
        ("rms", "unknown 'rms'"),
        ("gram", "unknown 'gram'"),
        ("µ°x/s", "unknown 'udegx'"),
        ("G", "gauss"),
        ("RAD", "did you mean rad"),
        ("hz", "did you mean Hz"),
        ("degg/s", "known are"),
        ("foo", "known are"),
        ("codes/g", "did you mean LSB?"),
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
    assert to_degc([32.0, 212.0], "°F").tolist() == pytest.approx([0.0, 100.0])
    assert convert(9.0, "degF", "K") == pytest.approx(5.0)


def test_thermometer_refuses_millivolts():
    with pytest.raises(UnitError, match="must be in degC, K or degF"):
        to_degc(1.0, "mV")


@pytest.mark.parametrize(
    "text, like, said",
    [
        ("dpss", "rad/s", "did you mean dps?"),
        ("degg/s", "rad/s", "did you mean deg?"),
        ("deg/secs", "rad/s", "did you mean sec?"),
        ("hz", "Hz", "did you mean Hz?"),
        ("utt", "T", "did you mean uT?"),
        ("utt", "rad/s", "known are"),
        ("secunds", "m/s^2", "known are"),
        ("degg/secs", "rad/s", "known are"),  # with one of them alone it is no unit yet
    ],
)
def test_a_unit_that_may_be_meant_is_of_the_dimension_that_is_expected(text, like, said):
    for call in (lambda: parse(text, like), lambda: convert(1.0, text, like)):
        with pytest.raises(UnitError, match=re.escape(said)):
            call()


@pytest.mark.parametrize(
    "printed, plain",
    [
        ("°/s rms", "deg/s"),
        ("mg rms", "mg"),
        ("mg-rms", "mg"),
        ("mg RMS", "mg"),
        ("mg (rms)", "mg"),
        ("°/sec/√Hz rms", "deg/s/sqrt(Hz)"),
        ("µg/√Hz rms", "ug/sqrt(Hz)"),
        ("RPM", "rev/min"),
        ("counts", "LSB"),
        ("counts/g", "LSB/g"),
        ("count/°/s", "LSB/(deg/s)"),
    ],
)
def test_what_data_sheets_print_beside_a_unit(printed, plain):
    read, want = parse(printed), parse(plain)
    assert (read.factor, read.dimension) == (want.factor, want.dimension)


def test_nearest_name():
    assert nearest("gyr_x", ["gyro_x", "accel_x"]) == "gyro_x"
    assert nearest("GYRO_X", ["gyro_x", "accel_x"]) == "gyro_x"
    assert nearest("humidity", ["gyro_x", "accel_x"]) is None
