"""The FMU of a sensor is the Python simulation of that sensor, bit for bit, whatever effects it
has.
"""

import numpy as np
import pytest
from built import built
from catalogue_cases import H, as_part, everything, inputs, motion
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from fmu_toy import Unit

from pyimu.fmu import build, simulate, simulate_blocks
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part_file import part
from pyimu.model.signals import COLUMNS, inputs_for
from pyimu.model.simulate import simulate as simulate_in_python
from pyimu.units import STANDARD_GRAVITY

N = 600
VERSIONS = (2, 3)
FORMS = (*VERSIONS, "block")


@pytest.fixture(scope="module")
def full():
    """A part with every effect of the catalogue at values that matter, no matrix symmetric."""
    made = as_part(everything("gyro"), everything("accel"))
    assert {e.name for s in (made.gyro, made.accel) for e in s.effects} == set(CATALOGUE)
    return made


@pytest.fixture(scope="module")
def fmus(full, tmp_path_factory):
    return built(full.block, tmp_path_factory)


def through(fmus, form, u, **start_values):
    """Outputs (n + 1, 7) of an FMU in any of its forms."""
    run = simulate_blocks if form == "block" else simulate
    return run(fmus[form], u, sample_period=H, start_values=start_values)


def in_python(part_, u, seed):
    """Outputs (n, 7) of a part on all signals (n, N_INPUT), through the array form of the
    simulation.
    """
    given = {name: u[:, COLUMNS[name]].squeeze() for name in inputs_for(part_.signals)}
    measured = simulate_in_python(
        part_,
        given.pop("rate"),
        given.pop("specific_force"),
        temperature := given.pop("temperature"),
        seed=seed,
        **given,
    )
    return np.column_stack([*measured, temperature])


def silent(part_):
    """Start values that switch the noise off: the FMU always draws, so its stochastic coefficients
    are zero.
    """
    return {
        f"{s.kind}_error.{slot.name}": 0.0
        for s in (part_.gyro, part_.accel)
        for slot in s.slots
        if CATALOGUE[slot.effect].stochastic and not slot.definition.form
    }


def without_noise(part_):
    for sensor in (part_.gyro, part_.accel):
        part_ = part_.with_sensor(sensor.without(*[e.name for e in sensor.effects if e.stochastic]))
    return part_


@pytest.mark.parametrize("form", FORMS)
def test_before_the_first_sample_it_shows_the_ideal_measurement_of_the_start_inputs(
    full, fmus, form
):
    """Without any of the part's errors; of start values that means at rest and level."""
    u = motion(1)
    _, y = full.block.initial(inputs(u, full)[0], full.block.start)
    np.testing.assert_array_equal(np.array(y).ravel(), u[0, :7])
    np.testing.assert_array_equal(through(fmus, form, inputs(u, full))[0], u[0, :7])
    with Unit(fmus[form]) as unit:
        assert unit.outputs() == [0, 0, 0, 0, 0, STANDARD_GRAVITY, 25]
        unit.set("specific_force[2]", 1.5)
        unit.start(**{"rate[3]": 0.25})
        assert unit.outputs() == [0, 0, 0.25, 0, 1.5, STANDARD_GRAVITY, 25]


@pytest.mark.parametrize("version", VERSIONS)
def test_noise_off_the_fmu_gives_the_bits_of_python(full, fmus, version):
    u = motion(N)
    want = in_python(without_noise(full), u, None)
    assert np.abs(want - u[:, :7]).max() > 0.1
    y = simulate(fmus[version], inputs(u, full), sample_period=H, start_values=silent(full))
    np.testing.assert_array_equal(y[1:], want)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("seed", [0, 12345])
def test_the_same_seed_gives_the_same_bits(full, fmus, form, seed):
    u = motion(N)
    y = through(fmus, form, inputs(u, full), seed=seed)
    np.testing.assert_array_equal(y[1:], in_python(full, u, seed))


def test_missing_inputs_are_as_missing_as_in_python(full, fmus):
    """To the bit what Python makes of them, with every effect at work; and once they are there
    again, it is over.
    """
    u, rng = motion(300), np.random.default_rng(7)
    rows = rng.choice(np.arange(200), 12, replace=False)
    u[rows, rng.integers(0, 7, len(rows))] = np.nan
    y = simulate_blocks(fmus["block"], inputs(u, full), sample_period=H, start_values={"seed": 3})[
        1:
    ]
    np.testing.assert_array_equal(y, in_python(full, u, 3))
    assert np.isnan(y[rows]).any(axis=1).all() and np.isfinite(y[202:]).all()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_matrix_stands_in_the_fmu_row_by_row(full, fmus, version):
    """G[1,2] alone: the x axis of the gyro answers to the y axis of the force, and nothing else
    moves.
    """
    values = {v.name: v.start for v in without_effects(full)} | {
        "gyro_error.g_sensitivity.G[1,2]": 0.01
    }
    u = motion(20)
    y = simulate(fmus[version], inputs(u, full), sample_period=H, start_values=values)[1:]
    want = u[:, :7].copy()
    want[:, 0] += 0.01 * u[:, 4]
    np.testing.assert_allclose(y, want, rtol=1e-14, atol=1e-14)


def without_effects(part_):
    """The parameters of the part's block at the identity."""
    for sensor in (part_.gyro, part_.accel):
        part_ = part_.with_sensor(type(sensor)(sensor.kind, {e.name: {} for e in sensor.effects}))
    return part_.block.parameters


@pytest.mark.parametrize("version", VERSIONS)
def test_serialized_restored_and_continued_equals_never_stopped(full, fmus, version):
    """Another instance takes over half way, with every effect and all noise at work; one in between
    is not disturbed.
    """
    u, half = inputs(motion(200), full), 100
    whole = simulate(fmus[version], u, sample_period=H, start_values={"seed": 3})[1:]
    with Unit(fmus[version]) as first, Unit(fmus[version]) as second, Unit(fmus[version]) as other:
        first.start(sample_period=H, seed=3), other.start(sample_period=H, seed=4)
        begun = first.run(u[:half], period=H)
        other.run(u[:37], period=H)
        state = first.save()
        data = first.to_bytes(state)
        second.start(sample_period=H, seed=9)
        second.restore(second.from_bytes(data))
        other.run(u[37:60], first=37, period=H)
        continued = second.run(u[half:], first=half, period=H)
        again = first.run(u[half:], first=half, period=H)
    np.testing.assert_array_equal(np.vstack([begun, continued]), whole)
    np.testing.assert_array_equal(again, continued)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    "values, message",
    [
        (
            {"gyro_error.time_delay.td": 30.5 * H},
            "gyro time_delay: td must not be above 30 sample periods",
        ),
        (
            {"accel_error.bias_instability.f_high": 1e4},
            "accel bias_instability: f_high must lie 2 to 5",
        ),
    ],
)
def test_parameters_that_do_not_go_together_end_the_initialization(fmus, form, values, message):
    """With a line in the log, as the Python of the same part refuses them."""
    with Unit(fmus[form]) as unit:
        with pytest.raises(FMICallException, match="ExitInitializationMode"):
            unit.start(sample_period=H, **values)
        assert [
            text
            for category, text in unit.messages
            if category == "logStatusError" and message in text
        ]


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_set_in_a_run_that_do_not_go_together_end_the_step(full, fmus, version):
    """A delay beyond what is remembered is not cut short in silence; set right again, the unit goes
    on as if nothing had been.
    """
    name, right = "gyro_error.time_delay.td", 20.5 * H
    u = inputs(motion(40), full)
    with Unit(fmus[version]) as unit, Unit(fmus[version]) as undisturbed:
        for each in (unit, undisturbed):
            each.start(sample_period=H, seed=3)
            each.run(u[:20], period=H)
        unit.set(name, 30.5 * H)
        with pytest.raises(FMICallException, match="DoStep"):
            unit.run(u[20:], first=20, period=H)
        # The logger of an FMI 2 unit in fmpy is that of the unit that was made last.
        told = [text for _, text in (*unit.messages, *undisturbed.messages)]
        assert any("td must not be above 30 sample periods" in text for text in told), told
        unit.set(name, right), undisturbed.set(name, right)
        np.testing.assert_array_equal(
            unit.run(u[20:], first=20, period=H), undisturbed.run(u[20:], first=20, period=H)
        )


@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_finds_nothing_wrong_with_the_full_sensor(fmus, version):
    assert validate_fmu(str(fmus[version])) == []


@pytest.mark.parametrize("name", ("imt30", "stim300", "mpu6050"))
def test_fmpy_finds_nothing_wrong_with_built_in_parts(name, tmp_path, monkeypatch):
    """It looks at the description alone, so that the libraries may be empty."""
    monkeypatch.setattr(build, "_compile", lambda *_: dict.fromkeys(VERSIONS, b""))
    for path in build.build_fmus(part(name).block, tmp_path, VERSIONS):
        assert validate_fmu(str(path)) == []
