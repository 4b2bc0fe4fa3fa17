"""Laws that every effect of the catalogue keeps; a new effect is tested by being listed."""

import subprocess
import sys
from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from catalogue_cases import (
    CASES,
    H,
    alone,
    as_part,
    everything,
    excited,
    inputs,
    motion,
    outputs,
    own,
    run,
    size,
    with_excited,
)

from pyimu import units
from pyimu.block.normals import normals
from pyimu.errors import UserError
from pyimu.model.arguments import Environment, Parameter, State
from pyimu.model.catalogue import CATALOGUE, add_effects
from pyimu.model.effect import effect
from pyimu.model.kinds import KINDS, OWN_RATE
from pyimu.model.part import Part
from pyimu.model.part_file import load_part, save_part
from pyimu.model.sensor import Sensor, candidates
from pyimu.model.signals import COLUMNS, N_INPUT, SIGNALS, inputs_of

every_effect = pytest.mark.parametrize("name, kind", CASES)
every_name = pytest.mark.parametrize("name", CATALOGUE)


def draws(sensor: Sensor, n: int, first: int = 1) -> np.ndarray:
    return normals(5, [c.number for c in sensor.noise], first, n)


@every_name
def test_an_effect_says_what_it_is_and_where_it_is_from(name):
    e = CATALOGUE[name]
    assert e.equation.strip() and e.source.strip() and e.term.strip() and e.sensors
    assert set(e.sensors) <= set(KINDS) and set(e.environment.values()) <= {*SIGNALS, OWN_RATE}
    for n, q in e.parameters.items():
        assert q.description, f"{name}.{n} has no description"
        assert q.minimum is None or q.start >= q.minimum
        for kind in e.sensors:
            units.parse(Sensor(kind).unit(q.unit))
    assert e.lost is None or not e.invertible, f"{name} restores every sample, so it loses none"


@every_effect
def test_identity_at_start_values(name, kind):
    """Output equals input bit for bit, with the noise on."""
    sensor, u = Sensor(kind, {name: {}}), motion(200)
    np.testing.assert_array_equal(run(sensor, u, draws(sensor, 200)), u[:, own(kind)])


@every_effect
def test_away_from_start_values_the_output_changes(name, kind):
    sensor, u = excited(name, kind), motion(200)
    change = np.abs(run(sensor, u, draws(sensor, 200)) - u[:, own(kind)]).max(0)
    assert np.all(change > 1e-6 * np.abs(u[:, own(kind)]).max())


@every_effect
def test_an_effect_at_identity_changes_no_other(name, kind):
    """Neither the bits of the effects that are there, nor the noise they draw."""
    base = Sensor(kind)
    for other in ("angle_random_walk", "rate_random_walk", "scale_factor", "thermal_bias"):
        base = base if other == name else with_excited(base, other)
    more, u = base.with_values(name), motion(200)
    np.testing.assert_array_equal(run(more, u, draws(more, 200)), run(base, u, draws(base, 200)))


@every_effect
def test_sensors_of_a_part_do_not_touch_each_other(name, kind):
    other = "accel" if kind == "gyro" else "gyro"
    neighbour, u = excited("angle_random_walk", other), motion(100)
    by_itself = run(neighbour, u, draws(neighbour, 100))
    together = as_part(excited(name, kind), neighbour)
    w = normals(5, [c.number for c in together.block.noise], 1, 100)
    np.testing.assert_array_equal(
        together.block.run(inputs(u, together), w=w)[0][:, outputs(other)], by_itself
    )


@every_effect
def test_half_run_plus_half_run_is_the_whole_run(name, kind):
    sensor, u = excited(name, kind), motion(300)
    part = as_part(sensor)
    block, w, u = part.block, draws(sensor, 300), inputs(u, part)
    whole, last = block.run(u, w=w)
    first, state = block.run(u[:137], w=w[:137])
    second, end = block.run(u[137:], w=draws(sensor, 163, first=138), state=state)
    np.testing.assert_array_equal(np.vstack([first, second]), whole)
    np.testing.assert_array_equal(end, last)


def scale(unit: str) -> float:
    """What a value in this unit is multiplied by in other base units.

    Powers of four, whose roots are exact too: nothing is rounded. The radian stays the number one,
    which it is in SI: a small angle multiplies a rate, and wn h counts radians a sample.
    """
    factors = {"rad": 1.0, "s": 4.0, "m": 16.0, "K": 1 / 64, "V": 256.0, "T": 1 / 1024, "LSB": 1.0}
    return float(
        np.prod(
            [factors[base] ** float(e) for base, e in zip(units.BASES, units.parse(unit).dimension)]
        )
    )


@every_effect
def test_units_balance(name, kind):
    """In other units of metre, second and kelvin the same equation gives the same output: no unit
    is declared wrongly.
    """
    sensor, u = excited(name, kind), motion(200)
    other_p = sensor.p * [scale(s.unit) for s in sensor.slots]
    other_u = u * np.concatenate([np.full(s.size, scale(s.unit)) for s in SIGNALS.values()])
    block, w = alone(sensor), draws(sensor, 200)
    y, _ = block.run(u, w=w)
    other_y, _ = block.run(other_u, p=other_p, w=w, sample_period=H * scale("s"))
    np.testing.assert_array_equal(other_y, y * scale(KINDS[kind].unit))


def has_corners(sensor: Sensor) -> bool:
    """Whether the output of one step has a corner or a jump in the sensor's own input.

    Under a grid four times finer second differences of a smooth function fall sixteenfold, at a
    corner fourfold, at a jump not at all.
    """
    step, state = sensor.step, sensor.chain.start
    for row in motion(40):
        state, _ = step(state, row, sensor.p, np.zeros(len(sensor.noise)), H)

    def bend(points: int) -> np.ndarray:
        grid = np.linspace(-1.03, 1.01, points)
        u = np.tile(motion(41)[-1], (points, 1))
        u[:, own(sensor.kind)] = grid[:, None] * np.abs(motion(40)[:, own(sensor.kind)]).max()
        y = np.array(step.map(points)(state, u.T, sensor.p, np.zeros(len(sensor.noise)), H)[1])
        return np.abs(np.diff(y, 2)).max() / np.abs(u).max()

    coarse, fine = bend(1001), bend(4001)
    return bool(fine > coarse / 8 and coarse > 1e-9)


def is_affine_in_coefficients(sensor: Sensor) -> bool:
    """Whether a step is affine in the coefficients that are estimated, so that its slopes are
    regressors as they are.
    """
    s, u, p, w, h = (ca.SX.sym(n, *sensor.step.size_in(i)) for i, n in enumerate("supwh"))
    free = [
        i
        for i, slot in enumerate(sensor.slots)
        if not (slot.definition.reference or slot.definition.form)
    ]
    y = sensor.step(s, u, p, w, h)[1]
    slope = ca.jacobian(y, p)
    moves_a_jump = any(ca.depends_on(y, p[i]) and slope[:, i].is_zero() for i in free)
    return not (free and (moves_a_jump or ca.depends_on(slope[:, free], p[free])))


@every_effect
def test_smooth_says_whether_there_are_corners_that_no_regressor_describes(name, kind):
    sensor, e = excited(name, kind), CATALOGUE[name]
    hidden = has_corners(sensor) and not is_affine_in_coefficients(sensor)
    assert hidden == (not e.smooth)


@every_effect
def test_identification_finds_a_slope_or_is_told_where_to_look(name, kind):
    """At the identity the output answers to each coefficient, or the effect has a scan; rounding
    alone has neither.
    """
    sensor, e = Sensor(kind, {name: {}}), CATALOGUE[name]
    if e.stochastic or not e.smooth or any(q.scan for q in e.parameters.values()):
        return
    u = motion(60)
    for i, slot in enumerate(sensor.slots):
        if slot.definition.reference or slot.definition.form:
            continue
        moved = sensor.p.copy()
        moved[i] += 1e-6 * size(slot.unit)
        assert np.any(run(sensor.with_p(moved), u) != u[:, own(kind)]), (
            f"{slot.name} has no slope and no scan"
        )


def compensate(sensor: Sensor, y: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Restored input (n, 3) and marks of lost samples (n, 3); the sensor's own signal is hidden
    from the inputs.
    """
    hidden = u.copy()
    hidden[:, own(sensor.kind)] = np.nan
    x, lost, state = np.empty_like(y), np.empty_like(y), sensor.chain.start
    for k in range(len(y)):
        state, a, b = sensor.compensation(state, y[k], hidden[k], sensor.p, H)
        x[k], lost[k] = np.array(a)[:, 0], np.array(b)[:, 0]
    return x, lost


@every_effect
def test_compensation_restores_the_input_marks_it_as_lost_or_says_that_the_effect_is_left_in(
    name, kind
):
    """One of the three: exact for an invertible effect, and for another one all that is not marked,
    unless the sensor names it.
    """
    sensor, u, e = excited(name, kind), motion(150), CATALOGUE[name]
    truth = u[:, own(kind)]
    x, lost = compensate(sensor, run(sensor, u), u)
    assert [e.invertible, bool(lost.any()), sensor.left_in == (name,)].count(True) == 1
    if sensor.left_in:
        assert np.abs(x - truth).max() > 1e-6 * np.abs(truth).max()
    else:
        np.testing.assert_allclose(
            x[lost == 0], truth[lost == 0], rtol=1e-12, atol=1e-12 * np.abs(truth).max()
        )


@every_effect
def test_nothing_is_left_in_of_an_effect_that_does_nothing(name, kind):
    sensor = Sensor(kind, {name: {}})
    assert not sensor.left_in and not sensor.acts(name) and excited(name, kind).acts(name)


@every_effect
@pytest.mark.parametrize("at", [0, 60])
def test_what_is_not_a_number_stays_none_and_is_forgotten(name, kind, at):
    """NaN in on one axis is NaN out on it; a difference of neighbours knows nothing of the next
    sample either; then it is over.
    """
    part, u = as_part(excited(name, kind)), motion(150)
    u[at, own(kind).start + 1] = np.nan
    w = normals(5, [c.number for c in part.block.noise], 1, len(u))
    y = part.block.run(inputs(u, part), w=w)[0][:, outputs(kind)]
    assert np.isnan(y[at, 1])
    assert np.isfinite(np.delete(y, [at, at + 1], axis=0)).all()
    assert np.isfinite(y[at + 1]).all() or CATALOGUE[name].differences
    if not CATALOGUE[name].states:
        return
    # Behind it the memory goes on as if the last input had been held, which is what it starts from
    # where there was none; a sum has nothing to add.
    held = u.copy()
    held[at, own(kind)] = 0.0 if name == "angle_quantization" else held[max(at - 1, 1), own(kind)]
    np.testing.assert_allclose(
        y[at + 1 :, 1],
        part.block.run(inputs(held, part), w=w)[0][at + 1 :, outputs(kind)][:, 1],
        rtol=1e-12,
        atol=1e-12,
    )


@every_effect
def test_an_unknown_environment_is_an_unknown_output_and_is_forgotten(name, kind):
    part = as_part(excited(name, kind))
    for signal in inputs_of(CATALOGUE[name].signals(kind)):
        u = motion(150)
        u[60, COLUMNS[signal].start] = np.nan
        w = normals(5, [c.number for c in part.block.noise], 1, len(u))
        y = part.block.run(inputs(u, part), w=w)[0][:, outputs(kind)]
        assert np.isnan(y[60]).any(), signal
        assert np.isfinite(np.delete(y, [60, 61], axis=0)).all(), signal


REFUSED = [
    ("scale_factor", {"s": np.nan}, "gyro scale_factor.s must be finite, not "),
    ("turn_on_bias", {"b0": [0, np.inf, 0]}, "must be finite"),
    ("angle_random_walk", {"N": -1.0}, "must not be below 0, not "),
    ("lag", {"wn": 10.0, "zeta": 3.0}, "must not be above 2, not 3.0 1"),
    ("misalignment", {"m": np.eye(3)}, "must have zeros on its diagonal"),
    ("turn_on_bias", {"b0": "a"}, "must be numbers of shape"),
    ("turn_on_bias", {"b0": [1.0, 2.0]}, "has shape"),
    ("turn_on_bias", {"bias": 1.0}, "has no parameter 'bias'; it has b0"),
    ("g_sensitivty", {}, "unknown effect 'g_sensitivty', did you mean g_sensitivity"),
    ("size_effect", {}, "does not belong to a gyro"),
]


@pytest.mark.parametrize("name, values, message", REFUSED)
def test_what_is_no_coefficient_makes_no_sensor(name, values, message):
    """What a part file must not say cannot be made in Python either."""
    with pytest.raises(UserError, match=message):
        Sensor("gyro", {name: values})


def test_there_are_two_kinds_of_sensors():
    with pytest.raises(UserError, match="unknown sensor 'gyros', did you mean gyro"):
        Sensor("gyros")


@every_effect
def test_coefficients_at_their_bounds_are_allowed(name, kind):
    for n, q in CATALOGUE[name].parameters.items():
        for bound in (q.minimum, q.maximum, q.start):
            if bound is not None and q.diagonal:
                sensor = Sensor(kind, {name: {n: np.full(q.shape, bound)}})
                np.testing.assert_array_equal(sensor.values[name][n], np.full(q.shape, bound))


BEYOND = [
    ("time_delay", {"td": 30.5 * H}, "gyro time_delay: td must not be above 30 sample periods"),
    *(
        (
            "bias_instability",
            {"B": 1e-3, "f_low": low, "f_high": high},
            "gyro bias_instability: f_high must lie 2 to 5 decades above f_low",
        )
        for low, high in ((1e-6, 1.0), (1e-3, 1e-2), (1.0, 1.0), (1.0, 0.1))
    ),
]


@pytest.mark.parametrize("name, values, message", BEYOND)
def test_what_coefficients_must_keep_together_makes_no_part(name, values, message):
    sensor = Sensor("gyro", {name: values})
    with pytest.raises(UserError, match=f"^part test: {message}$"):
        as_part(sensor)
    fine = as_part(Sensor("gyro", {name: {}}))
    p = sensor.p
    with pytest.raises(UserError, match=f"^block ImuSensor: {message}$"):
        fine.block.run(np.zeros((3, len(fine.block.inputs))), p=p)


@pytest.mark.parametrize(
    "name, values",
    [
        ("time_delay", {"td": 30 * H}),
        ("bias_instability", {"B": 1e-3, "f_low": 1e-3, "f_high": 0.1}),
        ("bias_instability", {"B": 1e-3, "f_low": 1e-4, "f_high": 10.0}),
    ],
)
def test_the_last_values_that_go_together_are_allowed(name, values):
    assert as_part(Sensor("gyro", {name: values})).gyro.acts(name)


def test_a_delay_that_fits_the_part_may_be_too_long_for_a_run():
    part = as_part(Sensor("gyro", {"time_delay": {"td": 30 * H}}))
    with pytest.raises(UserError, match="td must not be above 30 sample periods"):
        part.block.run(np.zeros((3, 7)), sample_period=0.9 * H)


@pytest.mark.parametrize("f_low, f_high", [(1.0, 1.0), (1.0, 0.1), (1e-9, 1.0)])
def test_flicker_of_a_band_that_is_none_is_still_a_number(f_low, f_high):
    """As a running unit may be given it: the band ends where flicker does."""
    sensor = Sensor("gyro", {"bias_instability": {"B": 1e-3, "f_low": f_low, "f_high": f_high}})
    nearest = f_low * np.clip(f_high / f_low, 1e2, 1e5)
    want = Sensor("gyro", {"bias_instability": {"B": 1e-3, "f_low": f_low, "f_high": nearest}})
    y, same = (run(s, motion(50), draws(s, 50)) for s in (sensor, want))
    assert np.isfinite(y).all()
    np.testing.assert_allclose(y, same, rtol=1e-12)


def defined(**arguments):
    """An attempt to define an effect whose arguments, after x, have these annotations."""

    def made_up(x, a):
        return x

    made_up.__annotations__ = arguments
    return effect(stage="bias", equation="y = x", source="made up", term="made up")(made_up)


@pytest.mark.parametrize(
    "annotation, message",
    [
        (Environment("qqq"), "effect made_up: unknown signal 'qqq'; known are rate, "),
        (
            Environment("temprature"),
            "effect made_up: unknown signal 'temprature', did you mean temperature",
        ),
        (Parameter("furlong"), "effect made_up: a: 'furlong' is not a unit"),
        (Parameter("{y}*mgaus"), "did you mean mgauss"),
        (State("deg/dy"), "effect made_up: a: 'deg/dy' is not a unit"),
    ],
)
def test_a_signal_or_a_unit_that_does_not_exist_makes_no_effect(annotation, message):
    with pytest.raises(UserError, match=message):
        defined(a=annotation)
    assert "made_up" not in CATALOGUE


def test_a_sensor_of_a_kind_that_does_not_exist_makes_no_effect():
    with pytest.raises(UserError, match="unknown sensor 'gyrro', did you mean gyro"):
        effect(
            stage="bias", equation="y = x", source="made up", term="made up", sensors=("gyrro",)
        )(lambda x: x)


def test_the_catalogue_is_there_whoever_asks_first():
    """In a fresh process, as this one has imported all of it."""
    code = (
        "from pyimu.model.sensor import Sensor, candidates; print(Sensor('gyro', {'scale_factor': "
        "{}}).p, len(candidates('gyro', ())))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["[0.", "0.", "0.]", str(len(candidates("gyro", ())))]


@pytest.mark.parametrize("kind", KINDS)
def test_compensation_undoes_the_whole_chain(kind):
    # So small that the slopes of all effects together stay near one: where they meet in a slope of
    # nothing, no chain can be undone.
    sensor, u = everything(kind, share=0.005), motion(150)
    sensor = sensor.without(*[e.name for e in sensor.effects if not e.invertible])
    x, _ = compensate(sensor, run(sensor, u), u)
    np.testing.assert_allclose(
        x, u[:, own(kind)], rtol=1e-12, atol=1e-12 * np.abs(u[:, own(kind)]).max()
    )


@pytest.fixture
def bent():
    """An effect that is quadratic in x and couples the axes, in the catalogue for one test."""

    @effect(stage="gain", equation="y = x + c x_j x_k", source="made up", term="made up")
    def bent_for_a_test(x, c: Parameter("1/({y})", description="made up")):
        return x + c * ca.vertcat(x[1] * x[2], x[2] * x[0], x[0] * x[1])

    add_effects(bent_for_a_test)
    yield bent_for_a_test
    CATALOGUE.remove("bent_for_a_test")


@pytest.mark.parametrize("kind", KINDS)
def test_compensation_of_a_nonlinear_effect_converges(bent, kind):
    sensor, u = excited(bent.name, kind, share=0.015), motion(150)
    x, _ = compensate(sensor, run(sensor, u), u)
    np.testing.assert_allclose(
        x, u[:, own(kind)], rtol=1e-12, atol=1e-12 * np.abs(u[:, own(kind)]).max()
    )


@every_effect
def test_saturated_samples_stay_marked_behind_the_effect(name, kind):
    """What the range of the sensor cut off is lost, whatever else its chain does."""
    if name == "quantization" or (CATALOGUE[name].lost and name != "saturation"):
        pytest.skip(
            "rounding moves the limit to the next step; what loses input marks samples of its own"
        )
    sensor, u = excited(name, kind, 0.01).without("saturation"), motion(100)
    limit = 0.6 * np.abs(run(sensor, u)).max(0)
    sensor = sensor.with_values("saturation", limit=limit)
    y = run(sensor, u)
    _, lost = compensate(sensor, y, u)
    np.testing.assert_array_equal(lost == 1, np.abs(y) >= limit)
    assert lost.any()


@pytest.mark.parametrize("kind", ("gyro", "accel"))
@pytest.mark.parametrize("steps", (37.0, 37.4, 37.5, 37.6))
def test_a_limit_is_seen_behind_rounding(kind, steps):
    """Where it is no multiple of the step, an output at the limit is less or more than that."""
    limit, step = 3.0, 3.0 / steps
    sensor = Sensor(kind, {}).with_values("saturation", limit=np.full(3, limit))
    sensor = sensor.with_values("quantization", q=np.full(3, step))
    u = np.zeros((401, N_INPUT))
    u[:, own(kind)] = x = np.linspace(-1.3 * limit, 1.3 * limit, 401)[:, None] * np.ones(3)
    y = run(sensor, u)
    _, lost = compensate(sensor, y, u)
    assert np.all(lost[np.abs(x) >= limit] == 1)
    assert np.all(lost[np.abs(x) < limit - step] == 0)
    np.testing.assert_array_equal(lost == 1, np.abs(y) >= sensor.clips_from - 1e-9)


@every_effect
def test_values_survive_the_part_file(name, kind, tmp_path: Path):
    made = as_part(excited(name, kind))
    read = load_part(save_part(made, tmp_path / "part.toml"))
    assert isinstance(read, Part) and read == made
    np.testing.assert_array_equal(read.sensor(kind).p, made.sensor(kind).p)


def test_names_of_coefficients_and_noise_are_unique():
    """Of a part with every effect that there is, and so of any with fewer."""
    block = as_part(everything("gyro"), everything("accel")).block
    names = [v.name for v in (*block.inputs, *block.parameters, *block.outputs)]
    assert len(set(names)) == len(names)
    assert len({c.number for c in block.noise}) == len(block.noise)
