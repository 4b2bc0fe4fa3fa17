"""The next experiment: what is predicted of a motion is what a log of it shows."""

import json
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from scipy.signal import cont2discrete, lfilter
from scipy.stats import chi2
from typer.testing import CliRunner

import pyimu
from pyimu import Part, Sensor, UserError
from pyimu.cli import app
from pyimu.identification.fit.fit import begin, gauss_newton, power
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.identification.fit.trials import accel_trial, gyro_trial
from pyimu.identification.plan.apart import APART, separation
from pyimu.identification.plan.choice import LONGEST, Chooser, Question
from pyimu.identification.plan.goals import class_of, wanted_errors
from pyimu.identification.plan.information import Information, information
from pyimu.identification.plan.motions import SHARE, Limits, library
from pyimu.identification.plan.noise import declared_noise
from pyimu.identification.plan.page import page
from pyimu.identification.plan.plan import CHOSEN
from pyimu.identification.plan.scene import FINE_STEP, recorded, trial_of
from pyimu.identification.plan.words import place
from pyimu.recording.log import read_reference

N, K = {"gyro": 6e-5, "accel": 2e-3}, {"gyro": 6e-7, "accel": 2e-5}
WANDERING = {"gyro": 1.2e-5, "accel": 4e-4}
"""A random walk that a log of half an hour shows well."""

MOTIONS = {m.name: m for m in library()}
BATCHES = 80
"""Into which ``close`` cuts a log to see how much its scores scatter."""


def part(rate, k=K):
    sensors = (
        Sensor(kind, {"angle_random_walk": {"N": N[kind]}, "rate_random_walk": {"K": k[kind]}})
        for kind in N
    )
    return Part("proof", rate, *sensors)


def truth(motion, h):
    return recorded([MOTIONS[motion]], Limits(), h)


def told(kind, effects, motion, h, k=K):
    """What a motion tells of effects that a part of this sample period lacks."""
    sensor = part(1 / h, k).sensor(kind)
    noise = declared_noise(sensor, h, h)
    return information(sensor, trial_of(truth(motion, h), kind), noise, effects)


def with_effect(lacking, kind, effect, std, sigmas, seed=1):
    """The part with an effect whose every coefficient is so many standard errors, and its name."""
    rng = np.random.default_rng(seed)
    sensor = lacking.sensor(kind).with_values(effect)
    (name,) = {k.parameter for k in std}
    value = np.zeros(sensor.values[effect][name].shape)
    for key, s in std.items():
        value[key.index] = sigmas * s * rng.choice([-1, 1])
    return lacking.with_sensor(sensor.with_values(effect, **{name: value})), name


# What is predicted is what close reports


CLOSED = [
    ("gyro", "g_sensitivity", "by_hand", 0.02),
    ("gyro", "scale_factor", "table_steps", 0.02),
    ("gyro", "misalignment", "table_level", 0.02),
    ("accel", "scale_factor", "six_positions", 0.1),
    ("accel", "size_effect", "by_hand", 0.02),
    ("gyro", "thermal_bias", "rest_warmed", 0.5),
]


@pytest.mark.long
@pytest.mark.parametrize(("kind", "effect", "motion", "h"), CLOSED)
def test_close_reports_the_predicted_standard_error(kind, effect, motion, h):
    """An effect of 60 standard errors, which the part lacks, is found, and each of its errors is as
    predicted: to what the estimate of the noise from this log makes of it.

    White noise of n rows is known to 1 / sqrt(2 n); the random walk's K^2 to sqrt(8 N / (K T)) by
    the Whittle information T / 2 of (S_walk / S)^2 over all frequencies. The scatter of 80 batches'
    scores makes the errors larger by the root of a mean of 80 P squares, P coefficients, where that
    exceeds one.
    """
    slow = effect == "thermal_bias"
    k = WANDERING if slow else K
    lacking = part(1 / h, k)
    std = told(kind, [effect], motion, h, k).errors()
    true, name = with_effect(lacking, kind, effect, std, 60.0)
    other = {"gyro": "accel", "accel": "gyro"}[kind]
    logs = [
        replace(true.simulate(truth(motion, h), seed=s), name=f"log {s}", **{other: None})
        for s in (3, 4)
    ]
    closed = pyimu.close(logs[0], lacking, logs[1])
    found = next(a for a in closed.added if a.effect == effect)
    value, error = (np.asarray(v) for v in found.parameters[name][:2])
    ratios = np.array([error[k.index] / s for k, s in std.items()])

    rows, duration = len(logs[0]), len(logs[0]) * h
    white, walk = 1 / np.sqrt(2 * rows), np.sqrt(8 * N[kind] / (k[kind] * duration))
    noise = 0.5 * walk if slow else white + 0.1 * walk
    scatter = np.sqrt(1 + 5 * np.sqrt(2 / BATCHES))
    assert np.all(ratios > 1 - 5 * noise) and np.all(ratios < (1 + 5 * noise) * scatter), ratios
    right = true.sensor(kind).values[effect][name]
    z = np.array([(value[k.index] - right[k.index]) / s for k, s in std.items()])
    assert np.all(np.abs(z) < 5.0), z


@pytest.mark.long
@pytest.mark.parametrize(
    ("kind", "effect", "motion", "h"),
    [
        ("gyro", "g_sensitivity", "by_hand", 0.05),
        ("gyro", "scale_factor_cubic", "table_steps", 0.05),
        ("accel", "misalignment", "six_positions", 0.1),
        ("gyro", "temperature_rate", "rest_warmed", 1.0),
    ],
)
def test_repeated_estimates_scatter_as_predicted(kind, effect, motion, h):
    """(estimate - truth)' J (estimate - truth) of each log is chi-square with as many degrees of
    freedom as there are coefficients; the sum over 30 logs lies in its 99.99 % interval. The fit
    takes the noise that the part declares, as the prediction does.
    """
    j = told(kind, [effect], motion, h)
    lacking, made = (
        part(1 / h),
        {"gyro": gyro_trial, "accel": lambda r: accel_trial(r, False)}[kind],
    )
    true, _ = with_effect(lacking, kind, effect, j.errors(), 20.0)
    log, total, repeats = truth(motion, h), 0.0, 30
    for seed in range(repeats):
        measured = true.simulate(log, seed=seed)
        sensor = lacking.sensor(kind).with_values(effect)
        fit = begin(sensor, j.keys, [made(measured)])
        fit = gauss_newton(replace(fit, noise=declared_noise(sensor, h, h)), 4)
        off = [_value(fit.sensor, k) - _value(true.sensor(kind), k) for k in j.keys]
        total += float(np.array(off) @ j.gram @ np.array(off))
    low, high = chi2.ppf([5e-5, 1 - 5e-5], repeats * len(j.keys))
    assert low < total < high


def _value(sensor, key):
    return sensor.values[key.effect][key.parameter][key.index]


def test_sine_shows_a_scale_factor_as_white_noise_lets_it():
    """N over rms and the root of the time (Kay 1993, example 4.1), less what the turns from one
    axis to the next add and the rows that close leaves out, 1 % each.
    """
    sensor = Sensor("gyro", {"angle_random_walk": {"N": 1e-4}})
    one = trial_of(truth("table_sines", 0.02), "gyro")
    std = information(sensor, one, declared_noise(sensor, 0.02, 0.02), ["scale_factor"]).errors()
    want = 1e-4 / (np.radians(90.0) / np.sqrt(2) * np.sqrt(60.0))
    for error in std.values():
        assert error == pytest.approx(want, rel=0.02)


def test_rounding_has_the_density_that_the_samples_give_it():
    """N^2 + q^2 T / 12 of samples T apart (Widrow), whether rows are 20 ms or a second apart."""
    n, q, period = 1e-4, 1e-2, 1e-3
    sensor = Sensor("gyro", {"angle_random_walk": {"N": n}, "quantization": {"q": q}})
    for h in (0.02, 1.0):
        row = declared_noise(sensor, h, period)[0]
        assert row.r * h == pytest.approx(n**2 + q**2 * period / 12, rel=1e-12)


@pytest.mark.long
def test_lag_and_delay_together_are_known_as_a_continuous_filter_says():
    """The bound for delay, natural frequency and damping beside the bias of each axis, where the
    filter is the continuous one behind straight lines between samples (scipy).

    Frequency and delay differ in the third order of the lag's time, which the sampled filter of
    steps of a ms, a natural frequency of 628 rad/s, misses by (wn h)^2 / 4, a tenth; at 20 ms it
    has nothing to do with it, six times less for this part. The damping is not compared.
    """
    part = pyimu.part("mpu6050")
    planned = pyimu.plan(part, ["time_delay", "lag"], within=["time_delay=1 s", "lag=1 kHz"])
    told = {k.parameter: v for k, v in planned.by_motion["table_sines"].items()}
    values = part.gyro.values["lag"]
    wn, zeta = float(values["wn"]), float(values["zeta"])
    log = truth("table_sines", FINE_STEP)
    noise = float(part.gyro.values["angle_random_walk"]["N"][0]) / np.sqrt(FINE_STEP)
    slopes = [
        (_late(log.ref_rate, wn + 1e-3 * wn, zeta) - _late(log.ref_rate, wn - 1e-3 * wn, zeta))
        / (2e-3 * wn),
        (_late(log.ref_rate, wn, zeta + 1e-3) - _late(log.ref_rate, wn, zeta - 1e-3)) / 2e-3,
        -np.gradient(_late(log.ref_rate, wn, zeta), FINE_STEP, axis=0, edge_order=2),
    ]
    bias = [np.tile(e, (len(log), 1)) for e in np.eye(3)]
    columns = np.column_stack([c.ravel() for c in (*slopes, *bias)])
    size = np.linalg.norm(columns, axis=0)
    inverse = np.linalg.inv((columns / size).T @ (columns / size))
    frequency, _, delay = (noise * np.sqrt(np.diag(inverse)) / size)[:3]
    assert told["wn"] == pytest.approx(frequency, rel=0.1)
    assert told["td"] == pytest.approx(delay, rel=0.1)


def _late(x, wn, zeta):
    """x (n, 3) every ``FINE_STEP`` behind a second-order low-pass that starts at rest."""
    b, a, _ = cont2discrete(([wn * wn], [1, 2 * zeta * wn, wn * wn]), FINE_STEP, "foh")
    return lfilter(b.ravel(), a, x, axis=0)


def test_a_motion_twice_halves_the_variance():
    j = told("gyro", ["scale_factor", "g_sensitivity"], "table_level", 0.05)
    once, twice = j.errors(), (j + j).errors()
    for key, error in once.items():
        assert twice[key] == pytest.approx(error / np.sqrt(2), rel=1e-6)


def test_temperature_and_its_rate_are_apart_in_a_whole_cycle():
    """A cosine and its derivative over a whole period are orthogonal; the whitening by the random
    walk and the constant leave that to the ends of the log, some 1 / 1800.
    """
    j = told("gyro", ["thermal_bias", "temperature_rate"], "rest_warmed", 1.0)
    one, other = (
        [k for k in j.keys if k.effect == e] for e in ("thermal_bias", "temperature_rate")
    )
    assert j.canonical(one, other) < 0.05


# The motions


@pytest.mark.parametrize("name", [m for m in MOTIONS if m not in ("by_hand", "drive", "shaker")])
def test_gravity_turns_as_the_rate_says(name):
    """df/dt = -w x f of a force that is fixed in the world (Poisson's equation), by a difference
    over two steps, whose error is the cube of the angle turned in one over 6.
    """
    h = 0.02
    log = truth(name, h)
    f, w = log.ref_force, 0.5 * (log.ref_rate[1:-1] + log.ref_rate[2:])
    slope = (f[2:] - f[:-2]) / (2 * h)
    turned = -np.cross(w, f[1:-1])
    angle = h * np.abs(log.ref_rate).max()
    bound = 9.81 * (angle**3 / 6 / h + angle * 0.02 / h * 0.2) + 1e-9
    assert np.abs(slope - turned).max() < bound
    np.testing.assert_allclose(np.linalg.norm(f, axis=1), 9.80665, rtol=1e-9)


@pytest.mark.parametrize("name", MOTIONS)
def test_motion_lasts_as_it_says_and_ends_level_and_cold(name):
    log = truth(name, 0.05)
    assert len(log) * 0.05 == pytest.approx(MOTIONS[name].duration, abs=0.05 * 1.5)
    assert log.temperature[0] == 25.0 and abs(log.temperature[-1] - 25.0) < 0.01
    if MOTIONS[name].fixed:
        np.testing.assert_allclose(log.ref_force[-1], [0.0, 0.0, 9.80665], atol=1e-6)


@pytest.mark.parametrize("name", MOTIONS)
def test_motions_keep_to_the_ranges(name):
    small = pyimu.part("mpu6050")
    gyro = small.gyro.with_values("saturation", limit=np.radians(60.0))
    limits = Limits.of(gyro, small.accel)
    (motion,) = (m for m in library(limits) if m.name == name)
    log = recorded([motion], limits, 0.02)
    assert name not in ("table_steps", "table_level") or "with 30, 48 deg/s" in motion.text
    assert np.abs(log.ref_rate).max() <= SHARE * np.radians(60.0) * (1 + 1e-12)
    assert np.abs(log.ref_force).max() <= max(SHARE * 2 * 9.80665, 9.80665 + 2.5)


# The choice


def test_no_plan_of_two_motions_is_shorter():
    """Every pair of counts up to 12 of three motions whose information is drawn at random."""
    rng = np.random.default_rng(5)
    keys = tuple(Coefficient("e", "p", (i,)) for i in range(3))
    for _ in range(20):
        roots = rng.standard_normal((3, 3, 2)) * rng.uniform(0.2, 2.0, (3, 1, 1))
        found = [Information(keys, r @ r.T) for r in roots]
        durations = rng.uniform(60, 600, 3)
        wanted = {k: float(rng.uniform(0.5, 2.0)) for k in keys}
        chooser = Chooser(found, durations, [Question(keys, wanted)])
        chosen = chooser.shortest()
        enough = [
            chooser.duration(c)
            for c in product(range(8), repeat=3)
            if 0 in c and chooser.lack(c) == 0.0
        ]
        if enough:
            assert chosen is not None and chooser.lack(chosen) == 0.0
            assert chooser.duration(chosen) <= min(enough) + 1e-9


def test_nothing_is_chosen_where_a_day_is_not_enough():
    key = (Coefficient("e", "p", ()),)
    found = [Information(key, np.array([[1.0]]))]
    wanted = {key[0]: 0.9 / np.sqrt(LONGEST / 60.0)}
    assert Chooser(found, [60.0], [Question(key, wanted)]).shortest() is None


# The plan


@pytest.fixture(scope="module")
def planned():
    effects = ["g_sensitivity", "scale_factor", "bias_step", "angle_random_walk", "saturation"]
    return pyimu.plan("mpu6050", effects)


def test_plan_reaches_what_is_wanted_or_says_why(planned):
    assert planned.logs and planned.kind == "gyro" and planned.of_class == "consumer"
    for p in planned.predicted:
        if p.goal.key.effect in ("g_sensitivity", "scale_factor"):
            assert p.reached and not p.reason and p.sigmas >= 8.0, place(p)
        else:
            assert p.reason and not np.isfinite(p.std), place(p)
    reasons = {p.goal.key.effect: p.reason for p in planned.predicted}
    assert "event" in reasons["bias_step"] and "noise" in reasons["angle_random_walk"]
    assert "beyond this limit" in reasons["saturation"]


def test_plan_writes_a_motion_that_can_be_read(planned, tmp_path):
    page = planned.write(tmp_path)
    said = json.loads((tmp_path / "plan.json").read_text())
    log = read_reference(tmp_path / said["logs"][0]["file"])
    header = (tmp_path / said["logs"][0]["file"]).read_text().partition("\n")[0]
    assert header.startswith("time [s]") and "ref_rate_x [rad/s]" in header
    assert "ref_force_z [m/s^2]" in header and "temperature [degC]" in header
    assert len(log) * log.sample_period == pytest.approx(said["duration"]["value"], rel=1e-6)
    text = page.read_text()
    for m in planned.motions:
        assert m.name.replace("_", " ") in text
    assert "bias step" in text and "NaN" not in text and "nan" not in text.replace("nanom", "")


@pytest.mark.long
def test_a_recording_is_a_reference_only_where_a_machine_follows_it():
    by_hand, table = pyimu.plan("mpu6050", "g_sensitivity"), pyimu.plan("mpu6050", "misalignment")
    assert [s.motion.name for s in by_hand.steps] == ["by_hand"]
    assert [s.motion.name for s in table.steps] == ["table_sines"]
    assert "what tracked the motion" in page(by_hand) and "--reference" not in page(by_hand)
    assert "--reference of the sensor" in page(table)
    for p in (by_hand, table):
        assert "the reference has none" in page(p) and "the reference has none" in p.report()


def test_the_command_writes_what_the_function_plans(tmp_path):
    words = ["plan", "mpu6050", "--for", "g_sensitivity", "--out", str(tmp_path / "plan")]
    ended = CliRunner().invoke(app, words)
    assert ended.exit_code == 0, (ended.output, ended.exception)
    alone = pyimu.plan("mpu6050", "g_sensitivity")
    assert ended.output.startswith(alone.report().splitlines()[0])
    said = json.loads((tmp_path / "plan" / "plan.json").read_text())
    assert said["duration"]["value"] == pytest.approx(alone.as_dict()["duration"]["value"])


@pytest.mark.long
@pytest.mark.parametrize(
    "words",
    [
        ["--for", "g_sensitivity", "scale_factor"],
        ["--for", "g_sensitivity,scale_factor"],
        ["--for", "g_sensitivity", "--for", "scale_factor"],
    ],
)
def test_several_effects_are_given_as_one_likes(words, tmp_path):
    ended = CliRunner().invoke(app, ["plan", "mpu6050", *words, "--out", str(tmp_path), "--json"])
    assert json.loads(ended.output)["effects"] == ["g_sensitivity", "scale_factor"], ended.output


def test_the_command_gives_its_data_or_nothing(tmp_path):
    words = ["plan", "mpu6050", "--for", "g_sensitivity", "--out", str(tmp_path)]
    ended = CliRunner().invoke(app, [*words, "--json"])
    assert json.loads(ended.output) == json.loads((tmp_path / "plan.json").read_text())
    assert CliRunner().invoke(app, [*words, "--quiet"]).output == ""
    assert CliRunner().invoke(app, [*words, "--quiet", "--json"]).exit_code != 0


def test_what_is_heard_of_the_work_rises_to_the_end(tmp_path):
    heard = []
    found = pyimu.plan("mpu6050", "g_sensitivity", say=lambda text, share: heard.append(share))
    assert heard[0] == 0 and np.all(np.diff(heard) >= 0) and 0.5 < heard[-1] <= CHOSEN
    written = []
    found.write(tmp_path, lambda text, share: written.append(share))
    assert written[0] == 0 and np.all(np.diff(written) > 0) and 0.5 <= written[-1] < 1


def test_wanted_error_is_reached():
    wide = pyimu.plan("imt30", "g_sensitivity", within="3 deg/h/g")
    tight = pyimu.plan("imt30", "g_sensitivity", within="1 deg/h/g")
    assert all(not s.motion.warm for s in wide.steps)
    for p, value in ((wide, 3.0), (tight, 1.0)):
        limit = np.radians(value) / 3600 / 9.80665
        assert all(q.std <= limit for q in p.predicted)
    assert tight.duration > wide.duration


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("mpu6050", "g_sensitivit"), ("did you mean g_sensitivity",)),
        (("mpu605", "g_sensitivity"), ("did you mean mpu6050",)),
        (("mpu6050", "size_effect", "gyro"), ("does not belong to a gyro",)),
        (("mpu6050", "lag", "gyr"), ("did you mean gyro", "known are gyro, accel")),
        (("mpu6050", ()), ("no effect asked for",)),
        (("mpu6050", "nothing"), ("unknown effect 'nothing'; known are", "g_sensitivity")),
        (("mpu6050", "g_sensitivty"), ("did you mean g_sensitivity",)),
        (("mpu6050", "lag", None, "3 deg"), ("--within 3 deg", "lag.wn")),
        (("mpu6050", ("lag", "ageing"), None, "3 Hz"), ("EFFECT=VALUE",)),
        (("mpu6050", "lag", None, (), -1.0), ("sigmas -1",)),
    ],
)
def test_bad_input_is_one_line_that_helps(arguments, words):
    with pytest.raises(UserError) as error:
        pyimu.plan(*arguments)
    assert all(w in str(error.value) for w in words), str(error.value)


def test_wanted_frequency_is_said_in_the_unit_in_which_it_is_shown():
    (wanted,) = wanted_errors(["12 Hz"], "gyro", ["lag"]).values()
    assert wanted == pytest.approx(2 * np.pi * 12.0)


def test_wanted_error_is_read_in_its_unit():
    found = wanted_errors(["thermal_bias = 3.6 deg/h/K"], "gyro", ["thermal_bias", "lag"])
    assert found == {"thermal_bias": pytest.approx(np.radians(3.6 / 3600))}


@pytest.mark.parametrize(("name", "want"), [("stim300", "tactical"), ("mpu6050", "consumer")])
def test_class_of_a_part(name, want):
    assert class_of(pyimu.part(name), "gyro") == want


# Told apart


def test_proposed_motion_tells_an_effect_from_its_double():
    """On a drive a force across the rover is nearly its product with gravity. In the motion that is
    proposed the double leaves d^2 more of the whitened power, with a deviation of 2 d (a noncentral
    chi-square of few degrees of freedom, here at 5 deviations).
    """
    h, values = 0.05, {"G": np.diag([2e-5, 2e-5, 0.0])}
    lacking = part(1 / h)
    true = lacking.with_sensor(lacking.gyro.with_values("g_sensitivity", **values))
    fitted = _fitted(true, lacking, truth("drive", h), "g_sensitivity", 1)
    fitted = replace(fitted, sensor=true.gyro)  # the drive leaves them too uncertain for a size
    proposed = separation(fitted, "g_sensitivity", ["g2_sensitivity"])
    assert proposed is not None and proposed.distance >= APART
    d = proposed.distance
    log = recorded([proposed.motion] * proposed.times, Limits(), h)
    right, double = (_fitted(true, lacking, log, e, 2) for e in ("g_sensitivity", "g2_sensitivity"))
    double = replace(double, noise=right.noise)
    more = power(gauss_newton(double, 4)) - power(right)
    assert d > 12.0 and more > d**2 - 10 * d - 18, (d, more)


def _fitted(true, lacking, log, effect, seed):
    sensor = lacking.gyro.with_values(effect)
    trial = gyro_trial(true.simulate(log, seed=seed))
    fit = begin(sensor, coefficients_of(sensor, effect), [trial])
    return gauss_newton(gauss_newton(fit, 4).with_noise(), 2)
