"""Pages explain the words that they use, and no others; pictures and programs are no words."""

import re
from pathlib import Path

import pytest
from markupsafe import Markup

import pyimu.report
from pyimu.report.glossary import WORDS, words_on

USED = {
    "residual": "The residual falls.",
    "gate": "above the gate",
    "N, angle or velocity random walk": "angle_random_walk N",
    "NIS, normalised innovation squared": "mean NIS 0.9",
    "quasi-static": "100 % quasi-static",
    "smoothed": "by the smoother",
    "specimen": "a specimen each",
    "at rest": "moves; 2 rests of 6.18 s together",
    "column map": "<h2>Column map</h2>",
    "zero-velocity update": "zero velocities hold it",
}


@pytest.mark.parametrize(("word", "text"), USED.items())
def test_a_word_that_is_used_is_explained(word, text):
    assert word in dict(words_on(f"<p>{text}</p>"))


def test_what_is_not_used_is_not_explained():
    assert words_on("<p>All is well.</p>") == []


def test_pictures_and_programs_use_no_words():
    body = "<svg><text>residual</text></svg><script>gate()</script><a title='NIS'>all well</a>"
    assert words_on(body) == []


def test_explained_is_a_word_beside_a_gate_alone():
    assert not words_on("<p>explained above</p>")
    assert {"gate", "explained"} <= {w for w, _ in words_on("<p>explained; gate 5</p>")}


def test_each_word_is_defined_once_in_sentences():
    names = [w.name for w in WORDS]
    assert len(set(names)) == len(names)
    for word in WORDS:
        assert word.meaning.endswith("."), word
        assert re.fullmatch(r"[^<>]*(<sup>\d+</sup>[^<>]*)*", Markup(word.meaning)), word


def test_no_page_has_a_list_of_words_of_its_own():
    """They stand in one place, from which every page takes those that it uses."""
    package = Path(pyimu.report.__file__).parents[1]
    pages = [p for p in package.rglob("*.html") if "extends" in p.read_text(encoding="utf-8")]
    assert len(pages) > 5
    for page in pages:
        assert "<dt>" not in page.read_text(encoding="utf-8"), page
