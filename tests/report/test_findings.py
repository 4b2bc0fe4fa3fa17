"""What is said of the findings of a log."""

import ast

from places import CHECKOUT

from pyimu.errors import Finding
from pyimu.ins.measured import CONTRADICTED
from pyimu.report.findings import grouped, in_line
from pyimu.report.meaning import MEANING
from pyimu.report.page import command, quality_table


def in_the_package() -> tuple[set[str], set[str]]:
    """Kinds of the findings that the package makes by name, and all of its strings."""
    kinds, strings = set(), set()
    for path in (CHECKOUT / "pyimu").rglob("*.py"):
        if path.name == "meaning.py":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                strings.add(node.value)
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Finding":
                kinds |= {a.value for a in node.args[:1] if isinstance(a, ast.Constant)}
    return kinds, strings


def test_every_kind_of_finding_says_what_it_means():
    kinds, strings = in_the_package()
    made = {f"{name}_fixes" for name in CONTRADICTED}
    assert len(kinds) > 50 and kinds <= set(MEANING)
    assert set(MEANING) <= strings | made  # none is told of that nothing finds


def test_findings_of_several_axes_are_one_with_its_numbers_and_its_meaning():
    found = [Finding("clipping", f"gyro_{a}", 3, {"level": 5.0}) for a in "xz"]
    (said,) = grouped(found)
    assert said.line == "clipping of gyro x, z: 3 (level 286 deg/s)"
    assert said.meaning == MEANING["clipping"]


def test_a_table_of_several_logs_says_which_log():
    found = [Finding("gaps", "time", 2, {"longest": 1.0, "total": 1.5})]
    one, two = quality_table(("a", found)), quality_table(("a", found), ("b", found))
    assert "a: " not in one.rows[0][1] and [r[1][:100].count("b: ") for r in two.rows] == [0, 1]
    assert all(MEANING["gaps"] in row[3] for row in (*one.rows, *two.rows))


def test_the_page_on_logs_tells_of_all_of_them():
    page = (CHECKOUT / "docs" / "logs.md").read_text(encoding="utf-8")
    rows = [line for line in page.splitlines() if line.startswith("| `")]
    assert [f"| `{kind}` | {text} |" for kind, text in MEANING.items()] == rows[-len(MEANING) :]


def test_columns_without_a_meaning_are_one_line_that_names_them():
    """Of each log its own; one alone is told of with its header."""
    told = [
        Finding("unused_column", f"cov{k}", 1, {"recording": name, "header": f"cov{k} []"})
        for name, columns in (("a", 12), ("b", 1))
        for k in range(columns)
    ]
    lines = list(in_line([told[0], Finding("gaps", "time", 2), *told[1:]]))
    first = ", ".join(f"cov{k}" for k in range(8))
    assert lines == [
        f"columns left out: 12 (recording a, columns {first} and 4 more)",
        "gaps: 2",
        "unused column of cov0: 1 (recording b, header cov0 [])",
    ]


def test_an_option_of_a_command_does_not_break_behind_its_hyphen():
    said = command('pyimu close "a--b.csv" --holdout <x> --reference-columns m.toml')
    assert '<span class="option">--holdout</span> &lt;x&gt;' in said
    assert said.count("<span") == 2 and "--reference-columns</span>" in said
