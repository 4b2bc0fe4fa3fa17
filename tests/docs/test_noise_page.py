"""The page of noises is what the definitions give, leaves no noise out, and its pictures are
there.
"""

import shutil
import subprocess
import sys
from difflib import unified_diff

import noise_pictures
import numpy as np
import pytest
from matplotlib.figure import Figure
from noise_page import ENTRIES, SAMPLE_PERIOD, documentation
from places import CHECKOUT
from scipy.stats import chi2, kstest

from pyimu.model.catalogue import CATALOGUE
from pyimu.shaping import NOISE_LIKE

DOCS = CHECKOUT / "docs"
NAMES = [e.effect for e in ENTRIES]


def test_every_noise_of_the_catalogue_is_on_the_page():
    assert sorted(NAMES) == sorted(
        [*NOISE_LIKE, *(e.name for e in CATALOGUE.values() if e.stochastic and "gyro" in e.sensors)]
    )


def test_checked_in_page_is_fresh():
    have, want = (DOCS / "noise.md").read_text(encoding="utf-8"), documentation()
    lines = list(
        unified_diff(
            have.splitlines(), want.splitlines(), "checked in", "generated", n=0, lineterm=""
        )
    )
    assert not lines, "docs/noise.md is not what the definitions give: make generate\n" + "\n".join(
        lines[:20]
    )


def test_the_example_runs_as_it_stands():
    code = documentation().partition("```python\n")[2].partition("```")[0]
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)


def test_one_letter_has_one_meaning():
    """In the section of correlated noise the cluster time and the correlation time stand beside
    each other.
    """
    section = documentation().partition("`gauss_markov`")[2]
    equation = next(line for line in section.splitlines() if line.startswith("| equation"))
    assert "tau_c" in equation and "tau " not in equation.replace("tau_c", "")


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_is_linked_and_there(name):
    picture = DOCS / "noise" / f"{name}.png"
    assert f"](noise/{name}.png)" in documentation()
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size < 100_000


@pytest.mark.parametrize("entry", ENTRIES, ids=NAMES)
def test_a_picture_shows_what_the_definitions_give(entry):
    picture = DOCS / "noise" / f"{entry.effect}.png"
    assert noise_pictures.is_fresh(entry, picture), f"{picture.name} is old: make generate"


def shown(**changes):
    """The digest of a small picture, and of it changed."""
    points = {"x": [1.0, 2.0], "y": [3.0, 4.0], "label": "points", "color": "black"} | changes
    figure = Figure()
    panel = figure.subplots()
    panel.plot(points["x"], points["y"], label=points["label"], color=points["color"])
    panel.fill_between([0.0, 1.0], points.get("low", 0.5), 2.0)
    panel.set(xlabel=points.get("unit", "s"))
    return noise_pictures.digest(figure)


@pytest.mark.parametrize(
    "change",
    [{"y": [3.0, 4.001]}, {"label": "dots"}, {"color": "blue"}, {"low": 0.6}, {"unit": "ms"}],
    ids=str,
)
def test_a_picture_is_drawn_anew_where_a_number_a_text_or_its_style_changes(change):
    assert shown(**change) != shown()


def test_a_picture_stays_where_a_number_differs_by_the_rounding_of_another_machine():
    assert shown(y=[3.0 + 1e-13, 4.0]) == shown()


def test_only_old_pictures_are_drawn(tmp_path, monkeypatch):
    """The FMU is not even built where there are none."""
    shutil.copytree(DOCS / "noise", tmp_path / "noise")
    monkeypatch.setattr(noise_pictures, "ENTRIES", ENTRIES[2:3])
    monkeypatch.setattr(noise_pictures, "build_fmu", lambda *_: pytest.fail("built an FMU"))
    assert noise_pictures.draw(tmp_path / "noise") == []
    (tmp_path / "noise" / f"{NAMES[2]}.png").unlink()
    monkeypatch.setattr(noise_pictures, "build_fmu", lambda *_: None)
    monkeypatch.setattr(noise_pictures, "_by_fmu", lambda _: noise_pictures.in_python)
    assert noise_pictures.draw(tmp_path / "noise") == [tmp_path / "noise" / f"{NAMES[2]}.png"]
    assert noise_pictures.draw(tmp_path / "noise") == []


def test_no_picture_is_left_over():
    assert sorted(p.stem for p in (DOCS / "noise").iterdir()) == sorted(NAMES)


def test_formulae_survive_the_table():
    """A bar would end a cell; dollars come in pairs."""
    rows = [line for line in documentation().splitlines() if line.startswith("| ")]
    assert len(rows) == 9 * len(ENTRIES)
    for row in rows:
        assert row.count("|") == 3 and row.count("$") % 2 == 0


def test_the_drawn_density_has_the_degrees_of_freedom_that_its_band_takes():
    """White noise: each third of an octave is S chi2(nu) / nu, uniform over records by that law
    (Kolmogorov's test).
    """
    rng, records, n = np.random.default_rng(3), 500, 2**10
    drawn = [
        noise_pictures.spectrum(rng.standard_normal(n), lambda f: np.full_like(f, SAMPLE_PERIOD))
        for _ in range(records)
    ]
    freedom = drawn[0][2]
    p = np.array([chi2.cdf(ratio * freedom, freedom) for _, ratio, _ in drawn])
    assert min(kstest(p[:, k], "uniform").pvalue for k in range(p.shape[1])) > 1e-3 / p.shape[1]
