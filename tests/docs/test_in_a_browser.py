"""Pages in a real browser, where there is one: no wider than a phone, and without an error."""

from importlib.resources import files

import browser
import docs_site
import numpy as np
import pytest
import raw_logs
from screenshots import OVERHANG, shots

from pyimu.report.numbers import MISSING
from pyimu.report.page import Table, equation, prose, templates

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(browser.program() is None, reason="needs chromium or google-chrome on PATH"),
]


@pytest.fixture(scope="module")
def opened():
    with browser.Browser(browser.program()) as found:
        yield found


@pytest.fixture
def log(tmp_path, monkeypatch):
    """A still log with the name of a column that no page can break."""
    monkeypatch.chdir(tmp_path)
    time, gyro, accel = raw_logs.still(3000)
    names = [f"gyro_{a} [rad/s]" for a in "xyz"] + [f"accel_{a} [m/s^2]" for a in "xyz"]
    columns = [time, *gyro.T, *accel.T, np.zeros(3000)]
    head = ",".join(["time [ns]", *names, f"{'board_' * 12}supply [V]"])
    raw_logs.text(tmp_path / "log.csv", [head], columns)
    return "log.csv"


def on_a_phone(opened, page):
    """Pixels by which a page is too wide, and what its console was told."""
    opened.open(browser.address(page), browser.PHONE)
    return max(0, opened.value(OVERHANG)), opened.errors


@pytest.mark.parametrize("command", ["inspect", "characterize"])
def test_a_report_is_no_wider_than_a_phone(pyimu, opened, log, tmp_path, command):
    """Also with its pictures opened to zoom into."""
    assert pyimu(command, log, "--out", "out")[0] == 0
    assert on_a_phone(opened, tmp_path / "out" / "report.html") == (0, [])
    open_all = "const all = document.querySelectorAll('.tools button');"
    count = opened.value(f"{open_all} all.forEach(b => b.click()); all.length")
    assert count >= 1 and opened.value("document.querySelectorAll('.uplot').length") >= count
    assert (opened.value(OVERHANG), opened.errors) == (0, [])


NARROW = browser.View(360, 800)
"""A phone of small size."""

WORDS = '<span class="words">{}</span>'

TABLES = {
    "which noise it is": [
        ["gyro_<wbr>x", "N + B + G + H of 21.8 min and 0.0800 s", "-10", "its own scatter"],
        ["", "N + B (taken)", "0", "its own scatter"],
    ],
    "coefficients": [["<b>angle</b> random walk", *["2.2863 (2.2731 to 2.2996)"] * 3]],
}


@pytest.mark.parametrize("table", TABLES)
def test_tables_and_equations_fit_a_small_phone(opened, tmp_path, table):
    css = (files("pyimu.report") / "templates" / "page.css").read_text()
    cells = [[WORDS.format(row[0]), WORDS.format(row[1]), *row[2:]] for row in TABLES[table]]
    rows = "".join("<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in cells)
    long = equation("y = " + "+".join([r"\frac{11 - 18 z^{-1}}{6 h}"] * 9))
    (tmp_path / "page.html").write_text(
        f"<meta name=viewport content='width=device-width'><style>{css}</style>"
        f"<p class=equation>{long}</p><div class=scroll><table>{rows}</table></div>"
    )
    opened.open(browser.address(tmp_path / "page.html"), NARROW)
    assert opened.value(OVERHANG) == 0
    over = "(e => e.scrollWidth - e.clientWidth)(document.querySelector('.scroll'))"
    assert opened.value(over) <= 0


@pytest.mark.parametrize("columns", [5, 6, 9])
def test_no_table_of_a_page_needs_to_be_pushed_aside(opened, tmp_path, columns):
    """One of many columns stands row by row, each cell behind the head of its column."""
    css = (files("pyimu.report") / "templates" / "page.css").read_text()
    row = [prose("what became of it"), "0.0208 deg/s", MISSING]
    shown = Table(tuple(f"head {k}" for k in range(columns)), [(row * 3)[:columns]] * 2)
    macro = templates("pyimu.inspection").from_string(
        '{% from "parts.html" import table %}{{ table(shown) }}'
    )
    (tmp_path / "page.html").write_text(
        f"<meta name=viewport content='width=device-width'><style>{css}</style>"
        + macro.render(shown=shown)
    )
    opened.open(browser.address(tmp_path / "page.html"), NARROW)
    over = "(e => e.scrollWidth - e.clientWidth)(document.querySelector('.scroll'))"
    assert opened.value(over) <= 0
    first = "getComputedStyle(document.querySelector('td'), '::before').content"
    assert opened.value(first) == ('"head 0"' if columns > 5 else "none")


def test_a_page_of_the_site_is_no_wider_than_a_phone(opened, tmp_path):
    """That with the widest table, and that with the longest equations."""
    pytest.importorskip("material", reason="the site needs pip install -e '.[docs]'")
    docs_site.build(tmp_path)
    for name in ("effects", "noise"):
        assert on_a_phone(opened, tmp_path / "site" / f"{name}.html") == (0, [])


def test_what_is_wrong_with_a_page_is_said(opened, tmp_path):
    page = tmp_path / "wrong.html"
    page.write_text(
        "<meta name=viewport content='width=device-width'><body style='margin: 0'>"
        "<div style='width: 500px'>wide</div>"
        "<script>console.error('said'); nothing()</script>"
    )
    wrong = shots(opened, page, tmp_path / "shot")
    assert "phone: 110 pixels too wide" in wrong and "said" in wrong
    assert any("nothing is not defined" in text for text in wrong)
    made = {p.name: p.read_bytes()[:4] for p in tmp_path.glob("shot.*")}
    assert made.pop("shot.print.pdf") == b"%PDF"
    assert set(made) == {f"shot.{n}.png" for n in ("desktop", "dark", "phone")}
    assert set(made.values()) == {b"\x89PNG"}
