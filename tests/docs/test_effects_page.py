"""The page on the catalogue says what the definitions say, and the checked-in copy is fresh."""

import difflib
import subprocess
import sys

import pytest
from effects_page import COLUMNS, documentation, write
from places import CHECKOUT

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.signals import EVERY_SAMPLE
from pyimu.model.typical import magnitudes

PAGE = CHECKOUT / "docs" / "effects.md"


def test_the_page_is_fresh():
    change = "\n".join(
        difflib.unified_diff(
            PAGE.read_text(encoding="utf-8").splitlines(),
            documentation().splitlines(),
            "docs/effects.md",
            "documentation()",
            lineterm="",
        )
    )
    assert not change, (
        "docs/effects.md is not what the definitions say; update it with `make "
        f"generate`:\n{change}"
    )


def test_only_a_page_that_changes_is_written(tmp_path):
    assert write(tmp_path) == [tmp_path / "effects.md"] and write(tmp_path) == []
    (tmp_path / "effects.md").write_text("edited")
    assert write(tmp_path) == [tmp_path / "effects.md"]
    assert (tmp_path / "effects.md").read_text(encoding="utf-8") == documentation()


def test_the_page_is_written_from_a_checkout_by_a_command():
    """Which says what it wrote: nothing, as the page is fresh."""
    program = CHECKOUT / "docs" / "build" / "effects_page.py"
    done = subprocess.run([sys.executable, program], capture_output=True, text=True, check=True)
    assert done.stdout == ""


@pytest.mark.parametrize("name", CATALOGUE)
def test_every_effect_has_a_row_with_all_its_parameters(name):
    row = next(line for line in documentation().splitlines() if line.startswith(f"| `{name}` |"))
    assert row.count(" | ") == len(COLUMNS) - 1
    assert all(
        f"`{p}`" in row and q.description in row for p, q in CATALOGUE[name].parameters.items()
    )


def size_rows(name):
    """The rows on how large an effect is, one for each kind of sensor."""
    return [
        line
        for line in documentation().split("## How large they are")[1].splitlines()
        if line.startswith(f"| `{name}` |")
    ]


@pytest.mark.parametrize("name", CATALOGUE)
def test_a_size_stands_with_what_it_goes_with(name):
    """A driving noise says nothing without its correlation time."""
    for row, kind in zip(size_rows(name), CATALOGUE[name].sensors, strict=True):
        for m in magnitudes(name, kind).values():
            assert all(
                f" {n} = {value:g} {unit} (" in row for n, (value, unit) in m.beside.items()
            ), row
            assert (" with " in row.partition(" (")[0]) == bool(m.beside)


COMPENSATED = {
    "scale_factor": "yes",
    "angle_random_walk": "yes, with its noise zero",
    "saturation": "no, marked",
    "dead_zone": "no, marked",
    "hard_dead_zone": "no, marked",
    "bias_asymmetry": "no, marked",
    "first_order_lag": "yes",
    "clock_skew": "no, left in",
    "lag": "no, left in",
    "time_delay": "no, left in",
    "quantization": "no, left in",
    "angle_quantization": "no, left in",
}


@pytest.mark.parametrize("name", COMPENSATED)
def test_the_page_says_what_compensation_makes_of_an_effect(name):
    row = next(line for line in documentation().splitlines() if line.startswith(f"| `{name}` |"))
    assert row.split(" | ")[COLUMNS.index("invertible")] == COMPENSATED[name]


@pytest.mark.parametrize("name", CATALOGUE)
def test_the_page_says_what_wants_new_inputs_at_every_sample(name):
    row = next(line for line in documentation().splitlines() if line.startswith(f"| `{name}` |"))
    assert (EVERY_SAMPLE in row) == CATALOGUE[name].differences
