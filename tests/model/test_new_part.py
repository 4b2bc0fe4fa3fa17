"""``pyimu parts --new``: a part to fill in, in which each figure of a data sheet has its place."""

import re
import sys

import pytest

from pyimu.cli import main
from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part_file import new_part, part, part_names, remarks
from pyimu.model.part_reader import parse_part
from pyimu.model.sheet_names import SHEET_NAMES


def filled(text):
    """The template with every example in it: '#' taken from the lines without a blank behind it."""
    return re.sub(r"^#(?=[^ \n])", "", text, flags=re.MULTILINE)


@pytest.fixture
def written(tmp_path):
    return new_part("mine", tmp_path)


def test_the_template_is_a_part_that_says_nothing_yet(written):
    made = part(written)
    assert made.name == "mine" and written.name == "mine.toml"
    assert not made.gyro.values and not made.accel.values and not made.tolerances


def test_the_filled_template_is_a_part_with_specimens(written):
    made = parse_part(filled(written.read_text(encoding="utf-8")))
    assert made.specimen(1).gyro.values["turn_on_bias"]["b0"].any()
    assert not re.search(r"^#\w+ =", filled(written.read_text(encoding="utf-8")), re.MULTILINE)


def test_every_figure_of_the_built_in_parts_has_a_place_in_it(written):
    """The effects of all data sheets here; those of one sensor alone are shown for the other."""
    made = parse_part(filled(written.read_text(encoding="utf-8")))
    fixed = {(kind, e) for kind in ("gyro", "accel") for e in made.sensor(kind).values}
    drawn = {t.key[1] for t in made.tolerances}
    for name in set(part_names()) - {"imt30"}:
        own = part(name)
        assert {(k, e) for k in ("gyro", "accel") for e in own.sensor(k).values} <= fixed
        assert {t.key[1] for t in own.tolerances} - {"scale_factor_g_sensitivity"} <= drawn, name


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("mpu6050", "is a built-in part"),
        ("mine", "is there already"),
        ("a/b", "a part's name has letters"),
        ("", "a part's name has letters"),
    ],
)
def test_a_name_that_will_not_do_writes_nothing(written, name, says):
    before = written.read_text(encoding="utf-8")
    with pytest.raises(UserError, match=says):
        new_part(name, written.parent)
    assert [f.name for f in written.parent.iterdir()] == ["mine.toml"]
    assert written.read_text(encoding="utf-8") == before


def test_the_command_writes_it_here(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["pyimu", "parts", "--new", "own"])
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 0 and "own.toml: take the '#'" in capsys.readouterr().out
    assert part(tmp_path / "own.toml").name == "own"


def test_what_the_template_tells_its_reader_is_no_remark_on_the_part(written):
    assert remarks(written) == ""


def test_a_row_of_a_data_sheet_belongs_to_an_effect_that_there_is():
    assert set(SHEET_NAMES.values()) <= set(CATALOGUE)
    assert not set(SHEET_NAMES) & set(CATALOGUE)
