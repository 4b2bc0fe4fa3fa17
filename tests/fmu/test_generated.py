"""The checked in texts of the reference blocks are those that today's definitions give, and the
FMUs made of them are right.
"""

import re
import shutil
from difflib import unified_diff
from itertools import islice

import casadi as ca
import numpy as np
import pytest
from built import built
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from fmu_toy import Unit

from pyimu.attitude import attitude_ukf
from pyimu.block.cost import operations
from pyimu.fmu import simulate, simulate_blocks
from pyimu.fmu.arrays import split_name
from pyimu.fmu.generate import digest, generate, generated_folder, reference_blocks
from pyimu.fmu.variables import most_samples
from pyimu.model.part_file import part

SHOWN = 40
"""Lines of a difference that a failure shows."""


# The texts


def comparable(text):
    """A text without casadi's patch level, which its C records, and without the token, which
    follows from all texts.
    """
    text = re.sub(r"\*patch = \d+;", "*patch = 0;", text)
    return re.sub(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", "{token}", text)


def minor_version(text):
    """The series of casadi, such as (3, 8), that wrote a C text."""
    return tuple(int(re.search(rf"\*{name} = (\d+);", text)[1]) for name in ("major", "minor"))


def texts_in(folder):
    files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    return {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in files}


def difference(name, old, new):
    lines = unified_diff(
        old.splitlines(),
        new.splitlines(),
        f"checked in/{name}",
        f"generated/{name}",
        n=1,
        lineterm="",
    )
    return list(islice(lines, SHOWN))


@pytest.fixture(scope="module")
def generated(tmp_path_factory):
    """The texts that today's definitions give; nobody may change them."""
    folder = tmp_path_factory.mktemp("generated")
    assert len(generate(folder)) == 12 * len(reference_blocks())
    return folder


def test_checked_in_texts_are_fresh(generated):
    have, want = texts_in(generated_folder()), texts_in(generated)
    assert have, "nothing is checked in: make generate"
    wrote, writes = (minor_version(t["ImuSensor/step.c"]) for t in (have, want))
    if wrote != writes:
        pytest.skip(
            f"the checked in C was written by casadi {wrote[0]}.{wrote[1]}, installed is "
            f"{ca.__version__}"
        )
    lines = []
    for name in sorted(have.keys() | want.keys(), key=lambda name: ".sha256" in name):
        lines += difference(name, comparable(have.get(name, "")), comparable(want.get(name, "")))
    assert not lines, (
        "fmu_src/generated is not what the definitions give; update it with `make generate`:\n"
        + "\n".join(lines[:SHOWN])
    )


def test_difference_is_shown_line_by_line():
    assert difference("step.c", "a\nb\n", "a\nc\n")[-2:] == ["-b", "+c"]
    version = "  *major = 3;\n  *minor = 8;\n  *patch = %d;\n"
    assert comparable(version % 2) == comparable(version % 11) and minor_version(version % 2) == (
        3,
        8,
    )
    token = '#define MODEL_TOKEN "{%s87dd89-e758-1d36-c337-8f79c8f8c443}"'
    assert comparable(token % "ac") == comparable(token % "0b") != comparable(token % "zz")


def test_only_what_changed_is_written(generated, tmp_path):
    """And told; what is generated no more goes, and all is as it was to the byte."""
    again = shutil.copytree(generated, tmp_path / "again")
    table, left_over = again / "ImuSensor" / "model_table.h", again / "ImuSensor" / "old.c"
    table.write_text("edited")
    left_over.write_text("")
    assert generate(again) == [table, left_over]
    of_first, of_again = (
        {p.relative_to(f): p.read_bytes() for p in f.rglob("*") if p.is_file()}
        for f in (generated, again)
    )
    assert of_again == of_first


def test_an_unreadable_text_is_checked_in_by_its_digest(generated):
    """Which follows from every line of it but casadi's patch level."""
    texts = texts_in(generated)
    assert re.fullmatch(r"[0-9a-f]{64}\n", texts["AttitudeUkf/step.c.sha256"])
    assert "AttitudeUkf/step.c" not in texts
    of = {"patch": "  *patch = 2;\n", "other patch": "  *patch = 11;\n", "number": "  a0=2;\n"}
    digests = {name: digest(f"int step;\n{line}") for name, line in of.items()}
    assert digests["patch"] == digests["other patch"] != digests["number"]


def test_what_can_be_tuned_during_a_run_acts_on_a_sample():
    """Else it would be fixed, as what acts on the start alone is; of a vector, one axis at least
    acts.
    """
    for block in reference_blocks():
        acts = set()
        for output in (0, 1):
            if block.step.numel_out(output) and block.parameters:
                _, columns = block.step.jac_sparsity(output, 2).get_triplet()
                acts |= {split_name(block.parameters[c].name)[0] for c in columns}
        assert {split_name(v.name)[0] for v in block.parameters if not v.fixed} <= acts, block.name


# The attitude filter as FMU


BLOCK = attitude_ukf(part("imt30"))
PERIOD = BLOCK.sample_period


def test_the_longest_step_of_every_unit_has_bounded_work():
    """Ten seconds of operations at most, whichever unit; and what any needs for its own drives."""
    for block in reference_blocks():
        most = most_samples(block)
        assert 2**15 <= most <= 2**24 and most * operations(block.step) <= 15e9, block.name


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    """Form to path of AttitudeUkf."""
    return built(BLOCK, tmp_path_factory)


@pytest.fixture(params=(2, 3), ids=("fmi2", "fmi3"))
def path(request, fmus):
    return fmus[request.param]


def rover(n=600):
    """Inputs (n, 18) of a drive: turns about z, bumps, warming up, a heading now and then and late,
    rests that are called so, a magnetometer that is slower and is disturbed in the end.
    """
    rng, time = np.random.default_rng(7), PERIOD * np.arange(n)
    moves = (time % 0.2 > 0.05)[:, None]
    gyro = moves * np.column_stack(
        [0.02 * np.sin(31 * time), 0.03 * np.cos(17 * time), 0.4 + 0.2 * np.sin(5 * time)]
    )
    accel = [0.1, -0.3, 9.79] + moves * rng.normal(0, 2, (n, 3))
    valid = rng.random(n) < 0.1
    return np.column_stack(
        [
            gyro + rng.normal(0, 2e-3, (n, 3)),
            accel,
            20 + 5 * time,
            0.4 * time + rng.normal(0, 0.03, n),
            np.full(n, 9e-4),
            valid,
            PERIOD * rng.integers(0, 100, n),
            ~moves,
            0.3 + 0.1 * np.sin(3 * time),
            np.full(n, 1e-2),
            np.arange(n) % 7 < 2 * (np.arange(n) < n // 2),
            _field(rng, n),
        ]
    )


def _field(rng, n):
    """A horizontal field (n, 3) that turns, of which each sample is held for four rows."""
    angle = 0.4 * PERIOD * np.arange(n) // 4 * 4
    field = np.column_stack([2e-5 * np.sin(angle), 2e-5 * np.cos(angle), np.full(n, -4e-5)])
    field[-n // 5 :, 0] += 3e-5
    return np.repeat((field + rng.normal(0, 5e-7, (n, 3)))[::4], 4, axis=0)[:n]


def array(name, count):
    return [f"{name}[{i + 1}]" for i in range(count)]


def test_variables_are_named_as_agreed(path):
    causes = {}
    for v in read_model_description(str(path)).modelVariables:
        causes.setdefault(v.causality, []).append(v.name)
    assert causes["input"] == [
        *array("gyro", 3),
        *array("accel", 3),
        "temperature",
        "heading",
        "heading_variance",
        "heading_valid",
        "heading_age",
        "stationary",
        "speed",
        "speed_variance",
        "speed_valid",
        *array("mag", 3),
    ]
    assert causes["output"] == [
        *array("q", 4),
        "roll",
        "pitch",
        "yaw",
        *array("gyro_bias", 3),
        *array("std", 6),
        "quasi_static",
        "nis",
        "status",
        "heading_std",
        "at_rest",
    ]
    assert {
        "latitude",
        *array("q0", 4),
        *array("bias0", 3),
        *array("std0", 6),
        "sample_period",
        "gyro_error.angle_random_walk.N[1]",
    } <= set(causes["parameter"])


def test_units_and_kinds_are_as_agreed(path):
    of = {v.name: v for v in read_model_description(str(path)).modelVariables}
    units = {
        "heading": "rad",
        "heading_variance": "rad^2",
        "heading_age": "s",
        "latitude": "rad",
        "q[1]": "1",
        "yaw": "rad",
        "gyro_bias[1]": "rad/s",
        "std[3]": "rad",
        "std[4]": "rad/s",
        "std0[3]": "rad",
        "std0[4]": "rad/s",
        "gyro[1]": "rad/s",
        "accel[1]": "m/s^2",
        "temperature": "degC",
        "mag[1]": "T",
        "field_noise": "T*sqrt(s)",
    }
    assert {name: of[name].unit for name in units} == units
    assert [of[n].type for n in ("heading_valid", "stationary", "quasi_static")] == ["Boolean"] * 3
    assert of["status"].type in ("Integer", "Int32")


def test_fmpy_finds_nothing_wrong(path):
    assert validate_fmu(str(path)) == []


def test_filter_gives_the_bits_of_python(path):
    u = rover()
    y = simulate(path, u, sample_period=PERIOD)
    want, _ = BLOCK.run(u)
    np.testing.assert_array_equal(y[1:], want)
    names = [v.name for v in BLOCK.outputs]
    assert (
        0 < want[:, names.index("quasi_static")].mean() < 1
        and np.ptp(want[:, names.index("yaw")]) > 0.1
    )


def test_start_values_are_heeded(path):
    given = {"q0[1]": 0.6, "q0[4]": 0.8, "bias0[2]": 0.01, "std0[6]": 1e-3, "latitude": 0.9}
    u = rover(100)
    p = np.array([given.get(v.name, v.start) for v in BLOCK.parameters])
    y = simulate(path, u, sample_period=PERIOD, start_values=given)
    np.testing.assert_array_equal(y[1:], BLOCK.run(u, p=p)[0])
    np.testing.assert_allclose(y[0, [0, 3, 8]], [0.6, 0.8, 0.01], rtol=1e-15)


def test_missing_inputs_give_the_bits_of_python(path):
    """NaN and infinity, sample by sample: a master that interpolates would carry them on to the
    next sample.
    """
    u = rover(300)
    for rows, column, value in (
        (slice(50, 60), 0, np.nan),
        (slice(80, 81), 4, np.inf),
        (slice(100, 105), slice(0, 7), np.nan),
        (slice(150, 200), 7, np.nan),
        (slice(210, 220), 8, -np.inf),
    ):
        u[rows, column] = value
    with Unit(path).start() as unit:
        y = unit.run(u, period=PERIOD)
    want, _ = BLOCK.run(u)
    np.testing.assert_array_equal(y, want)
    status = want[:, [v.name for v in BLOCK.outputs].index("status")]
    assert np.isfinite(want).all() and (status.astype(int) & 1).any()


# In blocks


def test_fmpy_finds_nothing_wrong_with_the_block_form(fmus):
    assert validate_fmu(str(fmus["block"])) == []


def test_arrays_of_the_block_form(fmus):
    """``std`` and ``std0`` are angles and rates, which no FMI array can be at once."""
    shapes = {v.name: v.shape for v in read_model_description(str(fmus["block"])).modelVariables}
    size = round(1 / PERIOD)
    assert (
        shapes["gyro"] == (size, 3)
        and shapes["q"] == (size, 4)
        and shapes["stationary"] == shapes["std[4]"] == (size,)
    )
    assert (
        shapes["q0"] == (4,)
        and shapes["std0[6]"] == ()
        and shapes["gyro_error.angle_random_walk.N"] == (3,)
    )


def test_blocks_of_the_filter_give_the_bits_of_its_samples(fmus):
    u = rover(700)
    given = {"q0[1]": 0.6, "q0[4]": 0.8, "std0[6]": 1e-3}
    y = simulate_blocks(fmus["block"], u, start_values=given, block_size=300)
    np.testing.assert_array_equal(y, simulate(fmus[3], u, sample_period=PERIOD, start_values=given))
