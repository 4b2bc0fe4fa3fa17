"""The report of ``close``: what it says, that it stands alone, that it is written as a whole."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
import world
from numpy.testing import assert_allclose
from report_pages import alone

from pyimu.errors import Finding, UserError
from pyimu.files import staged
from pyimu.identification import conclude
from pyimu.identification.close import close
from pyimu.identification.fit.band import Band
from pyimu.identification.fit.response import is_step
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.found.entries import Added
from pyimu.identification.found.exhibits import Trace, exhibits_of, noise_density
from pyimu.identification.found.exhibits import density as density_of
from pyimu.identification.model.as_part import as_part
from pyimu.identification.model.estimated import Estimated
from pyimu.identification.report import deliver, pictures
from pyimu.identification.report.coefficients import rows as coefficient_rows
from pyimu.identification.report.page import page as page_of
from pyimu.identification.report.words import headline
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.verdict.verdict import VERDICTS as ALL_VERDICTS
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.part_file import load_part, part, save_part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.report.findings import detail
from pyimu.report.numbers import (
    SAID,
    SHOWN,
    number,
    pretty,
    quantity,
    si_quantity,
    told_apart,
    with_error,
)
from pyimu.report.page import equation
from pyimu.units import same_dimension

FILES = ("report.html", "report.json", "model.toml")


@pytest.fixture(scope="module")
def looked_at():
    """A gyro that clips and an accelerometer with nothing to find, and how each was looked at."""
    motion, seen = world.drive(minutes=2.5, rate_hz=25), {}

    def watched(inv, *rest):
        seen[inv.after.sensor.kind] = inv
        return exhibits_of(inv, *rest)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(conclude, "exhibits_of", watched)
        closed = close(world.recording(motion, world.changes(motion, "gyro")["saturation"](0.6)))
    return closed, seen


@pytest.fixture(scope="module")
def closed(looked_at):
    return looked_at[0]


@pytest.fixture(scope="module")
def investigation(looked_at):
    return looked_at[1]["gyro"]


@pytest.fixture(scope="module")
def undecided():
    """A short log at rest without temperature: nothing could show."""
    rng = np.random.default_rng(2)
    time = np.arange(0, 120, 0.1)
    return close(
        Recording.from_arrays(
            name="rest", time=time, gyro=1e-3 * rng.standard_normal((len(time), 3))
        )
    )


@pytest.fixture(scope="module")
def folder(closed, tmp_path_factory):
    out = tmp_path_factory.mktemp("report")
    closed.write(out, units=False)
    return out


def test_page_says_what_the_json_says(closed, folder):
    said, page = (
        json.loads((folder / "report.json").read_text()),
        (folder / "report.html").read_text(),
    )
    assert said["verdict"] == "named" and f'<h1 class="{said["verdict"]}">' in page
    assert "saturation" in [a["effect"] for a in said["added"]]
    for row in said["added"] + said["observability"]:
        assert row["effect"] in page
    for stage in ("before", "after", "floor"):
        assert number(np.rad2deg(said["error"]["rate"][stage])) + " deg/s" in page
        assert number(said["error"]["specific_force"][stage] / 9.80665e-3) + " mg" in page
    named = ("ImuSensor.fmi2.fmu",)
    assert said["fmus"] == [] and closed.as_dict(fmus=named)["fmus"] == list(named)
    assert named[0] in page_of(closed, named)


def test_a_result_is_a_frame_and_a_picture(closed):
    frame = closed.to_frame().set_index("coefficient")
    for e in closed.estimated:
        row = frame.loc[f"{e.sensor}.{e.effect}.{e.parameter}"]
        np.testing.assert_array_equal(row["value"], e.value)
        assert row["origin"] == e.origin and row["unit"] == e.unit
    assert [p.get_ylabel()[0] for p in closed.plot("gyro").axes] == list("xyz")
    with pytest.raises(UserError, match="mag: was not examined"):
        closed.plot("mag")


def test_model_file_is_the_model_found(closed, folder):
    assert_allclose(
        part(folder / "model.toml").sensor("gyro").p, closed.after.sensor("gyro").p, rtol=1e-9
    )


@pytest.mark.parametrize(
    "finding, says",
    [
        (Finding("gravity_down", "accel_z", 1, {"accel_z": -9.80665}), "accel z -1.00 g"),
        (Finding("wrapped", "gyro_x", 2, {"span": np.radians(500)}), "span 500 deg/s"),
        (
            Finding(
                "counts",
                "gyro_x",
                2,
                {"unit": "deg/s", "least": np.radians(-438), "largest": np.radians(24600)},
            ),
            "unit deg/s, least -438 deg/s, largest 24600 deg/s",
        ),
        (
            Finding("repeated_time", "time", 2, {"first": 2.0, "share": 0.36}),
            "first 2.000 s, share 36.0 %",
        ),
    ],
)
def test_details_of_findings_have_units(finding, says):
    assert detail(finding) == says


def test_nothing_is_replaced_where_one_file_cannot_be(tmp_path):
    (tmp_path / "a.txt").write_text("old")
    (tmp_path / "b.txt").mkdir()
    with (
        pytest.raises(UserError, match="cannot be written .b.txt is a folder there"),
        staged(tmp_path) as stage,
    ):
        (stage / "a.txt").write_text("new")
        (stage / "b.txt").write_text("new")
    assert (tmp_path / "a.txt").read_text() == "old" and sorted(
        p.name for p in tmp_path.iterdir()
    ) == ["a.txt", "b.txt"]


def test_page_needs_nothing_beside_it(folder):
    page = (folder / "report.html").read_text()
    alone(page)
    assert all(
        target.startswith(("#", "data:")) for target in re.findall(r'(?:src|href)="([^"]*)"', page)
    )
    assert all(target.startswith("#") for target in re.findall(r"url\(([^)]*)\)", page))
    assert len(page) < 1_500_000


def test_words_of_the_page_are_explained_on_it(folder):
    page = (folder / "report.html").read_text()
    words = page[page.index("<h2>Words</h2>") :]
    for word in ("residual", "held out", "floor", "nat", "gate", "not shown"):
        assert page.count(word) > words.count(word), f"{word} is not used"
        assert re.search(rf"<dt>[^<]*\b{word}\b", words), f"{word} is not explained"


def test_only_the_three_files_are_left(folder):
    assert sorted(f.name for f in folder.iterdir()) == sorted(FILES)


@pytest.mark.parametrize(
    "failure, seen",
    [(OSError(28, "No space left on device"), UserError), (KeyboardInterrupt(), KeyboardInterrupt)],
)
@pytest.mark.parametrize("writer", ["save_part", "page"])
def test_interrupted_writing_leaves_earlier_results_as_they_were(
    closed, folder, monkeypatch, writer, failure, seen
):
    earlier = {f: (folder / f).read_bytes() for f in FILES}

    def fail(*_):
        raise failure

    monkeypatch.setattr(deliver, "page", lambda *_: "a page that takes no time to draw")
    monkeypatch.setattr(deliver, writer, fail)
    with pytest.raises(seen):
        replace(closed, verdict="clean").write(folder, units=False)
    assert {f.name: f.read_bytes() for f in folder.iterdir()} == earlier


def test_folder_that_cannot_be_made_is_the_users_error(closed, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot write there"):
        closed.write(tmp_path / "file" / "out", units=False)


def test_named_sentence(closed):
    text = headline(closed)
    assert re.match(
        r"The gyro clips.*: saturation at [\d., and]+ deg/s on x, y and z.* missing from the "
        r"model\.",
        text,
    )
    assert re.search(
        r"The rate residual on held-out data falls from [\d.]+ to [\d.]+ deg/s, to 0\.\d+ of what "
        r"it was\.",
        text,
    )


@pytest.mark.long
def test_a_product_of_forces_that_is_the_largest_is_named(tmp_path):
    """Six columns, which are no axes: the largest coefficient is in the last."""
    motion, size = world.drive(minutes=2.5, rate_hz=25), 1e-5
    product = motion.force[:, 0] * motion.force[:, 1]
    made = world.recording(motion, lambda v: v + np.outer(product, [0.0, size, 0.0]))
    closed = close(made)
    (added,) = closed.added
    value, std, _ = added.parameters["Q"]
    assert added.effect == "g2_sensitivity" and np.abs(value).argmax() == 11  # row y, the last
    assert abs(value[1, 5] - size) < 5 * std[1, 5]
    closed.write(tmp_path, units=False)
    page = (tmp_path / "report.html").read_text()
    for text in (headline(closed), closed.report(), page):
        assert "(y from xy)" in text
    assert "g2_sensitivity Q xy" in closed.report()
    read = part(tmp_path / "model.toml").gyro.values["g2_sensitivity"]["Q"]
    assert_allclose(read, value, rtol=1e-2, atol=1e-3 * size)


VERDICTS = {
    "unexplained": (
        {"unexplained": (Unexplained("gyro", "z", ("rate_x", "specific_force_z"), 1e-9),)},
        "the gyro residual on z depends on rate x and specific force z (p = 1×10⁻⁹)",
    ),
    "drift": (
        {"drift": {"gyro": {0: 9.0, 2: 30.0}}},
        "The bias of the gyro on x and z wanders more than the model declares",
    ),
    "clean": ({}, "Nothing is missing"),
    "partly": ({"remarks": ("much is left",)}, "Much is left."),
    "not_confirmed": ({"reason": "held-out rows differ"}, "Nothing is confirmed: held-out rows"),
    "reference_unfit": ({"reason": "another body"}, "The reference does not belong to this sensor"),
    "undecidable": ({"reason": "no motion"}, "These logs cannot decide it: no motion."),
}


def test_no_verdict_is_without_a_sentence():
    assert {*VERDICTS, "named"} == set(ALL_VERDICTS)


@pytest.mark.parametrize("verdict", VERDICTS)
def test_each_verdict_has_its_sentence_on_the_page(closed, verdict):
    changes, sentence = VERDICTS[verdict]
    without_pictures = {"unexplained": (), "exhibits": {}}
    other = replace(closed, verdict=verdict, added=(), **(without_pictures | changes))
    assert sentence in headline(other)
    assert sentence in page_of(other)


def test_page_of_logs_that_cannot_decide(undecided):
    assert undecided.verdict == "undecidable"
    page = page_of(undecided)
    assert "These logs cannot decide it" in page and "Nothing." in page


def test_page_without_any_log_is_still_a_page(undecided):
    page = page_of(
        replace(undecided, exhibits={}, errors={}, recordings=(), log_likelihood=None, band_hz={})
    )
    assert "No rows were held out" in page


LOGGED = {
    "specific_force",
    "temperature",
    "time",
    "temperature_rate",
    "angular_acceleration",
    "vibration",
}
DRIVEN = [
    n
    for n, e in CATALOGUE.items()
    if not e.stochastic
    and "gyro" in e.sensors
    and not is_step(e, "gyro")
    and e.signals("gyro") <= LOGGED
]


@pytest.mark.parametrize("name", DRIVEN)
def test_each_effect_has_a_picture_of_what_drives_it(investigation, name):
    inv = investigation
    values = {
        n: p.scan.values(0.04, 0.7)[4] if p.sought else p.start + 0.01
        for n, p in CATALOGUE[name].parameters.items()
    }
    values = {
        n: np.full(p.shape, values[n]) * (1 if p.diagonal else 1 - np.eye(3))
        for n, p in CATALOGUE[name].parameters.items()
    }
    after = replace(inv.after, sensor=inv.after.sensor.with_values(name, **values))
    added = Added("gyro", name, (), {n: (v, v, "1") for n, v in values.items()}, 1.0, 1.0)
    clouds = exhibits_of(replace(inv, after=after), [added]).of_effect[name]
    assert clouds and [c.weight for c in clouds] == sorted((c.weight for c in clouds), reverse=True)
    svg = pictures.cloud(clouds[0], name, "rad/s")
    assert svg.startswith("<svg") and f"with {name}" in svg


def test_rounding_is_shown_in_the_raw_samples(investigation):
    added = Added(
        "gyro", "quantization", (), {"q": (np.array([0.01, 0, 0]), np.zeros(3), "rad/s")}, 1.0, 1.0
    )
    (comb,) = exhibits_of(investigation, [added]).of_effect["quantization"]
    assert comb.axis == 0 and np.abs(comb.offsets).max() <= 0.5
    assert pictures.comb(comb).startswith("<svg")


def test_envelope_keeps_every_spike():
    rng = np.random.default_rng(3)
    time, values = np.arange(50_000) * 0.01, rng.standard_normal(50_000)
    values[[123, 40_321]] = 50.0, -70.0
    at, low, high = pictures.envelope(time, values, 300)
    assert len(at) == 300 and high.max() == 50.0 and low.min() == -70.0


def test_envelope_leaves_gaps_open():
    time = np.concatenate([np.arange(1000), np.arange(5000, 6000)]) * 1.0
    _, low, high = pictures.envelope(time, np.ones(2000), 60)
    assert np.isnan(low).sum() == np.isnan(high).sum() == 40


def _white(n: int, sigma: float, h: float) -> Trace:
    values = sigma * np.random.default_rng(4).standard_normal((n, 3))
    return Trace("log", np.arange(n) * h, [(0, n)], values, values, (0, 1, 2), h)


def test_one_sided_density_of_white_noise():
    # Two sigma^2 h at every frequency; a mean over m rows of three axes has relative deviation
    # sqrt(2 / (3 m)).
    n, sigma, h = 60_000, 0.3, 0.01
    _, density = density_of([_white(n, sigma, h)], "after")
    assert density.mean() == pytest.approx(2 * sigma**2 * h, rel=5 * np.sqrt(2 / (3 * n)))


@pytest.mark.parametrize("band", [None, 8.0])
def test_noise_density_integrates_to_its_variance(band):
    # Parseval: white noise of variance r through weights w has variance r sum w^2.
    h, r = 0.01, 0.04
    nothing = np.zeros((200, 3)), np.zeros((200, 7))
    trial = Trial(
        "log", "gyro", h, np.arange(200) * h, *nothing, [(0, 200)], frozenset(), "rate", band
    )
    f = (np.arange(4000) + 0.5) / 4000 * 0.5 / h
    density = noise_density({i: RandomWalk(r, 0.0) for i in range(3)}, trial, f)
    weights = np.array((Band() if band is None else trial.band).weights)
    assert density.mean() * 0.5 / h == pytest.approx(r * np.sum(weights**2), rel=1e-6)


@pytest.mark.parametrize("si", SHOWN)
def test_people_s_units_measure_the_same(si):
    assert all(same_dimension(si, unit) for unit, _ in SHOWN[si])


@pytest.mark.parametrize(
    "value, si, said",
    [
        (np.deg2rad(20.4), "rad/s", "20.4 deg/s"),
        (np.deg2rad(12.0) / 3600, "rad/s", "12.0 deg/h"),
        (0.0148, "m/s^2", "1.51 mg"),
        (3.87e-3, "s", "3.87 ms"),
        (42e-6, "1", "42.0 ppm"),
        (2 * np.pi * 30, told_apart("rad/s", "frequency"), "30.0 Hz"),
        (np.sqrt(0.5), told_apart("1", "ratio"), "0.707"),
        (2.0, "(K) * (m/s^2)", "2.00 (K) * (m/s²)"),
        (1.0, "V", "1.00 V"),
        (5.06e-3, "m/s^2/K", "0.516 mg/K"),
        (np.deg2rad(0.2) / 60, "rad/sqrt(s)", "0.200 deg/√h"),
        (None, "rad/s", "–"),
    ],
)
def test_quantities_as_people_say_them(value, si, said):
    assert quantity(value, si) == said


def test_what_is_said_otherwise_is_plain_in_si():
    assert si_quantity(3.0, told_apart("rad/s", "frequency")) == "3.00 rad/s"
    used = {q.said for e in CATALOGUE.values() for q in e.parameters.values()}
    assert used == {"", *SAID}


@pytest.mark.parametrize(
    "name, si, value, unit, said",
    [("wn", "rad/s", 2 * np.pi * 30, "Hz", "30.0 (29.4 to 30.6)"), ("zeta", "1", 1.4, "1", "1.4")],
)
def test_a_frequency_and_a_ratio_are_no_rate_and_no_share(name, si, value, unit, said, tmp_path):
    """In the page's table and in the model's file, which is read as it was written."""
    std = np.array(0.01 * value if name == "wn" else np.nan)
    v = Estimated("gyro", "lag", name, si, np.array(value), std, np.array(True), "estimated")
    (row,) = coefficient_rows(SimpleNamespace(estimated=[v]), "gyro")
    assert row.unit == unit and row.cells[0].startswith(said)
    gyro = {"lag": {"wn": 200.0, "zeta": 0.7}}
    written = as_part(Part("p", 100.0, Sensor("gyro", gyro), Sensor("accel")), [v], None, {})
    assert written.notes["gyro", "lag", name]["unit"] == unit
    again = load_part(save_part(written, tmp_path / "model.toml"))
    assert again.gyro.values["lag"][name] == pytest.approx(value, rel=1e-4)


@pytest.mark.parametrize(
    "value, std, said",
    [
        (4.1173, 0.0404, "4.117 ± 0.040"),
        (331.2, 12.4, "331 ± 12"),
        (7.45e-6, 8.3e-7, "(7.45 ± 0.83)×10⁻⁶"),
        (420.74, 0.0, "420.7"),
        (420.74, np.nan, "420.7"),
    ],
)
def test_value_and_standard_error_end_at_the_same_place(value, std, said):
    assert with_error(value, std) == said


@pytest.mark.parametrize("name", CATALOGUE)
def test_equations_are_drawn_by_the_browser(name):
    mathml = equation(CATALOGUE[name].equation)
    assert mathml.startswith("<math") and "\\" not in mathml and "http" not in mathml
    ElementTree.fromstring(mathml)


def test_what_a_log_is_called_cannot_break_the_page(undecided):
    entry = replace(undecided.recordings[0], file="<b>log</b>.csv")
    assert "<b>" not in page_of(
        replace(undecided, recordings=(entry,), before=replace(undecided.before, name="<b>"))
    )


def test_units_in_print():
    spelled = {
        "rad/s/(m/s^2)": "rad/s/(m/s²)",
        "deg/sqrt(h)": "deg/√h",
        "ug/K^2": "µg/K²",
        "1": "",
        "us": "µs",
    }
    assert {u: pretty(u) for u in spelled} == spelled
