"""The documentation as a site builds without a warning, and no link in it leads nowhere.

The page of the package's names is fresh, and the first log's transcript is what is printed today.
"""

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import api_page
import docs_site
import pytest
from places import CHECKOUT, measured

import pyimu

FIRST = CHECKOUT / "docs" / "first_log.md"
DIGITS = re.compile(r"\d+(?:\.\d+)?")


class Places(HTMLParser):
    """What a page links to and loads, and the anchors that it has."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.loaded: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.anchors |= {found[k] for k in ("id", "name") if found.get(k)}
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        if tag in ("script", "link", "img", "iframe"):
            self.loaded += [v for k in ("src", "href") if (v := found.get(k))]


@pytest.fixture(scope="module")
def pages(tmp_path_factory) -> dict[Path, Places]:
    pytest.importorskip("material", reason="the site needs pip install -e '.[docs]'")
    out = tmp_path_factory.mktemp("site")
    docs_site.build(out)
    return {p: Places(p.read_text(encoding="utf-8")) for p in (out / "site").rglob("*.html")}


def test_no_link_of_the_site_leads_nowhere(pages):
    assert len(pages) > 25
    for page, found in pages.items():
        if page.name == "404.html":  # its links begin at the root of the server
            continue
        for link in found.links:
            if re.match(r"\w+:", link):
                continue
            path, _, anchor = unquote(link).partition("#")
            target = (page.parent / path).resolve() if path else page
            assert target.exists(), (page.name, link)
            known = pages[target].anchors if target in pages else {anchor}
            assert not anchor or anchor in known or anchor == "__codelineno", (page.name, link)


def test_a_page_of_the_site_loads_nothing_from_elsewhere(pages):
    for page, found in pages.items():
        assert not [v for v in found.loaded if re.match(r"(\w+:)?//", v)], page.name


def test_equations_are_mathml_in_the_site(pages):
    """Also in tables; a dollar is left in code only."""
    noise = next(p for p in pages if p.name == "noise.html").read_text(encoding="utf-8")
    assert noise.count("<math") > 40
    prose = re.sub(r"<(code|script).*?</\1>", "", noise, flags=re.DOTALL)
    assert "$" not in prose and r"\frac" not in prose


def test_a_notebook_is_a_page_with_its_code():
    for notebook in (CHECKOUT / "docs").rglob("*.ipynb"):
        text = docs_site.as_page(notebook)
        assert text.startswith("# ") and "```python\n" in text


def test_the_page_of_names_is_fresh_and_has_every_one():
    text = (CHECKOUT / "docs" / "api.md").read_text(encoding="utf-8")
    assert text == api_page.text(), "make generate"
    assert {n for n in pyimu.__all__ if not n.startswith("_")} == set(
        re.findall(r"^### `pyimu\.(\w+)`", text, re.MULTILINE)
    )


@pytest.mark.long
def test_the_transcript_of_the_first_log_is_what_is_printed():
    """Word for word, but the numbers: these may differ by rounding."""
    log = measured("raw/repoimu_tstick_test07_trial1_raw")
    printed = pyimu.close(log).report().splitlines()
    printed = {DIGITS.sub("#", " ".join(line.split())) for line in printed}
    block = FIRST.read_text(encoding="utf-8").split("$ pyimu close")[1].split("```")[0]
    for line in block.splitlines()[1:]:
        if line.strip() == "..." or line.startswith(("report:", "  the reference of")):
            continue
        begin, left_out, _ = DIGITS.sub("#", " ".join(line.split())).partition("(...)")
        assert any(p.startswith(begin) if left_out else p == begin for p in printed), line
