"""Units of specimens: what tolerances name are parameters, which start at what was drawn."""

import numpy as np
import pytest
from built import built
from fmpy import read_model_description

from pyimu.fmu import package, simulate, simulate_blocks
from pyimu.model.part_file import part
from pyimu.model.simulate import simulate as simulate_in_python

PART, SEED, N = "mpu6050", 7, 400
FORMS = (2, 3, "block")


@pytest.fixture(scope="module")
def motion():
    """Rate, specific force and temperature (N, 7), moving on all axes while it warms up."""
    t = np.arange(N) / part(PART).sample_rate
    waves = [np.sin((3 + i) * t) for i in range(6)]
    waves[5] += 9.80665
    return np.column_stack([*waves, 25 + 100 * t])


def through(fmu, form, u, **start_values):
    run = simulate_blocks if form == "block" else simulate
    period = part(PART).sample_period
    return run(fmu, u, sample_period=period, start_values=start_values)[1:]


def in_python(made, u, seed):
    measured = simulate_in_python(made, u[:, :3], u[:, 3:6], u[:, 6], seed=seed)
    return np.column_stack([*measured, u[:, 6]])


@pytest.fixture(scope="module")
def of_the_part(tmp_path_factory):
    return built(part(PART).nominal.block, tmp_path_factory)


@pytest.fixture(scope="module")
def of_a_specimen(tmp_path_factory):
    """By the command's own function; the sensor alone, for the filter takes a minute."""
    out = tmp_path_factory.mktemp("specimen")
    paths = package.build(PART, out, ("sensor",), specimen=SEED)
    return dict(zip(FORMS, paths, strict=True))


def starts(fmu):
    """Start value of each coefficient by the name of the scalar; the block form has arrays."""
    found = {}
    for v in read_model_description(str(fmu), validate=False).modelVariables:
        if "_error." in v.name:
            shape = [int(d.start) for d in v.dimensions or ()]
            values = np.array(v.start.split(), dtype=float)  # one number stands for all
            values = values.reshape(shape) if values.size > 1 else np.full(shape, values[0])
            for index, value in np.ndenumerate(values):
                suffix = f"[{','.join(str(i + 1) for i in index)}]" if index else ""
                found[f"{v.name}{suffix}"] = value
    return found


def names(t):
    """The scalars of a tolerance's coefficient."""
    kind, effect, parameter = t.key
    return [
        f"{kind}_error.{effect}.{parameter}[{','.join(str(i + 1) for i in index)}]"
        for index in t.parameter.indices
    ]


TOLERATED = [name for t in part(PART).tolerances for name in names(t)]


@pytest.mark.parametrize("form", FORMS)
def test_the_unit_of_a_part_has_the_coefficients_of_its_tolerances_at_their_identity(
    of_the_part, form
):
    start = starts(of_the_part[form])
    assert {start[name] for name in TOLERATED} == {0.0}


@pytest.mark.parametrize("form", FORMS)
def test_the_unit_of_a_part_gives_the_bits_of_the_part_without_those_effects(
    of_the_part, form, motion
):
    np.testing.assert_array_equal(
        through(of_the_part[form], form, motion, seed=3), in_python(part(PART), motion, 3)
    )


@pytest.mark.parametrize("form", FORMS)
def test_the_unit_of_a_specimen_starts_at_what_was_drawn(of_a_specimen, form):
    about = read_model_description(str(of_a_specimen[form]), validate=False)
    assert about.description.startswith(f"{part(PART).description}, specimen {SEED}")
    start, made = starts(of_a_specimen[form]), part(PART).specimen(SEED)
    for sensor in (made.gyro, made.accel):
        for slot, value in zip(sensor.slots, sensor.p, strict=True):
            assert start[f"{sensor.kind}_error.{slot.name}"] == value
    drawn = {start[name] for name in TOLERATED}
    assert 0.0 not in drawn and len(drawn) == len(TOLERATED)


@pytest.mark.parametrize("form", FORMS)
def test_the_unit_of_a_specimen_gives_the_bits_of_its_simulation(of_a_specimen, form, motion):
    have = through(of_a_specimen[form], form, motion, seed=3)
    np.testing.assert_array_equal(have, in_python(part(PART).specimen(SEED), motion, 3))
    assert np.abs(have - in_python(part(PART), motion, 3)).max() > 0.05


def test_a_specimen_set_by_hand_is_the_same_specimen(of_the_part, motion):
    """The part's own unit with the drawn values as parameters, as a campaign sets them."""
    made = part(PART).specimen(SEED)
    np.testing.assert_array_equal(
        through(of_the_part["block"], "block", motion, seed=3, **made.start_values),
        in_python(made, motion, 3),
    )


def test_the_filter_beside_a_specimen_knows_the_data_sheet_alone(monkeypatch, tmp_path):
    asked = {}
    blocks = {name: lambda p, name=name: asked.setdefault(name, p) for name in ("sensor", "ukf")}
    monkeypatch.setattr(package, "BLOCKS", blocks)
    monkeypatch.setattr(package, "build_fmus", lambda *_: [])
    package.build(PART, tmp_path, specimen=SEED)
    assert asked == {"sensor": part(PART).specimen(SEED), "ukf": part(PART)}


def test_a_specimen_of_a_part_without_tolerances_is_one_line(pyimu, tmp_path):
    code, out, err = pyimu("build", "imt30", "--specimen", 1, "--out", "fmus")
    assert (code, out, err.count("\n")) == (2, "", 1) and "imt30 has no tolerances" in err
    assert not (tmp_path / "fmus").exists()


def test_a_seed_that_is_none_is_one_line(pyimu):
    code, out, err = pyimu("build", PART, "--specimen", -1)
    assert (code, out, err.count("\n")) == (2, "", 1) and "seed -1 is not an integer" in err


def test_the_command_builds_a_specimen(pyimu, tmp_path):
    code, out, _ = pyimu(
        "build", PART, "--specimen", SEED, "--fmu", "sensor", "--fmi", "2", "--out", "fmus"
    )
    assert code == 0 and out.splitlines() == ["fmus/ImuSensor.fmi2.fmu"]
    about = read_model_description(str(tmp_path / "fmus" / "ImuSensor.fmi2.fmu"), validate=False)
    start = {v.name: v.start for v in about.modelVariables}
    want = part(PART).specimen(SEED).gyro.values["turn_on_bias"]["b0"][0]
    assert float(start["gyro_error.turn_on_bias.b0[1]"]) == want
