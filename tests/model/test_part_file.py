"""Part files: what a file says, in SI; every mistake named by its key; what was written reads back
the same.
"""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pyimu.errors import UserError, printable
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.part_entry import RATE_KEY
from pyimu.model.part_file import load_part, part, part_names, save_part
from pyimu.model.part_reader import parse_part
from pyimu.model.part_writer import format_part
from pyimu.model.sensor import Sensor

HEAD = 'name = "a"\nsample_rate = {value = 100.0, unit = "Hz"}\n'
DEG = np.pi / 180


def read(body):
    return parse_part(HEAD + body, "a.toml")


def test_imt30_is_hidalgo_tables_1_2_and_4():
    p = part("imt30")
    assert "imt30" in part_names() and p.name == "imt30" and p.sample_rate == 976.0
    tables = {
        ("thermal_bias", "kT"): np.array([0.020, 0.056, 0.050]) * DEG,
        ("angle_random_walk", "N"): np.array([0.20764, 0.23858, 0.20489]) * DEG / 60,
        ("rate_random_walk", "K"): np.array([32.8, 49.6, 64.2]) * DEG / 3600 / 60,
    }
    for (effect, parameter), want in tables.items():
        np.testing.assert_allclose(p.gyro.values[effect][parameter], want, rtol=1e-14)
    assert (
        set(p.gyro.values) == {"thermal_bias", "angle_random_walk", "rate_random_walk"}
        and not p.accel.values
    )


@pytest.mark.parametrize("name", part_names())
def test_built_in_parts_give_a_source_for_every_figure(name):
    p = part(name)
    for key, note in p.notes.items():
        effect = CATALOGUE.get(key[1])
        if effect is None or not effect.parameters[key[2]].reference:
            assert note.get("source"), f"{name}: {'.'.join(key)} has no source"
    assert parse_part(format_part(p)) == p


def test_a_number_stands_for_all_axes_and_a_matrix_may_be_flat():
    p = read(
        "[gyro]\nscale_factor.s = 0.01\ng_sensitivity.G = {value = [1,2,3,4,5,6,7,8,9], unit = "
        '"rad/s/(m/s^2)"}\n'
        'misalignment.m = {value = [[0,1,2],[3,0,4],[5,6,0]], unit = "mrad"}'
    )
    np.testing.assert_array_equal(p.gyro.values["scale_factor"]["s"], [0.01] * 3)
    np.testing.assert_array_equal(
        p.gyro.values["g_sensitivity"]["G"], np.arange(1.0, 10).reshape(3, 3)
    )
    m = p.gyro.values["misalignment"]["m"]
    np.testing.assert_allclose(m, [[0, 1e-3, 2e-3], [3e-3, 0, 4e-3], [5e-3, 6e-3, 0]], rtol=1e-15)


def test_a_reference_temperature_is_a_reading_and_not_a_difference():
    kelvin = read(
        '[gyro.thermal_bias]\nkT = {value = 1, unit = "deg/s/degC"}\nT0 = {value = 293.15, unit = '
        '"K"}'
    )
    assert kelvin.gyro.values["thermal_bias"]["T0"] == pytest.approx(20.0, abs=1e-12)
    np.testing.assert_allclose(kelvin.gyro.values["thermal_bias"]["kT"], DEG, rtol=1e-15)


def test_a_one_sided_density_is_divided_by_the_root_of_two_and_kept_as_quoted():
    entry = (
        '[gyro.angle_random_walk]\nN = {{value = 0.005, unit = "deg/s/sqrt(Hz)", density = "{}"}}'
    )
    one, two = read(entry.format("one-sided")), read(entry.format("two-sided"))
    np.testing.assert_allclose(
        one.gyro.values["angle_random_walk"]["N"], 0.005 * DEG / np.sqrt(2), rtol=1e-15
    )
    np.testing.assert_allclose(two.gyro.values["angle_random_walk"]["N"], 0.005 * DEG, rtol=1e-15)
    assert (
        one.notes["gyro", "angle_random_walk", "N"]["quoted"] == "0.005 deg/s/sqrt(Hz), one-sided"
    )


def test_a_density_is_written_only_where_its_unit_is_one():
    """A note from elsewhere may name a density beside a random walk's unit; what is written must
    read back.
    """
    walk = Sensor("gyro", {"angle_random_walk": {"N": 1e-3}})
    made = Part(
        "a",
        100.0,
        walk,
        notes={("gyro", "angle_random_walk", "N"): {"unit": "deg/sqrt(h)", "density": "one-sided"}},
    )
    assert "density" not in format_part(made) and parse_part(format_part(made)) == made


def test_estimate_leaves_coefficients_to_the_data():
    p = read(
        '[gyro]\nthermal_bias = "estimate"\nscale_factor.s = "estimate"\n'
        'lag = {wn = {value = "estimate", start = 50, unit = "Hz*rad"}}'
    )
    assert p.estimate == {
        ("gyro", "thermal_bias", "kT"),
        ("gyro", "scale_factor", "s"),
        ("gyro", "lag", "wn"),
    }
    assert p.gyro.values["thermal_bias"]["T0"] == 25.0 and p.gyro.values["lag"]["wn"] == 50.0
    np.testing.assert_array_equal(p.gyro.values["scale_factor"]["s"], np.zeros(3))


ERRORS = dict(
    [
        (
            "[gyro.angel_random_walk]",
            "gyro.angel_random_walk: unknown effect; did you mean angle_random_walk?",
        ),
        ("[gyro.zzz]", "gyro.zzz: unknown effect; known are "),
        (
            "[gyro.velocity_random_walk]",
            "gyro.velocity_random_walk: unknown effect; it is called angle_random_walk here",
        ),
        ("[gyro.Sensitivity]", "gyro.Sensitivity: unknown effect; it is called quantization here"),
        ("[gyros.scale_factor]", "gyros: unknown key; did you mean gyro?"),
        (
            "[gyro.angle_random_walk]\nn = 3",
            "gyro.angle_random_walk.n: unknown parameter; did you mean N?",
        ),
        (
            '[accel.g_sensitivity]\nG = "estimate"',
            "accel.g_sensitivity: is an effect of gyro, not of accel",
        ),
        (
            "[gyro.angle_random_walk]",
            'gyro.angle_random_walk: must be "estimate" or a table with N, not {}',
        ),
        ("gyro.scale_factor = 3", 'gyro.scale_factor: must be "estimate" or a table with s, not 3'),
        (
            "gyro = 3",
            "gyro: must be a table with one table per effect, such as [gyro.turn_on_bias]",
        ),
        (
            "[gyro.angle_random_walk]\nN = 3",
            'gyro.angle_random_walk.N: has no unit, write {value = ..., unit = "rad/sqrt(s)"}',
        ),
        (
            "[accel.turn_on_bias]\nb0 = {value = 3}",
            'accel.turn_on_bias.b0: has no unit, write {value = ..., unit = "m/s^2"}',
        ),
        (
            '[gyro.angle_random_walk]\nN = {value = 3, unit = "deg/s"}',
            "gyro.angle_random_walk.N.unit: 'deg/s' cannot be converted to 'rad/sqrt(s)'",
        ),
        (
            '[gyro.turn_on_bias]\nb0 = {value = 3, unit = "dpss"}',
            "gyro.turn_on_bias.b0.unit: 'dpss' is not a unit: unknown 'dpss', did you mean dps?",
        ),
        (
            '[gyro.turn_on_bias]\nb0 = {value = "estimate", unit = "dpss"}',
            "gyro.turn_on_bias.b0.unit: 'dpss' is not a unit",
        ),
        (
            '[gyro.thermal_bias]\nT0 = {value = 3, unit = "rad"}',
            "gyro.thermal_bias.T0.unit: a temperature must be in degC, K or degF, not 'rad'",
        ),
        (
            '[gyro.thermal_bias]\nT0 = "estimate"',
            'gyro.thermal_bias.T0: only fixes an origin and cannot be "estimate"',
        ),
        (
            "[gyro.scale_factor]\ns = [1, 2]",
            "gyro.scale_factor.s: holds 2 numbers, expected 3 numbers",
        ),
        ("[gyro.scale_factor]\ns = []", "gyro.scale_factor.s: holds 0 numbers, expected 3 numbers"),
        ("[gyro.lag]\nzeta = [1.0]", "gyro.lag.zeta: holds 1 numbers, expected one number"),
        (
            '[gyro.misalignment]\nm = {value = 1, unit = "rad"}',
            "gyro.misalignment.m: holds one number, expected a 3 x 3 matrix",
        ),
        (
            '[gyro.misalignment]\nm = {value = [[1, 2], [3]], unit = "rad"}',
            "gyro.misalignment.m: holds rows of unequal length, expected a 3 x 3 matrix",
        ),
        (
            '[gyro.misalignment]\nm = {value = [1, 2, 3, 4, 5, 6, 7, 8, 9], unit = "rad"}',
            (
                "gyro.misalignment.m: must have zeros on its diagonal, "
                "not [[1, 2, 3], [4, 5, 6], [7, 8, 9]] rad"
            ),
        ),
        ('[gyro.scale_factor]\ns = "3 %"', "gyro.scale_factor.s: must be a number, not '3 %'"),
        (
            "[gyro.scale_factor]\ns = [1, true, 3]",
            "gyro.scale_factor.s: must be a number, not True",
        ),
        ("[gyro.scale_factor]\ns = [1, nan, 3]", "gyro.scale_factor.s: must be finite"),
        ("[gyro.scale_factor]\ns = [1, inf, 3]", "gyro.scale_factor.s: must be finite"),
        (f"[gyro.scale_factor]\ns = 1{'0' * 400}", "gyro.scale_factor.s: must be finite"),
        ('[gyro.scale_factor]\ns = {unit = "1"}', "gyro.scale_factor.s: has no value"),
        (
            "[gyro.scale_factor]\ns = {value = 1, unit = 3}",
            "gyro.scale_factor.s.unit: must be text, not 3",
        ),
        (
            '[gyro.bias_instability]\nB = {value = "0,3", unit = "°/h"}',
            "gyro.bias_instability.B: must be a number, not '0,3': write 0.3",
        ),
        (
            '[gyro.scale_factor]\ns = {value = 1, sourc = "x"}',
            "gyro.scale_factor.s.sourc: unknown key; did you mean source?",
        ),
        (
            "[gyro.scale_factor]\ns = {value = 1, start = 2}",
            'gyro.scale_factor.s.start: goes only with value = "estimate"',
        ),
        (
            '[gyro.scale_factor]\ns = {value = 1, density = "one-sided"}',
            "gyro.scale_factor.s.density: goes only with the root of a noise's density",
        ),
        (
            '[gyro.angle_random_walk]\nN = {value = 1, unit = "deg/sqrt(h)", density = "half"}',
            'gyro.angle_random_walk.N.density: must be "one-sided" or "two-sided", not \'half\'',
        ),
        *(
            (
                (
                    "[gyro.angle_random_walk]\n"
                    f'N = {{value = 1, unit = "{unit}", density = "{density}"}}'
                ),
                (
                    "gyro.angle_random_walk.N.density: "
                    f"goes only with a unit per sqrt(Hz), not with {unit}"
                ),
            )
            for unit in ("deg/sqrt(h)", "rad/sqrt(s)")
            for density in ("one-sided", "two-sided")
        ),
        (
            '[gyro.time_delay]\ntd = {value = 301, unit = "ms"}',
            "part a: gyro time_delay: td must not be above 30 sample periods",
        ),
        (
            (
                '[accel.bias_instability]\nB = {value = 1, unit = "mg"}\n'
                'f_high = {value = 2, unit = "Hz"}'
            ),
            "part a: accel bias_instability: f_high must lie 2 to 5 decades above f_low",
        ),
        (
            '[gyro.angle_random_walk]\nN = {value = [1, -1, 1], unit = "deg/sqrt(h)"}',
            "gyro.angle_random_walk.N: must not be below 0, not [1, -1, 1] deg/sqrt(h)",
        ),
        ("[gyro.lag]\nzeta = 3", "gyro.lag.zeta: must not be above 2, not 3"),
        (
            "[gyro.scale_factor]\ns = one",
            "cannot be read as TOML: Invalid value (at line 4, column 5)",
        ),
    ]
)


@pytest.mark.parametrize("body", ERRORS)
def test_errors_say_where_and_what_would_be_right(body):
    with pytest.raises(UserError, match=f"^a.toml: {re.escape(ERRORS[body])}") as caught:
        read(body)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "head, message",
    [
        ("", "name: is missing"),
        ("name = 3", "name: must be text, not 3"),
        ('name = "a"', "sample_rate: is missing"),
        ('name = "a"\nsample_rate = 3', "sample_rate: 3 has no unit"),
        (
            'name = "a"\nsample_rate = {value = 3, unit = "hz"}',
            "sample_rate.unit: 'hz' is not a unit",
        ),
        ('name = "a"\nsample_rate = {value = 0, unit = "Hz"}', "sample_rate: must be above 0"),
        (
            'name = "a"\nsample_rate = {value = [1, 2], unit = "Hz"}',
            "sample_rate: holds 2 numbers, expected one number",
        ),
        (
            'name = "a"\nsample_rate = {value = 3, unit = "s"}',
            "sample_rate.unit: 's' cannot be converted to 'Hz'",
        ),
    ],
)
def test_errors_in_the_head(head, message):
    with pytest.raises(UserError, match=f"^a.toml: {re.escape(message)}"):
        parse_part(head, "a.toml")


BIAS = '[gyro.turn_on_bias]\nb0 = {value = 1, unit = "deg/h", WHAT}\n'
SPREAD = '[tolerance.gyro.turn_on_bias]\nb0 = {value = 1, unit = "deg/h", WHAT}\n'


@pytest.mark.parametrize(
    "text, where",
    [
        ('description = "ESC"\n' + HEAD, "description"),
        (HEAD.replace('"a"', '"ESC"'), "name"),
        (HEAD.replace("}", ', source = "ESC"}'), "sample_rate.source"),
        (HEAD.replace('"Hz"', '"Hz\\u001f"'), "sample_rate.unit"),
        (HEAD + BIAS.replace("WHAT", 'source = "ESC"'), "gyro.turn_on_bias.b0.source"),
        (HEAD + BIAS.replace("WHAT", 'quoted = "ESC"'), "gyro.turn_on_bias.b0.quoted"),
        (
            HEAD + SPREAD.replace("WHAT", 'distribution = "normal", source = "ESC"'),
            "tolerance.gyro.turn_on_bias.b0.source",
        ),
    ],
)
def test_no_text_has_what_a_terminal_obeys(text, where):
    """It would be printed, and stand in comments and in XML, which then is none."""
    message = f"^a.toml: {where}: .* has a character that no terminal shows"
    with pytest.raises(UserError, match=message) as caught:
        parse_part(text.replace("ESC", r"a\u001b[2Jb"), "a.toml")
    assert str(caught.value).isprintable()


def test_a_text_of_several_lines_is_joined():
    read = parse_part('description = """two\nlines,\tone"""\n' + HEAD, "a.toml")
    assert read.description == "two lines, one"
    with pytest.raises(UserError, match="a.toml: name: .*U.000A"):
        parse_part(HEAD.replace('"a"', '"a\\nb"'), "a.toml")


def test_a_part_that_is_nowhere(tmp_path):
    nowhere = "no built-in part and no TOML file"
    with pytest.raises(UserError, match=rf"^imt31: {nowhere}; did you mean imt30\?$"):
        part("imt31")
    with pytest.raises(UserError, match=rf"^qqqq: {nowhere}; known are .*, imt30, .*$"):
        part("qqqq")
    with pytest.raises(UserError, match="no.toml: no such file"):
        part(tmp_path / "no.toml")
    with pytest.raises(UserError, match="cannot be read"):
        part(tmp_path)
    (tmp_path / "latin.toml").write_bytes(b"name = '\xe9'")
    with pytest.raises(UserError, match="is not text in UTF-8"):
        part(tmp_path / "latin.toml")


def test_a_saved_part_keeps_figures_units_and_sources(tmp_path):
    path = save_part(part("imt30"), tmp_path / "new" / "copy.toml")
    text = path.read_text()
    assert (
        'N = {value = [0.20764, 0.23858, 0.20489], unit = "deg/sqrt(h)", source = "Hidalgo 2012, '
        'table 2"}' in text
    )
    again = part(path)
    assert again == part("imt30") and part(again) is again
    assert again.notes[RATE_KEY] == part("imt30").notes[RATE_KEY]
    assert [f.name for f in path.parent.iterdir()] == ["copy.toml"]


def test_a_file_that_cannot_be_written_leaves_nothing(tmp_path):
    (tmp_path / "taken.toml").mkdir()
    with pytest.raises(UserError, match="taken.toml: cannot be written"):
        save_part(part("imt30"), tmp_path / "taken.toml")
    assert [f.name for f in tmp_path.iterdir()] == ["taken.toml"]


UNITS = {
    ("turn_on_bias", "b0"): ("deg/h", "rad/s", "deg/s"),
    ("angle_random_walk", "N"): ("deg/sqrt(h)", "deg/s/sqrt(Hz)"),
    ("thermal_bias", "T0"): ("degC", "K"),
    ("thermal_bias", "kT"): ("deg/h/K", "mrad/s/degC"),
}
FIGURES = st.floats(0, 1e6, allow_subnormal=False) | st.floats(1e-12, 1e-3)
LONG = 199
"""Characters that a name may have behind its first."""


@given(
    st.tuples(*[FIGURES] * 8),
    st.tuples(*[st.integers(0, 5)] * 4),
    st.booleans(),
    st.text(),
    st.booleans(),
)
def test_any_part_reads_back_equal(v, choice, one_sided, text, estimate):
    """Whatever the value and the unit in which it is shown: the same SI value to the last bit."""
    text = printable(text)
    keys = list(UNITS)
    notes = {
        ("gyro", *k): {"unit": UNITS[k][c % len(UNITS[k])], "source": text}
        for k, c in zip(keys, choice)
    }
    if one_sided:
        notes["gyro", "angle_random_walk", "N"]["density"] = "one-sided"
    gyro = Sensor(
        "gyro",
        {
            "turn_on_bias": {"b0": v[:3]},
            "angle_random_walk": {"N": v[3:6]},
            "thermal_bias": {"T0": v[6], "kT": -v[7]},
        },
    )
    leave = frozenset({("gyro", "thermal_bias", "kT")}) if estimate else frozenset()
    name = "x" + text[:LONG]
    made = Part(name, 1 / 0.3, gyro=gyro, notes=notes, estimate=leave, description=text)
    assert parse_part(format_part(made)) == made


def test_load_part_and_the_name_agree(tmp_path):
    path = tmp_path / "imt30.toml"
    path.write_text(format_part(part("imt30")))
    assert load_part(path) == part(str(path)) == part("imt30")


CROSS = [[0, 2, 1], [0.5, 0, 1], [1, 1, 0]]
"""% of axis j seen by axis i."""


@pytest.mark.parametrize("entry", ['B = {value = -0,3, unit = "°/h"}', "B.value = -0,3"])
def test_a_decimal_comma_is_told(entry):
    with pytest.raises(UserError, match="numbers have a decimal point: -0.3, not -0,3"):
        read(f"[gyro.bias_instability]\n{entry}")


def test_a_density_says_whether_it_is_one_sided():
    """Read in silence as two-sided, a data sheet's figure would be 1.41 times too large."""
    walk = '[gyro.rate_random_walk]\nK = {{value = 5, unit = "rad/s^2/√Hz"{}}}'
    with pytest.raises(UserError, match='add density = "one-sided".*or density = "two-sided"'):
        read(walk.format(""))
    two = read(walk.format(', density = "two-sided"'))
    np.testing.assert_array_equal(two.gyro.values["rate_random_walk"]["K"], 5.0)
    entry = '[gyro.angle_random_walk]\nN = {{value = 5, unit = "{}"{}}}'
    for unit in (
        *("mdps/√Hz", "deg/s/sqrt(Hz)", "mdps/rtHz", "mdps/√H\u0305z\u0305"),
        *("mdps/Hz½", "° s⁻¹ Hz^-0.5", "mdps·Hz⁻¹ᐟ²", "mdps/√Hz (1σ)"),
    ):
        with pytest.raises(UserError, match='add density = "one-sided".*or density = "two-sided"'):
            read(entry.format(unit, ""))
    read(entry.format("deg/√hr", ""))
    one = read(entry.format("mdps/√Hz", ', density = "one-sided"'))
    again = parse_part(format_part(one))
    assert again == one and 'density = "one-sided"' in format_part(one)
    np.testing.assert_allclose(
        one.gyro.values["angle_random_walk"]["N"], 5e-3 * DEG / np.sqrt(2), rtol=1e-14
    )


@pytest.mark.parametrize(
    ("kind", "entry", "value"),
    [
        ("gyro", 'quantization.q = {value = 16.4, unit = "LSB/(°/s)"}', DEG / 16.4),
        ("gyro", 'quantization.q = {value = 16.4, unit = "LSB/°/s"}', DEG / 16.4),
        ("gyro", 'quantization.q = {value = 8.75, unit = "mdps/LSB"}', 8.75e-3 * DEG),
        ("accel", 'quantization.q = {value = 16384, unit = "LSB/g"}', 9.80665 / 16384),
        ("accel", 'quantization.q = {value = 0, unit = "LSB/g"}', 0.0),
        ("gyro", 'lag.wn = {value = 47, unit = "Hz"}', 2 * np.pi * 47),
        ("accel", 'lag.wn = {value = 0.4, unit = "kHz"}', 2 * np.pi * 400),
        ("accel", f'misalignment.m = {{value = {CROSS}, unit = "%"}}', np.array(CROSS) / 100),
    ],
)
def test_steps_in_counts_and_corners_in_hertz_are_read_as_printed(kind, entry, value):
    made = read(f"[{kind}]\n{entry}")
    effect, parameter = entry.split(" ")[0].split(".")
    np.testing.assert_allclose(made.sensor(kind).values[effect][parameter], value, rtol=1e-14)
    assert parse_part(format_part(made)) == made


@pytest.mark.parametrize(
    "entry",
    [
        'turn_on_bias.b0 = {value = 1, unit = "Hz"}',
        'quantization.q = {value = 1, unit = "LSB/g"}',
        'scale_factor.s = {value = 1, unit = "LSB"}',
        'misalignment.m = {value = [[0, 1, 1], [1, 0, 1], [1, 1, 0]], unit = "LSB/rad"}',
    ],
)
def test_counts_and_hertz_are_taken_only_where_they_say_the_same(entry):
    with pytest.raises(UserError, match="cannot be converted"):
        read(f"[gyro]\n{entry}")
