"""The page on the catalogue says what the definitions say, and the checked-in copy is fresh."""

import difflib
from pathlib import Path

import pytest

from pyimu.catalogue import COLUMNS, documentation
from pyimu.effect import CATALOGUE

PAGE = Path(__file__).parents[1] / "docs" / "effects.md"


def test_the_page_is_fresh():
    change = "\n".join(difflib.unified_diff(PAGE.read_text(encoding="utf-8").splitlines(), documentation().splitlines(),
                                            "docs/effects.md", "documentation()", lineterm=""))
    assert not change, f"docs/effects.md is not what the definitions say; update it with `make generate`:\n{change}"


@pytest.mark.parametrize("name", CATALOGUE)
def test_every_effect_has_a_row_with_all_its_parameters(name):
    row = next(line for line in documentation().splitlines() if line.startswith(f"| `{name}` |"))
    assert row.count(" | ") == len(COLUMNS) - 1
    assert all(f"`{p}`" in row and q.description in row for p, q in CATALOGUE[name].parameters.items())
