"""Built-in parts: each figure has a source, is what its data sheet prints once converted, and makes
a sensor that runs.
"""

import math
import re
import sys
from importlib.resources import files

import numpy as np
import pytest
from catalogue_cases import one_of_each_kind
from places import CHECKOUT

from pyimu import units
from pyimu.block.normals import normals
from pyimu.cli import main
from pyimu.model.kinds import KINDS
from pyimu.model.part_entry import RATE_KEY
from pyimu.model.part_file import part, part_names
from pyimu.report.parts_table import ABSENT, COLUMNS, SIDES, as_data, detail, listing

DATA_SHEETS = [name for name in part_names() if name != "imt30"]
PAGE = re.compile(r"table|page|section|register|FAQ|clock|rate|specifications", re.IGNORECASE)
FIGURES = re.compile(r"^\[?(?P<numbers>[\d.]+(?:, [\d.]+)*)\]? (?P<unit>\S+)")
FLOOR = math.sqrt(2 * math.log(2) / math.pi)
"""Floor of the Allan deviation of 1/f noise over B (IEEE Std 952)."""

ALL = [(name, key) for name in part_names() for key in part(name).notes if key != RATE_KEY]
QUOTED = [(name, key) for name, key in ALL if "quoted" in part(name).notes[key]]


def of(parameter):
    return [(name, key) for name, key in QUOTED if key[1:] == parameter]


def value(name, key):
    return part(name).sensor(key[0]).values[key[1]][key[2]]


def printed(name, key):
    """The figures that a data sheet prints, per axis, and the rest of ``quoted`` from the unit
    on.
    """
    text = part(name).notes[key]["quoted"]
    match = FIGURES.match(text)
    numbers = np.array([float(x) for x in match["numbers"].split(", ")])
    return np.broadcast_to(numbers, 3) if numbers.size in (1, 3) else numbers, match["unit"]


def test_there_are_the_paper_s_part_and_at_least_eight_of_data_sheets():
    assert "imt30" in part_names() and len(DATA_SHEETS) >= 8
    for name in DATA_SHEETS:
        p = part(name)
        assert p.gyro.values or p.accel.values, name
        for sensor in (p.gyro, p.accel):
            noise = {"angle_random_walk", "bias_instability"} & set(sensor.values)
            assert noise or not sensor.values, name
    assert sum("tactical" in part(name).description for name in DATA_SHEETS) >= 1


@pytest.mark.parametrize("name", part_names())
def test_a_part_is_called_as_its_file_and_says_what_it_is(name):
    p = part(name)
    assert p.name == name and p.description and not p.estimate


@pytest.mark.parametrize("name", part_names())
def test_every_figure_names_document_and_place(name):
    for key, note in part(name).notes.items():
        assert PAGE.search(note.get("source", "")), (
            f"{name} {'.'.join(key)}: {note.get('source')!r}"
        )


def test_the_page_counts_the_figures_of_which_no_text_was_found():
    texts = [(files("pyimu.model") / "parts" / f"{name}.toml").read_text() for name in part_names()]
    counts = [text.count("unchecked") for text in texts]
    said = f"the {sum(counts)} figures that bear the word, of {sum(c > 0 for c in counts)} parts"
    assert said in (CHECKOUT / "docs" / "parts.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", DATA_SHEETS)
def test_the_head_of_a_file_says_how_it_is_read_and_what_was_not_found(name):
    text = files("pyimu.model").joinpath("parts", f"{name}.toml").read_text(encoding="utf-8")
    head = text[: text.index("\nname = ")]
    assert "docs/parts.md" in head and "Not modelled" not in text
    for kind in KINDS:
        if "bias_instability" not in part(name).sensor(kind).values:
            assert re.search(r"no(t|ne)\b.*\bfound", head, re.DOTALL | re.IGNORECASE)


@pytest.mark.parametrize("name", DATA_SHEETS)
def test_no_tolerance_became_a_coefficient(name):
    for kind in KINDS:
        fixed = {"lag", "angle_random_walk", "bias_instability", "saturation", "quantization"}
        assert set(part(name).sensor(kind).values) <= fixed


@pytest.mark.parametrize(
    ("name", "key"), of(("angle_random_walk", "N")), ids=lambda x: x if isinstance(x, str) else x[0]
)
def test_a_printed_density_is_one_sided_and_a_printed_random_walk_is_n(name, key):
    """N in SI by hand: N^2 = S1 / 2 for a one-sided density S1, and N = walk / sqrt(time) for a
    random walk.
    """
    figures, unit = printed(name, key)
    angle = {"deg": math.pi / 180, "m": 1.0}
    if unit in ("deg/s/sqrt(Hz)", "ug/sqrt(Hz)"):
        root = figures * {"deg/s/sqrt(Hz)": math.pi / 180, "ug/sqrt(Hz)": 9.80665e-6}[unit]
        want = np.sqrt(root**2 / 2)
    else:
        assert unit in ("deg/sqrt(h)", "m/s/sqrt(h)"), unit
        want = figures * angle[unit.split("/")[0]] / 60
    np.testing.assert_allclose(value(name, key), want, rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "key"), of(("bias_instability", "B")), ids=lambda x: x if isinstance(x, str) else x[0]
)
def test_the_allan_floor_of_b_is_the_printed_bias_stability(name, key):
    figures, unit = printed(name, key)
    floor = FLOOR * value(name, key)
    four_figures = 5e-4
    np.testing.assert_allclose(
        floor,
        units.convert(figures, unit, "rad/s" if key[0] == "gyro" else "m/s^2"),
        rtol=four_figures,
    )


@pytest.mark.parametrize(
    ("name", "key"), of(("lag", "wn")), ids=lambda x: x if isinstance(x, str) else x[0]
)
def test_the_low_pass_is_three_db_down_at_the_printed_bandwidth(name, key):
    """Against |G|^2 of the second-order low-pass; a bandwidth entered can be shown by the
    samples.
    """
    p, frequency = part(name), float(re.match(r"[\d.]+", part(name).notes[key]["quoted"]).group())
    wn, zeta = (float(p.sensor(key[0]).values["lag"][x]) for x in ("wn", "zeta"))
    s = 2j * math.pi * frequency
    assert abs(wn**2 / (s * s + 2 * zeta * wn * s + wn**2)) ** 2 == pytest.approx(0.5, rel=1e-6)
    assert frequency < p.sample_rate / 3


@pytest.mark.parametrize(
    ("name", "key"), of(("quantization", "q")), ids=lambda x: x if isinstance(x, str) else x[0]
)
def test_the_step_is_the_printed_one(name, key):
    figures, unit = printed(name, key)
    si = "rad/s" if key[0] == "gyro" else "m/s^2"
    want = (
        units.convert(1 / figures, unit.removeprefix("LSB/").strip("()"), si)
        if unit.startswith("LSB/")
        else units.convert(figures, unit, si)
    )
    np.testing.assert_allclose(value(name, key), want, rtol=1e-12)


@pytest.mark.parametrize(
    ("density", "unit", "walk", "name", "kind"),
    [
        (0.008, "deg/s/sqrt(Hz)", 0.34, "adis16470", "gyro"),
        (0.05, "deg/s/sqrt(Hz)", 2.0, "adis16405", "gyro"),
    ],
)
def test_sheets_that_print_density_and_random_walk_agree_on_one_sided(
    density, unit, walk, name, kind
):
    """The printed figures are rounded to one or two digits; read as two-sided, the density would
    miss by 41 %.
    """
    n = units.convert(
        float(value(name, (kind, "angle_random_walk", "N"))[0]), "rad/sqrt(s)", "deg/sqrt(h)"
    )
    assert n == pytest.approx(walk) and density * 60 / math.sqrt(2) == pytest.approx(walk, rel=0.07)


@pytest.mark.parametrize("name", one_of_each_kind())
def test_the_sensor_of_a_part_gives_finite_noisy_output_within_its_range(name):
    p, n = part(name), 100
    block = p.block
    start = np.array([v.start for v in block.inputs])
    w = normals(1, [c.number for c in block.noise], 1, n)
    y, _ = block.run(np.tile(start, (n, 1)), w=w)
    assert y.shape == (n, 7) and np.isfinite(y).all()
    for kind, columns in (("gyro", slice(0, 3)), ("accel", slice(3, 6))):
        noisy = bool(p.sensor(kind).values)
        assert (np.ptp(y[:, columns], axis=0) > 0).all() == noisy
        limit = p.sensor(kind).values.get("saturation", {}).get("limit", np.full(3, np.inf))
        step = p.sensor(kind).values.get("quantization", {}).get("q", np.zeros(3))
        assert (np.abs(y[:, columns]) <= limit + step / 2).all()


def run(monkeypatch, capsys, *words):
    monkeypatch.setattr(sys, "argv", ["pyimu", *words])
    with pytest.raises(SystemExit) as end:
        main()
    return (end.value.code, *capsys.readouterr())


def test_pyimu_parts_lists_every_part_on_a_line_of_its_own(monkeypatch, capsys):
    code, out, err = run(monkeypatch, capsys, "parts")
    assert (code, err) == (0, "")
    *lines, blank, last = out.splitlines()
    assert (blank, last) == ("", SIDES)
    assert [line.split()[0] for line in lines[3:]] == sorted(part_names())
    by_name = {line.split()[0]: line for line in lines[3:]}
    assert all(part(name).description in line for name, line in by_name.items())
    assert out.isascii()


@pytest.mark.parametrize("width", [20, 60, 80, 120, 200])
def test_a_narrow_terminal_folds_descriptions_and_cuts_no_figure(width):
    whole, folded = listing().splitlines()[3:-2], listing(width=width)
    for line in whole:
        head = " ".join(line.split()[: 2 + len(COLUMNS)])
        assert any(" ".join(row.split()).startswith(head) for row in folded.splitlines())
    assert "…" not in folded


def test_the_listing_shows_units_people_use_and_a_dash_for_what_is_missing():
    row = next(
        line for line in listing([part("mpu9250")]).splitlines() if line.startswith("mpu9250")
    ).split()
    assert row[1:8] == ["1000", "0.424", ABSENT, "250", "212", ABSENT, "2.00"]


@pytest.mark.parametrize("name", part_names())
def test_pyimu_parts_name_prints_every_figure_with_its_source(monkeypatch, capsys, name):
    code, out, err = run(monkeypatch, capsys, "parts", name)
    assert (code, err) == (0, "") and out.startswith(f"{name}: {part(name).description}\n")
    for key, note in part(name).notes.items():
        row = next(line for line in out.splitlines() if line.startswith(".".join(key).lstrip(".")))
        assert note["source"] in row and note.get("quoted", "") in row
    tolerances = out.partition("\ntolerance ")[2]
    assert bool(tolerances) == bool(part(name).tolerances)
    for t in part(name).tolerances:
        row = next(
            line for line in tolerances.splitlines() if line.startswith(f"{'.'.join(t.key)} ")
        )
        assert t.size(4) in row and t.quoted in row and t.source in row


def test_a_part_of_one_s_own_is_printed_too(tmp_path):
    file = tmp_path / "own.toml"
    file.write_text(
        'name = "own"\nsample_rate = {value = 50.0, unit = "Hz"}\n[gyro]\ng_sensitivity = '
        '"estimate"\n'
        'scale_factor.s = [0.01, 0.0, 0.02]\nthermal_bias = {kT = {value = 1, unit = "deg/s/K"}, '
        'T0 = {value = 20, unit = "degC"}}\n'
        'misalignment.m = {value = [[0, 1, 2], [3, 0, 4], [5, 6, 0]], unit = "mrad"}\n'
    )
    text = detail(str(file))
    assert "gyro.scale_factor.s" in text and re.search(
        r"misalignment\.m +\[0 \S+ \S+; \S+ 0 \S+; \S+ \S+ 0\] deg", text
    )
    assert SIDES not in text  # it has no N
    assert SIDES == detail("bmi270").splitlines()[-1]
    assert re.search(r"T0 +20\.00 degC", text) and text.startswith("own\n")


def test_remarks_have_nothing_that_a_terminal_obeys(tmp_path):
    """TOML allows the second set of control characters in a comment: U+009B begins a command."""
    file = tmp_path / "own.toml"
    head = 'name = "own"\nsample_rate = {value = 50.0, unit = "Hz"}\n'
    file.write_text("# a\u009b2Jb\n\n" + head, encoding="utf-8")
    assert as_data(str(file))["remarks"] == "a?2Jb"


def test_an_unknown_name_is_one_line_and_exit_status_2(monkeypatch, capsys):
    code, out, err = run(monkeypatch, capsys, "parts", "mpu6051")
    assert (code, out) == (2, "") and err.count("\n") == 1 and "did you mean mpu6050" in err


def test_the_help_opens_with_an_example(monkeypatch, capsys):
    _, out, _ = run(monkeypatch, capsys, "parts", "--help")
    assert "Example: pyimu parts mpu6050" in out


@pytest.mark.parametrize("name", ["adis16500", "vn100"])
def test_what_was_not_found_is_printed(name):
    """The remarks at the head of the file, word by word, and as data."""
    head = files("pyimu.model").joinpath("parts", f"{name}.toml").read_text().split("\n\n")[0]
    words = head.replace("#", "").split()
    assert "Not found:" in " ".join(words)
    assert " ".join(words) in " ".join(detail(name, width=80).split())
    assert as_data(name)["remarks"] == " ".join(words)
    assert as_data(part(name))["remarks"] == ""
