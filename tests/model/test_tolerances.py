"""Tolerances of parts: what files say of them, and the specimens that are drawn from them."""

import math
import pickle
import re
import zlib
from importlib.resources import files

import numpy as np
import pytest
from catalogue_cases import one_of_each_kind
from scipy import stats

from pyimu import units
from pyimu.errors import UserError
from pyimu.identification.model.as_part import as_part
from pyimu.model.part import Part
from pyimu.model.part_file import part, part_names
from pyimu.model.part_reader import parse_part
from pyimu.model.part_writer import format_part
from pyimu.model.sensor import Sensor
from pyimu.model.simulate import simulate
from pyimu.model.tolerance import Tolerance

HEAD = 'name = "a"\nsample_rate = {value = 100.0, unit = "Hz"}\n'
ALL = [(name, t) for name in part_names() for t in part(name).tolerances]
FIGURE = re.compile(r"^(?P<sign>\+-|<)?(?P<numbers>\[[\d., ]+\]|[\d.]+) (?P<unit>\S+)")
SPAN = re.compile(r"over (?P<low>-?\d+) to (?P<high>\d+) degC, taken as reached (?P<far>\d+) K")
RANGE = re.compile(r"of (?P<size>[\d.]+) (?P<unit>\S+), nonlinearity")
PLACE = re.compile(r"table|page|section", re.IGNORECASE)


def read(body):
    return parse_part(HEAD + body, "a.toml")


def named(case):
    return case if isinstance(case, str) else ".".join(case.key)


# The built-in parts


def test_every_part_of_a_data_sheet_has_tolerances():
    without = set(part_names()) - {"imt30"} - {name for name, _ in ALL}
    for name in without:
        text = files("pyimu.model").joinpath("parts", f"{name}.toml").read_text(encoding="utf-8")
        assert "Tolerances: not found" in text[: text.index("\nname = ")], name
    assert len({name for name, _ in ALL}) >= 19


@pytest.mark.parametrize(("name", "t"), ALL, ids=named)
def test_a_tolerance_names_document_and_place(name, t):
    assert PLACE.search(t.source) or "specifications" in t.source
    assert t.unit and FIGURE.match(t.quoted)


@pytest.mark.parametrize(("name", "t"), ALL, ids=named)
def test_a_limit_is_uniform_and_a_size_without_sign_is_one_sigma(name, t):
    sigma = "1 sigma" in t.quoted or "1 sigma" in t.source or "standard deviation" in t.source
    signed = FIGURE.match(t.quoted)["sign"] and not sigma
    assert t.distribution == ("uniform" if signed else "normal")


@pytest.mark.parametrize(("name", "t"), ALL, ids=named)
def test_the_size_is_what_the_data_sheet_prints(name, t):
    """By the rules of docs/parts.md, from the figure as quoted; files hold five figures.

    A figure over a span of temperature is what the linear coefficient makes of the span's farther
    end, one of nonlinearity the largest distance from the best straight line through the range.
    """
    match = FIGURE.match(t.quoted)
    figures = np.array([float(x) for x in match["numbers"].strip("[]").split(", ")])
    unit, span, reach = match["unit"], SPAN.search(t.quoted), RANGE.search(t.quoted)
    sizes = t.array if t.array.ndim == 1 else t.array[~np.eye(3, dtype=bool)]
    if span:
        low, high = float(span["low"]), float(span["high"])
        assert max(abs(low - 25), abs(high - 25)) == float(span["far"])
        sizes, si = sizes * float(span["far"]), t.si.removesuffix("/K")
        si = "1" if si == "1" else si
    elif reach:
        own = "rad/s" if t.key[0] == "gyro" else "m/s^2"
        x = np.linspace(-1, 1, 2001) * units.convert(float(reach["size"]), reach["unit"], own)
        sizes, si = np.ptp(np.outer(sizes, x**2), axis=1) / 2 / x.max(), "1"
    elif t.key[1] == "misalignment" and unit == "%":
        si = "1"
    else:
        si = t.si
    if "half of it each" in t.quoted:
        figures = figures / 2
    five_figures = 1e-5 * 5
    want = np.broadcast_to(units.convert(figures, unit, si), sizes.shape)
    np.testing.assert_allclose(sizes, want, rtol=five_figures)


@pytest.mark.parametrize("name", part_names())
def test_tolerances_are_written_and_read_back_the_same(name):
    again = parse_part(format_part(part(name)))
    assert again == part(name)
    texts = [[(t.unit, t.source, t.quoted) for t in p.tolerances] for p in (again, part(name))]
    assert texts[0] == texts[1]


# The file


def test_one_figure_stands_for_every_element_and_a_list_for_each_axis():
    p = read(
        '[tolerance.gyro.misalignment]\nm = {value = 2, unit = "mrad", distribution = "normal"}\n'
        "[tolerance.accel]\nscale_factor.s = {value = [1, 2, 3], unit = '%', "
        "distribution = 'uniform'}"
    )
    (m, s) = p.tolerances
    np.testing.assert_allclose(m.array, 2e-3 * (1 - np.eye(3)), rtol=1e-15)
    assert len(m.sizes) == 6
    np.testing.assert_allclose(s.array, [0.01, 0.02, 0.03], rtol=1e-15)
    assert p.gyro == Sensor("gyro") and p.accel == Sensor("accel")


B0 = "tolerance.gyro.turn_on_bias.b0"


def bias(entry):
    return f"[tolerance.gyro.turn_on_bias]\nb0 = {{{entry}}}\n"


def uniform(effect, parameter, entry):
    """A table of one coefficient that is uniform."""
    return f"[tolerance.{effect}]\n{parameter} = {{{entry}, distribution = 'uniform'}}\n"


ERRORS = {
    "tolerance = 3": "tolerance: must be a table such as [tolerance.gyro.turn_on_bias], not 3",
    "[tolerance.gyr]": "tolerance.gyr: unknown key; did you mean gyro?",
    "[tolerance.gyro]\nscale_factor = 1": (
        "tolerance.gyro.scale_factor: must be a table such as [tolerance.gyro.scale_factor] with s"
    ),
    "[tolerance.gyro.turn_on_bia]": (
        "tolerance.gyro.turn_on_bia: unknown effect; did you mean turn_on_bias?"
    ),
    "[tolerance.accel.g_sensitivity]": (
        "tolerance.accel.g_sensitivity: is an effect of gyro, not of accel"
    ),
    "[tolerance.gyro.thermal_bias]\nkt = 1": (
        "tolerance.gyro.thermal_bias.kt: unknown parameter; did you mean kT?"
    ),
    "[tolerance.gyro.turn_on_bias]\nb0 = 1": f"{B0}: must be a table such as {{value = 1.0, unit",
    bias("value = 1, distributio = 'normal'"): (
        f"{B0}.distributio: unknown key; did you mean distribution?"
    ),
    bias("value = 1, unit = 'deg/s'"): (
        f'{B0}.distribution: is missing ("uniform": anywhere within +-value; "normal": value is '
        "one standard deviation)"
    ),
    bias("value = 1, unit = 'deg/s', distribution = 'uniforn'"): (
        f"{B0}.distribution: unknown distribution 'uniforn'; did you mean uniform?"
    ),
    bias("value = 1, unit = 'deg/s', distribution = 3"): (
        f"{B0}.distribution: unknown distribution 3; known are uniform, normal"
    ),
    bias("value = 1, unit = 'deg/s', distribution = ['normal']"): (
        f"{B0}.distribution: unknown distribution ['normal']"
    ),
    uniform("gyro.turn_on_bias", "b0", "value = 1, unit = 'dpss'"): f"{B0}.unit: ",
    uniform("gyro.turn_on_bias", "b0", "value = 1"): f"{B0}: has no unit",
    uniform("gyro.turn_on_bias", "b0", "unit = 'deg/s'"): f"{B0}: has no value",
    uniform("gyro.turn_on_bias", "b0", "value = [1, 2], unit = 'deg/s'"): (
        f"{B0}: holds 2 numbers, expected 3 numbers"
    ),
    uniform("gyro.turn_on_bias", "b0", "value = -1, unit = 'deg/s'"): (
        f"{B0}: must not be negative, not "
    ),
    uniform("gyro.turn_on_bias", "b0", "value = inf, unit = 'deg/s'"): f"{B0}: must be finite",
    uniform("gyro.turn_on_bias", "b0", "value = 1, unit = 'deg/s', source = 3"): (
        f"{B0}.source: must be text, not 3"
    ),
    uniform("gyro.thermal_bias", "T0", "value = 1, unit = 'degC'"): (
        "tolerance.gyro.thermal_bias.T0: only fixes an origin and has no tolerance"
    ),
    uniform("gyro.misalignment", "m", "value = [1,0,0,0,0,0,0,0,0], unit = 'deg'"): (
        "tolerance.gyro.misalignment.m: must have zeros on its diagonal"
    ),
    uniform("gyro.lag", "wn", "value = 1, unit = 'rad/s'"): (
        "tolerance.gyro.lag.wn: the coefficient must not be below 0"
    ),
}


@pytest.mark.parametrize("body", ERRORS)
def test_errors_name_the_key(body):
    with pytest.raises(UserError, match=f"^a.toml: {re.escape(ERRORS[body])}"):
        read(body)


@pytest.mark.parametrize(
    ("key", "sizes", "distribution", "message"),
    [
        (("gyro", "scale_facto", "s"), (1,) * 3, "normal", "did you mean scale_factor"),
        (("accel", "g_sensitivity", "G"), (1,) * 9, "normal", "does not belong to a accel"),
        (("gyro", "scale_factor", "S"), (1,) * 3, "normal", "no parameter of scale_factor"),
        (("gyro", "scale_factor", "s"), (1,) * 3, "norma", "unknown distribution 'norma'"),
        (("gyro", "scale_factor", "s"), (1,) * 2, "normal", "needs 3 finite sizes from 0 on"),
        (("gyro", "scale_factor", "s"), (1, -1, 1), "normal", "needs 3 finite sizes from 0 on"),
        (("gyro", "scale_factor", "s"), (1, math.nan, 1), "normal", "needs 3 finite sizes"),
    ],
)
def test_a_tolerance_made_in_python_is_checked(key, sizes, distribution, message):
    with pytest.raises(UserError, match=message):
        Tolerance(key, sizes, distribution)


def test_a_coefficient_has_one_tolerance():
    t = Tolerance(("gyro", "scale_factor", "s"), (1.0,) * 3, "normal")
    with pytest.raises(UserError, match="part a: two tolerances of one coefficient"):
        Part("a", 100.0, tolerances=(t, t))


def test_a_part_goes_to_another_process_with_its_tolerances():
    p = part("mpu6050")
    again = pickle.loads(pickle.dumps(p))
    assert again == p and hash(again) == hash(p) and again.specimen(2) == p.specimen(2)


# Draws


def tolerance(distribution, size=1.0, key=("gyro", "misalignment", "m")):
    return Tolerance(key, (size,) * 6, distribution)


def draws(t, seeds):
    """Deviations (seeds, elements) of the free elements."""
    return np.array([[t.deviation(k)[i] for i in t.parameter.indices] for k in seeds])


SEEDS = range(3000)
CHANCE = 1e-3
"""That a test of a right generator fails; the seeds are fixed, so it does so always or never."""


@pytest.mark.parametrize(
    ("distribution", "law"),
    [("uniform", stats.uniform(-2, 4).cdf), ("normal", stats.norm(0, 2).cdf)],
)
def test_what_is_drawn_has_the_distribution(distribution, law):
    """Kolmogorov and Smirnov's test of each element over seeds, and no two elements or neighbouring
    seeds correlate: sqrt(n) r is standard normal for independent draws.
    """
    x = draws(tolerance(distribution, 2.0), SEEDS)
    tests = x.shape[1]
    assert min(stats.kstest(column, law).pvalue for column in x.T) > CHANCE / tests
    r = np.corrcoef(np.hstack([x[:-1], x[1:]]).T)[np.triu_indices(2 * tests, 1)]
    assert np.abs(r).max() * math.sqrt(len(x) - 1) < stats.norm.isf(CHANCE / 2 / len(r))


def test_a_uniform_draw_keeps_its_limit():
    assert np.abs(draws(tolerance("uniform", 0.02), SEEDS)).max() < 0.02


def philox(key, counter):
    """The first word of Philox4x64-10 in whole numbers (Salmon and others 2011, section 3.3)."""
    m, w = (0xD2E7470EE14C6C93, 0xCA5A826395121157), (0x9E3779B97F4A7C15, 0xBB67AE8584CAA73B)
    x, mask = [counter, 0, 0, 0], 2**64 - 1
    for k in range(10):
        keys = [(key[i] + k * w[i]) & mask for i in range(2)]
        products = [m[0] * x[0], m[1] * x[2]]
        x = [
            (products[1] >> 64) ^ x[1] ^ keys[0],
            products[1] & mask,
            (products[0] >> 64) ^ x[3] ^ keys[1],
            products[0] & mask,
        ]
    return x[0]


@pytest.mark.parametrize("seed", [0, 7, 2**64 - 1])
def test_a_draw_is_the_first_word_of_the_stream_of_seed_and_name(seed):
    """The stream's number is the CRC-32 of the parameter's name in a unit, plus 2^32."""
    deviation = tolerance("uniform").deviation(seed)
    channel = 2**32 + zlib.crc32(b"gyro_error.misalignment.m[2,3]")
    word = philox((seed, channel), 1)
    assert deviation[1, 2] == 2.0 * ((word >> 12) + 0.5) / 2**52 - 1.0


def test_draws_are_those_of_every_platform_and_release():
    """Kept here, for whoever wrote down a seed wants the same specimen again."""
    p = part("mpu6050").specimen(7)
    drawn = p.gyro.values["turn_on_bias"]["b0"] * 180 / math.pi
    np.testing.assert_allclose(drawn, [-18.4228291, 5.791285399, -10.32895035], rtol=1e-9)
    g = p.gyro.values["g_sensitivity"]["G"][0] * 180 / math.pi * 9.80665
    np.testing.assert_allclose(g, [0.2304830384, 0.08482354381, 0.1301550111], rtol=1e-9)


TABLES = {
    "turn_on_bias": uniform("gyro.turn_on_bias", "b0", "value = 3, unit = 'deg/s'"),
    "scale_factor": uniform("gyro.scale_factor", "s", "value = 3, unit = '%'"),
    "accel": uniform("accel.turn_on_bias", "b0", "value = 3, unit = 'mg'"),
}


def test_a_draw_depends_on_no_other_table_and_on_no_order():
    orders = [read("".join(TABLES[n] for n in order)) for order in (TABLES, reversed(TABLES))]
    assert orders[0] == orders[1]
    first, second = (p.specimen(3) for p in orders)
    alone = read(TABLES["turn_on_bias"]).specimen(3)
    assert first == second
    values = [p.gyro.values["turn_on_bias"]["b0"] for p in (first, alone)]
    np.testing.assert_array_equal(*values)
    assert not np.allclose(values[0] / 3, np.ravel(first.accel.values["turn_on_bias"]["b0"]) / 3)


# Specimens


def test_a_specimen_is_the_part_and_its_deviations_and_says_so():
    p = read(
        "[gyro]\nscale_factor.s = 0.01\nturn_on_bias = 'estimate'\n"
        "angle_random_walk.N = {value = 1, unit = 'deg/sqrt(h)', source = 'x'}\n"
        "[tolerance.gyro.turn_on_bias]\nb0 = {value = 3, unit = 'deg/s', distribution = 'uniform', "
        "source = 'sheet, page 3', quoted = '+-3 deg/s'}\n" + TABLES["scale_factor"]
    )
    made = p.specimen(11)
    assert (made.name, made.description) == ("a, specimen 11", "a, specimen 11")
    assert not made.tolerances and not made.estimate and made.accel == p.accel
    assert made.notes["gyro", "turn_on_bias", "b0"] == {
        "unit": "deg/s",
        "source": "drawn, specimen 11, of +-3 deg/s (uniform), sheet, page 3",
    }
    assert made.notes["gyro", "angle_random_walk", "N"] == p.notes["gyro", "angle_random_walk", "N"]
    bias, scale = p.tolerances[1], p.tolerances[0]
    ten_figures = 1e-9
    np.testing.assert_allclose(
        made.gyro.values["turn_on_bias"]["b0"], bias.deviation(11), rtol=ten_figures
    )
    np.testing.assert_allclose(
        made.gyro.values["scale_factor"]["s"], 0.01 + scale.deviation(11), rtol=ten_figures
    )
    assert parse_part(format_part(made)) == made and 'unit = "deg/s"' in format_part(made)


@pytest.mark.parametrize("name", sorted({name for name, _ in ALL}))
def test_every_part_gives_specimens_that_differ_and_read_back(name):
    one, two = part(name).specimen(1), part(name).specimen(2)
    assert one == part(name).specimen(1) and one != two
    assert parse_part(format_part(one)) == one
    keys = {t.key for t in part(name).tolerances}
    assert {k for k, note in one.notes.items() if "drawn, specimen 1" in note["source"]} == keys


def test_a_part_without_tolerances_has_no_specimens():
    with pytest.raises(UserError, match=r"^part imt30 has no tolerances .*\[tolerance\.gyro"):
        part("imt30").specimen(1)


@pytest.mark.parametrize("seed", [-1, 2**64, 1.5, True])
def test_a_seed_is_a_whole_number_of_64_bits(seed):
    with pytest.raises(UserError, match="is not an integer in 0 to"):
        part("mpu6050").specimen(seed)


def test_a_draw_outside_the_bounds_of_a_coefficient_is_refused():
    """A normal deviation of 1 rad/s from a corner at 1e-6 rad/s is one for half of the seeds."""
    p = read(
        "[gyro.lag]\nwn = {value = 1e-6, unit = 'rad/s'}\n"
        "[tolerance.gyro.lag]\nwn = {value = 1, unit = 'rad/s', distribution = 'normal'}"
    )
    seed = next(k for k in range(99) if p.tolerances[0].deviation(k) < -1e-6)
    with pytest.raises(
        UserError, match=f"^part a, specimen {seed}: gyro lag.wn must not be below 0"
    ):
        p.specimen(seed)


# What a tolerance is not


@pytest.mark.parametrize("name", one_of_each_kind())
def test_nothing_of_a_part_but_its_specimens_knows_its_tolerances(name):
    p = part(name)
    plain = Part(p.name, p.sample_rate, p.gyro, p.accel, p.estimate, p.notes, p.description)
    assert p.block.parameters == plain.block.parameters and p.signals == plain.signals


def test_the_model_that_close_writes_is_of_one_specimen_and_has_none():
    p = part("mpu6050")
    assert as_part(p, [], p, {}).tolerances == ()


@pytest.mark.parametrize("name", ["mpu6050", "stim300"])
def test_the_effects_of_tolerances_at_their_identity_change_no_bit(name):
    """Of finite inputs, the sign of a zero apart: x + 0 is +0 for x = -0."""
    p, rng = part(name), np.random.default_rng(5)
    rate, force = 0.5 * rng.standard_normal((2, 3000, 3)) + np.array([[[0.1]], [[5.0]]])
    temperature = np.linspace(-30.0, 70.0, 3000)
    have, want = (simulate(q, rate, force, temperature, seed=4) for q in (p.nominal, p))
    assert set(p.nominal.gyro.values) >= {t.key[1] for t in p.tolerances if t.key[0] == "gyro"}
    for a, b in zip(have, want, strict=True):
        assert np.array_equal(a, b)
