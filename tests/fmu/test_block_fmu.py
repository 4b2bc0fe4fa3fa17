"""The block form of an FMU: the samples of the scalar forms, bit for bit, in arrays of any number
of rows.
"""

import subprocess
import sys

import casadi as ca
import numpy as np
import pytest
from built import built
from fmpy import read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from fmu_toy import CHANNELS, Unit, drive, toy
from hypothesis import given, settings
from hypothesis import strategies as st

from pyimu.block.block import Block
from pyimu.block.normals import normals
from pyimu.block.variables import Variable
from pyimu.fmu import build_fmus, simulate, simulate_blocks, stream_blocks, texts
from pyimu.fmu.arrays import description, grouped, split_name
from pyimu.fmu.sources import DESCRIPTION
from pyimu.model.part import Sensor
from pyimu.model.part_file import part

BLOCK = toy()
PERIOD = BLOCK.sample_period
SILENT = {"noise.N": 0.0, "noise.K": 0.0}
ROWS = 8


@pytest.fixture(scope="module")
def toys(tmp_path_factory):
    """Scalar and block form of the toy."""
    fmus = built(BLOCK, tmp_path_factory)
    return [fmus[form] for form in (3, "block")]


@pytest.fixture
def path(toys):
    return toys[1]


def truth(inputs, seed=0, first=1, state=None):
    return BLOCK.run(inputs, w=normals(seed, CHANNELS, first, len(inputs)), state=state)[0]


def in_blocks(unit, inputs, first=0):
    """Outputs (n, 4) of an initialized unit, a step for every ``unit.rows`` rows of inputs from
    sample ``first`` on.
    """
    outputs = []
    for k in range(0, len(inputs), unit.rows):
        rows = inputs[k : k + unit.rows]
        outputs.append(one_step(unit, rows, first + k)[: len(rows)])
    return np.vstack(outputs)


def one_step(unit, rows, first=0):
    """All rows of the outputs (unit.rows, 4) after a step over these rows of inputs."""
    names = ("rate", "temperature", "counting", "gear")
    filled = np.zeros((unit.rows, 4))
    filled[: len(rows)] = rows
    for name, column in zip(names, filled.T):
        unit.set_array(name, column if name in names[:2] else column.astype(int))
    unit.step(first * PERIOD, len(rows) * PERIOD)
    return np.column_stack([unit.get_array(name) for name in ("y[1]", "y[2]", "positive", "ticks")])


def refused(unit, call, *words):
    """The call gives an error, and one message in the error category that holds all of
    ``words``.
    """
    unit.messages.clear()
    with pytest.raises(FMICallException):
        call()
    errors = [text for category, text in unit.messages if category == "logStatusError"]
    assert len(errors) == 1 and all(word in errors[0] for word in words), (unit.messages, words)


# Samples


@pytest.mark.parametrize("start", (SILENT, {"seed": 12345}), ids=("noise off", "noise on"))
@pytest.mark.parametrize("size", (1, 7, 976, 5000))
def test_blocks_give_the_bits_of_single_samples(toys, size, start):
    """2000 is a multiple of none but 1: the last block is shorter."""
    scalar, block = toys
    inputs = drive(2000)
    want = simulate(scalar, inputs, sample_period=PERIOD, start_values=start)
    np.testing.assert_array_equal(
        simulate_blocks(block, inputs, block_size=size, start_values=start), want
    )


@settings(max_examples=40, deadline=None)
@given(
    lengths=st.lists(st.integers(0, 3 * ROWS), min_size=1, max_size=12),
    size=st.integers(1, 2 * ROWS),
)
def test_samples_do_not_depend_on_blocks_and_chunks(toys, lengths, size):
    inputs = drive(sum(lengths))
    chunks = np.split(inputs, np.cumsum(lengths)[:-1])
    answers = list(stream_blocks(toys[1], chunks, block_size=size, start_values={"seed": 3}))
    assert [len(a) for a in answers] == lengths
    np.testing.assert_array_equal(np.vstack(answers), truth(inputs, 3))


def test_noise_is_drawn_across_many_pieces(path):
    """A block of more samples than are drawn at a time, from a sample that is no multiple of
    four.
    """
    inputs = drive(500)
    outputs = simulate_blocks(path, inputs, start_time=3 * PERIOD, start_values={"seed": 2**64 - 3})
    np.testing.assert_array_equal(outputs[1:], truth(inputs, 2**64 - 3, first=4))


def test_rows_that_a_short_step_leaves_over_repeat_its_last_sample(path):
    inputs = drive(20)
    with Unit(path, rows=ROWS).start(seed=1) as unit:
        for first, n in ((0, ROWS), (ROWS, 3), (ROWS + 3, 1)):
            outputs = one_step(unit, inputs[first : first + n], first)
            want = truth(inputs, 1)[first : first + n]
            np.testing.assert_array_equal(outputs, np.vstack([want, *[want[-1:]] * (ROWS - n)]))


def test_a_step_without_a_sample_repeats_the_last_one(path):
    with Unit(path, rows=ROWS).start(sample_period=1.0) as unit:
        unit.step(0.0, 3.0)
        last = unit.get_array("y[1]")[2]
        unit.step(3.0, 0.5)
        assert (unit.get_array("y[1]") == last).all() and unit.get("ticks") == 3


def test_every_row_is_the_start_value_before_the_first_sample(path):
    with Unit(path, rows=ROWS) as unit:
        unit.set("M[1,2]", 3.0)
        unit.set("M[2,1]", -1.5)
        np.testing.assert_array_equal(unit.get_array("y[2]"), np.full(ROWS, 4.5))


def test_inputs_stay_as_they_were_set(path):
    """What is not set again is taken again, row by row."""
    inputs = drive(ROWS)
    with Unit(path, rows=ROWS).start(seed=1) as unit:
        one_step(unit, inputs)
        unit.step(ROWS * PERIOD, ROWS * PERIOD)
        twice = np.vstack([inputs, inputs])
        np.testing.assert_array_equal(unit.get_array("y[1]"), truth(twice, 1)[ROWS:, 0])


def test_a_tuned_matrix_acts_from_the_next_block(path):
    inputs = drive(2 * ROWS)
    with Unit(path, rows=ROWS).start() as unit:
        before = one_step(unit, inputs[:ROWS])
        unit.set_array("M", [[1.0, 2.0], [3.0, 4.0]])
        after = one_step(unit, inputs[ROWS:], ROWS)
    y, state = BLOCK.run(inputs[:ROWS], w=normals(0, CHANNELS, 1, ROWS))
    p = np.array([1.0, 2.0, 3.0, 4.0, *BLOCK.start[4:]])
    tuned, _ = BLOCK.run(inputs[ROWS:], p=p, w=normals(0, CHANNELS, ROWS + 1, ROWS), state=state)
    np.testing.assert_array_equal(np.vstack([before, after]), np.vstack([y, tuned]))


# The order of arrays


def test_matrix_goes_row_by_row(toys):
    """A matrix without symmetry, given whole, and element by element to the scalar form."""
    matrix = np.array([[0.5, 5.0], [7.0, -2.0]])
    elements = {f"M[{i + 1},{j + 1}]": m for (i, j), m in np.ndenumerate(matrix)}
    inputs = drive(50)
    want = simulate(toys[0], inputs, sample_period=PERIOD, start_values=elements)
    np.testing.assert_array_equal(
        simulate_blocks(toys[1], inputs, start_values={"M": matrix}), want
    )
    np.testing.assert_array_equal(simulate_blocks(toys[1], inputs, start_values=elements), want)
    assert not np.array_equal(simulate_blocks(toys[1], inputs, start_values={"M": matrix.T}), want)


def test_one_element_leaves_the_others_at_their_start(path):
    with Unit(path) as unit:
        assert unit.get_array("M").tolist() == [[1.0, 0.25], [-0.5, 2.0]]
        unit.set("M[2,1]", 9.0)
        assert unit.get_array("M").tolist() == [[1.0, 0.25], [9.0, 2.0]]


def vectors():
    """A block whose input is a vector, and whose outputs are that vector and twice it."""
    u, p, none = ca.SX.sym("u", 3), ca.SX.sym("p", 0), ca.SX.sym("w", 0)
    step = ca.Function(
        "step",
        [ca.SX.sym("s", 0), u, p, none, ca.SX.sym("h")],
        [ca.SX.zeros(0), ca.vertcat(u, 2 * u)],
    )
    initial = ca.Function("initial", [u, p], [ca.SX.zeros(0), ca.SX.zeros(6)])
    names = [
        tuple(Variable(f"{n}[{i + 1}]", start=start) for i, start in enumerate((0.0, -1.0, 9.5)))
        for n in ("u", "y", "z")
    ]
    return Block("Vectors", "", step, initial, names[0], (), names[1] + names[2], (), 0.125)


def test_a_vector_of_a_block_goes_sample_by_sample(tmp_path_factory):
    """Three samples of three: what FMI passes is the first sample's vector, then the second's."""
    inputs = np.arange(9.0).reshape(3, 3)
    with Unit(built(vectors(), tmp_path_factory)["block"], rows=3).start() as unit:
        v = unit.variables
        unit.fmu.setFloat64([v["u"].valueReference], list(range(9)))
        unit.step(0.0, 3 * 0.125)
        both = unit.fmu.getFloat64([v["z"].valueReference, v["y"].valueReference], nValues=18)
    np.testing.assert_array_equal(np.reshape(both, (2, 3, 3)), [2 * inputs, inputs])


def test_a_vector_starts_in_every_row(tmp_path_factory):
    fmu = built(vectors(), tmp_path_factory)["block"]
    assert validate_fmu(str(fmu)) == []
    u = {v.name: v for v in read_model_description(str(fmu)).modelVariables}["u"]
    assert u.shape == (8, 3)
    np.testing.assert_array_equal(
        np.reshape(list(map(float, u.start.split())), u.shape), [[0.0, -1.0, 9.5]] * 8
    )
    for rows in (1, 8, 11):
        with Unit(fmu, rows=rows) as unit:
            np.testing.assert_array_equal(unit.get_array("u"), [[0.0, -1.0, 9.5]] * rows)


# Scalars to arrays


def names_and_shapes(*variables):
    return [
        (a.name, a.shape)
        for a in grouped([v if isinstance(v, Variable) else Variable(v) for v in variables])
    ]


def test_whole_arrays_are_grouped():
    matrix = [f"a.G[{i},{j}]" for i in (1, 2) for j in (1, 2, 3)]
    assert names_and_shapes("x", *matrix, "v[1]", "v[2]", "w[1]") == [
        ("x", ()),
        ("a.G", (2, 3)),
        ("v", (2,)),
        ("w", (1,)),
    ]


@pytest.mark.parametrize(
    "names",
    (
        ["m[1,2]", "m[2,1]"],
        ["v[2]", "v[1]"],
        ["v[1]", "v[3]"],
        ["v[0]", "v[1]"],
        ["v[1]", "v[2,1]"],
        ["G[1,1]", "G[2,1]", "G[1,2]", "G[2,2]"],
        ["v[1]", "x", "v[2]"],
        ["v[2]"],
    ),
)
def test_what_is_no_whole_array_stays_as_it_is(names):
    """Gaps, columns first, counting from zero, other variables in between."""
    found = names_and_shapes(*names)
    assert [name for name, _ in found] == names or found == [("v", (1,)), ("x", ()), ("v[2]", ())]


@pytest.mark.parametrize("other", ({"unit": "s"}, {"kind": "boolean"}, {"minimum": 0.0}))
def test_elements_of_several_kinds_stay_apart(other):
    assert names_and_shapes(Variable("v[1]"), Variable("v[2]", **other)) == [
        ("v[1]", ()),
        ("v[2]", ()),
    ]


def test_description_of_an_array_is_what_its_elements_share():
    (array,) = grouped(
        [
            Variable(f"v[{i + 1}]", description=f"rate, body axes, axis {a}")
            for i, a in enumerate("xyz")
        ]
    )
    assert description(array) == "rate, body axes"
    assert description(grouped([Variable("x", description="a, b")])[0]) == "a, b"


def test_names_are_split():
    assert split_name("a[2].G[1,12]") == ("a[2].G", (1, 12)) and split_name("a[2].G") == (
        "a[2].G",
        (),
    )


# The model description


def test_dimensions(path):
    of = {v.name: v for v in read_model_description(str(path)).modelVariables}
    size = of["block_size"]
    assert (size.type, size.causality, size.variability, size.start) == (
        "UInt64",
        "structuralParameter",
        "fixed",
        "976",
    )
    for name in ("rate", "counting", "y[2]", "ticks"):
        (rows,) = of[name].dimensions
        assert rows.start is None and rows.variable is size and of[name].shape == (976,)
    assert [d.start for d in of["M"].dimensions] == [2, 2] and of["M"].start == "1.0 0.25 -0.5 2.0"
    assert not of["noise.N"].dimensions and not of["seed"].dimensions


def test_model_structure_names_whole_arrays(path):
    model = read_model_description(str(path))
    assert {u.variable.name: [v.name for v in u.dependencies] for u in model.outputs} == {
        v.name: [] for v in BLOCK.outputs
    }
    assert {u.variable.name: [v.name for v in u.dependencies] for u in model.initialUnknowns} == {
        "y[1]": ["b0"],
        "y[2]": ["temperature", "M"],
        "positive": ["b0"],
        "ticks": [],
    }
    assert float(model.defaultExperiment.stepSize) == 976 * PERIOD


@pytest.mark.parametrize("period, size", ((0.01, 100), (3.0, 1), (1e-9, 2**15)))
def test_a_block_is_a_second_unless_set(tmp_path, period, size):
    description = tmp_path / "modelDescription.xml"
    description.write_text(texts(toy(sample_period=period))[DESCRIPTION["block"]])
    model = read_model_description(str(description))
    assert [v.start for v in model.modelVariables if v.name == "block_size"] == [str(size)]


def test_fmpy_shows_it(path):
    done = subprocess.run(
        [sys.executable, "-m", "fmpy", "info", str(path)],
        capture_output=True,
        text=True,
        check=True,
    )
    assert "FMI Version" in done.stdout and "rate" in done.stdout


def test_fmpy_simulates_it(path):
    """Without a word about blocks: a step of the default experiment is a block at its own size, its
    inputs at their start.
    """
    result = simulate_fmu(
        str(path),
        stop_time=3 * 976 * PERIOD,
        output_interval=976 * PERIOD,
        start_values={"M": [1, 2, 3, 4]},
    )
    p = np.array([1.0, 2.0, 3.0, 4.0, *BLOCK.start[4:]])
    inputs = np.tile([v.start for v in BLOCK.inputs], (3 * 976, 1))
    want, _ = BLOCK.run(inputs, p=p, w=normals(0, CHANNELS, 1, len(inputs)))
    np.testing.assert_array_equal(result["y[2]"][1:].ravel(), want[:, 1])
    assert (result["y[2]"][0] == 2.0 - 3.0).all()


# States


def test_state_between_blocks_replays(path):
    inputs = drive(10 * ROWS)
    with Unit(path, rows=ROWS).start(seed=6) as unit:
        in_blocks(unit, inputs[: 3 * ROWS + 5])
        state, data = unit.save(), None
        data = unit.to_bytes(state)
        once = in_blocks(unit, inputs[3 * ROWS + 5 :], 3 * ROWS + 5)
        unit.restore(state)
        again = in_blocks(unit, inputs[3 * ROWS + 5 :], 3 * ROWS + 5)
        unit.release(state)
    np.testing.assert_array_equal(once, truth(inputs, 6)[3 * ROWS + 5 :])
    np.testing.assert_array_equal(again, once)
    with Unit(path, rows=ROWS) as other:
        other.restore(other.from_bytes(data))
        assert other.get("ticks") == truth(inputs, 6)[3 * ROWS + 4, 3]
        np.testing.assert_array_equal(in_blocks(other, inputs[3 * ROWS + 5 :], 3 * ROWS + 5), once)


def test_a_state_brings_its_block_size(path):
    inputs = drive(40)
    with Unit(path, rows=20).start(seed=6) as unit, Unit(path, rows=3) as other:
        in_blocks(unit, inputs[:20])
        other.restore(other.from_bytes(unit.to_bytes(unit.save())))
        assert other.get("block_size") == 20
        other.rows = 20
        np.testing.assert_array_equal(in_blocks(other, inputs[20:], 20), truth(inputs, 6)[20:])


def test_a_saved_state_may_be_overwritten_by_a_longer_one(path):
    with Unit(path, rows=3) as unit:
        state = unit.save()
        unit.rows = 100
        unit._configure()
        unit.fmu.fmi3GetFMUState(unit.fmu.component, state)
        unit.fmu.fmi3SetFMUState(unit.fmu.component, state)
        assert unit.get("block_size") == 100
        unit.release(state)


@pytest.mark.parametrize("rows", (0, 2, 4, 2**63, 2**64 - 1))
def test_a_state_that_says_other_rows_than_it_has_is_refused(path, rows):
    with Unit(path, rows=3).start() as unit:
        data = unit.to_bytes(unit.save())
        at = data.index((3).to_bytes(8, "little"), 24)
        forged = data[:at] + rows.to_bytes(8, "little") + data[at + 8 :]
        refused(unit, lambda: unit.from_bytes(forged), "state")


def test_the_scalar_forms_state_is_refused(toys):
    with Unit(toys[0]).start() as scalar, Unit(toys[1], rows=1).start() as block:
        data = scalar.to_bytes(scalar.save())
        assert len(data) == len(block.to_bytes(block.save()))
        refused(block, lambda: block.from_bytes(data), "another model")


def test_instances_do_not_touch_each_other(path):
    inputs = drive(6 * ROWS)
    with Unit(path, rows=ROWS).start(seed=1) as one, Unit(path, rows=3).start(seed=2) as two:
        first, second = [], []
        for k in range(6):
            rows = slice(k * ROWS, (k + 1) * ROWS)
            first.append(in_blocks(one, inputs[rows], k * ROWS))
            second.append(in_blocks(two, inputs[rows], k * ROWS))
    np.testing.assert_array_equal(np.vstack(first), truth(inputs, 1))
    np.testing.assert_array_equal(np.vstack(second), truth(inputs, 2))


# Configuration and refusals


def test_block_size_is_set_in_configuration_mode_only(path):
    with Unit(path) as unit:
        refused(unit, lambda: unit.set("block_size", 5), "block_size", "while instantiated")
        unit.fmu.enterConfigurationMode()
        refused(unit, lambda: unit.set("b0", 5.0), "b0", "while in configuration")
        refused(unit, unit.fmu.enterInitializationMode, "in configuration")
        unit.fmu.exitConfigurationMode()
        unit.start()
        refused(unit, unit.fmu.enterConfigurationMode, "stepping")


def test_resizing_keeps_what_has_no_rows(path):
    with Unit(path) as unit:
        for name, value in (("b0", 0.5), ("seed", 2**63), ("sample_period", 0.25)):
            unit.set(name, value)
        unit.set("rate", 1.0)
        unit.rows = 5
        unit._configure()
        assert [unit.get(name) for name in ("b0", "seed", "sample_period", "block_size")] == [
            0.5,
            2**63,
            0.25,
            5,
        ]
        assert (
            unit.get_array("rate").tolist() == [0.0] * 5
            and unit.get_array("temperature").tolist() == [25.0] * 5
        )


def test_reset_brings_the_own_block_size_back(path):
    with Unit(path, rows=3).start() as unit:
        unit.fmu.reset()
        assert unit.get("block_size") == 976


@pytest.mark.parametrize("size", (0, 2**24 + 1, 2**64 - 1))
def test_impossible_block_sizes_are_refused(path, size):
    with Unit(path, rows=4) as unit:
        unit.fmu.enterConfigurationMode()
        refused(unit, lambda: unit.set("block_size", size), "block_size", "1 to 16777216")
        assert unit.get("block_size") == 4


def test_scalar_forms_have_nothing_to_configure(toys):
    with Unit(toys[0]) as unit:
        refused(unit, unit.fmu.enterConfigurationMode, "nothing to configure")


def test_a_step_longer_than_a_block_is_refused(path):
    inputs = drive(ROWS)
    with Unit(path, rows=ROWS).start() as unit:
        refused(unit, lambda: unit.step(0.0, (ROWS + 1) * PERIOD), f"{ROWS + 1} samples", f"{ROWS}")
        assert unit.get("time") == 0.0
        np.testing.assert_array_equal(one_step(unit, inputs), truth(inputs))


@pytest.mark.parametrize(
    "name, n", (("rate", 1), ("rate", ROWS + 1), ("rate", 0), ("M", 3), ("M", 5), ("b0", 2))
)
def test_wrong_numbers_of_values_are_refused(path, name, n):
    with Unit(path, rows=ROWS) as unit:
        reference = [unit.variables[name].valueReference]
        has = str(np.prod(unit.shape(name), dtype=int))
        refused(
            unit,
            lambda: unit.fmu.setFloat64(reference, [1.0] * n),
            f"have {has} values",
            f"not {n}",
        )
        refused(
            unit,
            lambda: unit.fmu.getFloat64(reference, nValues=n),
            f"have {has} values",
            f"not {n}",
        )


# From Python


def test_streams_ask_for_a_chunk_at_a_time(path):
    asked = []

    def chunks():
        for k in range(3):
            asked.append(k)
            yield drive(5, seed=k)

    answers = stream_blocks(path, chunks(), block_size=4)
    assert not asked
    next(answers)
    assert asked == [0]
    next(answers)
    assert asked == [0, 1]
    answers.close()


def test_progress_is_told_after_each_block(path):
    told = []
    simulate_blocks(path, drive(10), block_size=4, progress=lambda made, n: told.append((made, n)))
    assert told == [(4, 10), (8, 10), (10, 10)]


def test_other_sample_period(toys):
    inputs = drive(20)
    want = simulate(toys[0], inputs, sample_period=0.013)
    np.testing.assert_array_equal(
        simulate_blocks(toys[1], inputs, sample_period=0.013, block_size=6), want
    )


def test_no_inputs_no_outputs_but_the_start(path):
    assert simulate_blocks(path, np.empty((0, 4)), start_values={"b0": 2.0}).tolist() == [
        [2.0, 0.75, 1.0, 0.0]
    ]


@pytest.mark.parametrize(
    "given, words",
    (
        ({"weather": 1.0}, "no parameter weather"),
        ({"M[3,1]": 1.0}, r"no parameter M\[3,1\]"),
        ({"M[0,1]": 1.0}, r"no parameter M\[0,1\]"),
        ({"M[1]": 1.0}, r"no parameter M\[1\]"),
        ({"M": [1, 2, 3, 4]}, r"\(4,\), not \(2, 2\)"),
        ({"b0": [1, 2]}, r"\(2,\), not \(\)"),
    ),
)
def test_start_values_that_fit_nothing(path, given, words):
    with pytest.raises(ValueError, match=words):
        simulate_blocks(path, drive(3), start_values=given)


@pytest.mark.parametrize("inputs", (np.zeros((3, 5)), np.zeros(3), np.zeros((2, 2, 4))))
def test_inputs_of_the_wrong_shape(path, inputs):
    with pytest.raises(ValueError, match=r"not \(n, 4\)"):
        simulate_blocks(path, inputs)


def test_a_scalar_form_is_refused(toys):
    with pytest.raises(ValueError, match="block form"):
        simulate_blocks(toys[0], drive(3))


def test_what_the_fmu_says_stands_in_the_exception(path):
    with pytest.raises(FMICallException) as caught:
        simulate_blocks(path, drive(3), start_values={"noise.N": -1.0})
    assert any("noise.N must lie in 0 to inf, not -1" in note for note in caught.value.__notes__)


# A sensor


def test_arrays_of_a_sensor(tmp_path):
    """The contract's names less their indices; a matrix without its diagonal keeps its elements."""
    G = 1e-3 * np.arange(1.0, 10.0).reshape(3, 3)
    gyro = Sensor(
        "gyro",
        {
            "g_sensitivity": {"G": G},
            "misalignment": {},
            "angle_random_walk": {"N": [1e-3, 2e-3, 3e-3]},
        },
    )
    scalar, block = build_fmus(part("imt30").with_sensor(gyro).block, tmp_path, (3, "block"))
    assert validate_fmu(str(block)) == []
    of = {v.name: v for v in read_model_description(str(block)).modelVariables}
    assert (of["rate"].shape, of["specific_force"].shape, of["temperature"].shape) == (
        (976, 3),
        (976, 3),
        (976,),
    )
    assert (
        of["gyro"].shape == of["accel"].shape == (976, 3)
        and of["gyro_error.misalignment.m[1,2]"].shape == ()
    )
    assert of["gyro_error.angle_random_walk.N"].shape == (3,)
    in_fmu = of["gyro_error.g_sensitivity.G"]
    np.testing.assert_array_equal(
        np.reshape(list(map(float, in_fmu.start.split())), in_fmu.shape), G
    )
    inputs = np.random.default_rng(2).normal(size=(100, 7))
    start = {"gyro_error.misalignment.m[2,1]": 0.01, "gyro_error.g_sensitivity.G[1,3]": 0.5}
    want = simulate(scalar, inputs, sample_period=1 / 976, start_values=start)
    np.testing.assert_array_equal(
        simulate_blocks(block, inputs, start_values=start, block_size=64), want
    )
