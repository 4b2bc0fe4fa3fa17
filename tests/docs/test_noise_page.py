"""The page of noises is what the definitions give, complete and with its pictures."""

import shutil
import subprocess
import sys
from dataclasses import replace
from difflib import unified_diff

import casadi as ca
import noise_page
import noise_pictures
import numpy as np
import pytest
from matplotlib.figure import Figure
from noise_page import SAMPLE_PERIOD, Entry, documentation, entries
from places import CHECKOUT
from scipy.stats import chi2, kstest

from pyimu.model.catalogue import CATALOGUE, add_effects
from pyimu.model.effect import Law, Noise, Parameter, SamplePeriod, effect
from pyimu.model.typical import Magnitude, magnitudes
from pyimu.shaping import NOISE_LIKE

DOCS = CHECKOUT / "docs"
ENTRIES = entries()
NAMES = [e.name for e in ENTRIES]
SOME_LONG = [
    pytest.param(e, marks=[pytest.mark.long] * (k % 3 > 0), id=e.name)
    for k, e in enumerate(ENTRIES)
]


def test_every_noise_of_the_catalogue_is_on_the_page():
    stochastic = [e.name for e in CATALOGUE.values() if e.stochastic]
    assert not set(stochastic) - set(NAMES), "noises without a law: give their definitions one"
    assert sorted(NAMES) == sorted([*NOISE_LIKE, *stochastic])


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


def test_the_example_gives_the_deviation_that_it_speaks_of():
    """Run as it stands: on the octaves behind its corner a flicker's deviation is level, at
    B sqrt(2 ln 2 / pi) (IEEE Std 952, annex C); its parallel filters are within a tenth of it.
    """
    code = documentation().partition("```python\n")[2].partition("```")[0]
    code += "\nprint(*model.allan_deviation(tau), part.gyro.values['bias_instability']['B'][0])"
    run = [sys.executable, "-W", "error", "-c", code]
    said = subprocess.run(run, check=True, capture_output=True, text=True).stdout
    *deviations, size = map(float, said.split())
    assert len(deviations) == 20
    assert np.max(deviations) == pytest.approx(size * np.sqrt(2 * np.log(2) / np.pi), rel=0.1)


def test_one_letter_has_one_meaning():
    """The cluster time and the correlation time of correlated noise stand side by side."""
    section = documentation().partition("`gauss_markov`")[2]
    equation = next(line for line in section.splitlines() if line.startswith("| equation"))
    assert "tau_c" in equation and "tau " not in equation.replace("tau_c", "")


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_is_linked_and_there(name):
    picture = DOCS / "noise" / f"{name}.png"
    assert f"](noise/{name}.png)" in documentation()
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size < 100_000


@pytest.mark.parametrize("entry", SOME_LONG)
def test_a_picture_shows_what_the_definitions_give(entry):
    picture = DOCS / "noise" / f"{entry.name}.png"
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
    chosen = ENTRIES[2:3]
    monkeypatch.setattr(noise_pictures, "build_fmu", lambda *_: pytest.fail("built an FMU"))
    assert noise_pictures.draw(tmp_path / "noise", chosen) == []
    (tmp_path / "noise" / f"{NAMES[2]}.png").unlink()
    monkeypatch.setattr(noise_pictures, "build_fmu", lambda *_: None)
    monkeypatch.setattr(noise_pictures, "_by_fmu", lambda _: noise_pictures.in_python)
    picture = tmp_path / "noise" / f"{NAMES[2]}.png"
    assert noise_pictures.draw(tmp_path / "noise", chosen) == [picture]
    assert noise_pictures.draw(tmp_path / "noise", chosen) == []


def test_no_picture_is_left_over():
    assert sorted(p.stem for p in (DOCS / "noise").iterdir()) == sorted(NAMES)


def test_formulae_survive_the_table():
    """A bar would end a cell; dollars come in pairs."""
    rows = [line for line in documentation().splitlines() if line.startswith("| ")]
    assert len(rows) == 9 * len(ENTRIES)
    for row in rows:
        assert row.count("|") == 3 and row.count("$") % 2 == 0


def test_the_drawn_density_has_the_degrees_of_freedom_that_its_band_takes():
    """White noise: each third of an octave is S chi2(nu) / nu over records (Kolmogorov's test)."""
    rng, records, n = np.random.default_rng(3), 500, 2**10
    drawn = [
        noise_pictures.spectrum(rng.standard_normal(n), lambda f: np.full_like(f, SAMPLE_PERIOD))
        for _ in range(records)
    ]
    freedom = drawn[0][2]
    p = np.array([chi2.cdf(ratio * freedom, freedom) for _, ratio, _ in drawn])
    assert min(kstest(p[:, k], "uniform").pvalue for k in range(p.shape[1])) > 1e-3 / p.shape[1]


# A noise of one's own


@pytest.fixture
def added(monkeypatch):
    """``added(effect, **figure)``: the entry of a noise that is in the catalogue for one test."""
    names = []

    def add(noise, **figure: float) -> Entry:
        ((parameter, value),) = figure.items()
        typical = Magnitude(parameter, value, noise.parameters[parameter].unit, "made up")
        sizes = {(noise.name, noise.sensors[0]): {"tactical": typical}}
        monkeypatch.setattr(
            noise_page, "magnitudes", lambda *which: sizes.get(which) or magnitudes(*which)
        )
        add_effects(noise)
        names.append(noise.name)
        return entries()[-1]

    yield add
    CATALOGUE.remove(*names)


def rattle(**formulas: str):
    """White noise of accelerometers that grows with the input."""

    @effect(
        stage="noise",
        term="rattle",
        equation=r"y = x + k (|x| + s) w / \sqrt{h}",
        source="made up",
        sensors=("accel",),
        law=Law(
            white=lambda k, s, x: (k * (ca.fabs(x) + s)) ** 2,
            shown={"s": 2.0},
            **formulas,
        ),
    )
    def rattle(
        x,
        k: Parameter("sqrt(s)", minimum=0.0, description="made up"),
        s: Parameter("{y}", (), form=True, minimum=0.0, description="made up"),
        w: Noise(),
        h: SamplePeriod(),
    ):
        return x + k * (ca.fabs(x) + s) * w / ca.sqrt(h)

    return rattle


FORMULAS = {"transfer": "H_r", "psd": "S_r", "allan": r"\sigma_r", "note": "It rattles."}


def test_a_new_noise_has_its_section_by_its_definition_alone(added):
    entry = added(rattle(**FORMULAS), k=1e-4)
    assert (entry.name, entry.kind) == ("rattle", "accel") and entries()[:-1] == ENTRIES
    section = documentation("pictures").partition("\n## Rattle: `rattle`")[2]
    for text in ("$H_r$", "$S_r$", r"$\sigma_r$", "\nIt rattles.\n", "](pictures/rattle.png)"):
        assert text in section
    assert (
        "| k = 0.0001 sqrt(s); s = 2 m/s^2; at 2 g; standard deviation 0.02161 m/s^2 |" in section
    )


def test_a_new_noise_has_its_picture_by_its_definition_alone(added, monkeypatch):
    """All points are inside the bands but in 1 % of seeds; this one is fixed."""
    entry = added(rattle(**FORMULAS), k=1e-4)
    monkeypatch.setattr(noise_pictures, "SAMPLES", 2**12)
    figure = noise_pictures.picture(entry, noise_pictures.in_python)
    assert figure.get_suptitle() == "rattle"
    for panel, label in zip(figure.axes, ("(ug)²/Hz", "ug"), strict=True):
        assert label in panel.get_ylabel()
        x, y = panel.lines[-1].get_xydata().T
        (band,), n = panel.collections[0].get_paths(), len(x)
        low, high = band.vertices[1 : n + 1], band.vertices[n + 2 : 2 * n + 2][::-1]
        np.testing.assert_array_equal((low[:, 0], high[:, 0]), (x, x))
        assert np.all((low[:, 1] <= y) & (y <= high[:, 1]))


def test_a_law_without_a_formula_is_named_in_one_line(added):
    added(rattle(transfer="H_r", psd="S_r"), k=1e-4)
    with pytest.raises(ValueError, match="^effect rattle: its law lacks allan=, a formula for"):
        documentation()


@pytest.mark.parametrize(
    "parts, want",
    [
        ({"white": lambda k: k**2, "walk": lambda k: k**2}, {"continuous theory": (16 / 3) ** 0.5}),
        ({"markov": lambda k, s: [(k**2 * s / 2, s)]}, {"continuous theory": 2.0}),
        ({"markov": lambda k: [(k**2, 1.0)], "floor": lambda k: 3 * k}, {"floor": 6.0}),
        ({"white": lambda k, h: k**2 * h}, {}),
        ({"rounding": lambda k: k}, {}),
        ({"ramp": lambda k: k}, {}),
    ],
)
def test_the_reference_of_a_picture_follows_from_the_law(added, parts, want):
    """After 3 s at k = 2: k^2 / 3 s and k^2 3 s / 3; the latter far below a correlation time."""
    entry = added(replace(rattle(), law=Law(shown={"s": 1e6}, **parts)), k=2.0)
    found = dict(noise_pictures._references(entry, np.array([3.0])))
    assert found == {name: pytest.approx([value], rel=1e-5) for name, value in want.items()}
