"""FMUs of a block that has one of everything: samples, states and refusals, the same for every
form.
"""

import math
import subprocess
import sys
from ctypes import byref, c_double, c_int, c_void_p
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from built import built
from fmpy.fmi1 import FMICallException
from fmu_toy import CHANNELS, Unit, drive, toy
from hypothesis import given, settings
from hypothesis import strategies as st
from numba import njit
from places import same_path

from pyimu.block.cost import operations
from pyimu.block.normals import normals
from pyimu.errors import UserError
from pyimu.fmu import FORMS, simulate_blocks
from pyimu.fmu import simulate as simulate_scalars
from pyimu.fmu.variables import OF_A_NORMAL, most_samples

BLOCK = toy()
PERIOD = BLOCK.sample_period
SILENT = {"noise.N": 0.0, "noise.K": 0.0}


@pytest.fixture(scope="session")
def toys(tmp_path_factory):
    """The toy in every form: form to path."""
    return built(BLOCK, tmp_path_factory)


@pytest.fixture(params=FORMS, ids=("fmi2", "fmi3", "block"))
def path(request, toys):
    return toys[request.param]


def simulate(path, inputs, **options):
    """Outputs (n + 1, ny) of any form."""
    return (simulate_blocks if path.name.endswith(".block.fmu") else simulate_scalars)(
        path, inputs, **options
    )


def parameters(**values):
    """The toy's parameters with some of them changed, shape (np,)."""
    return np.array([values.get(v.name, v.start) for v in BLOCK.parameters])


def truth(inputs, seed=0, first=1, **values):
    """What Python says to inputs (n, nu) when the first sample has number ``first``."""
    return BLOCK.run(inputs, p=parameters(**values), w=normals(seed, CHANNELS, first, len(inputs)))[
        0
    ]


# Samples


def test_noise_off_equals_python_bit_for_bit(path):
    inputs = drive(3000)
    outputs = simulate(path, inputs, sample_period=PERIOD, start_values=SILENT)
    np.testing.assert_array_equal(outputs[1:], BLOCK.run(inputs, p=parameters(**SILENT))[0])


@pytest.mark.parametrize("seed", (0, 1, 2**31 - 1))
def test_noise_on_equals_python_bit_for_bit(path, seed):
    inputs = drive(1000)
    outputs = simulate(path, inputs, sample_period=PERIOD, start_values={"seed": seed})
    np.testing.assert_array_equal(outputs[1:], truth(inputs, seed))


def fnv_1a(name):
    """64 bits (Fowler, Noll, Vo; draft-eastlake-fnv, section 2)."""
    number = 0xCBF29CE484222325
    for byte in name.encode():
        number = (number ^ byte) * 0x100000001B3 % 2**64
    return number


def test_without_a_seed_the_noise_is_that_of_the_instances_name(path):
    """A number that stands for the name, 0 for the model's own; as the start value 0 is set by
    some tools, it means the same. A seed has its noise under any name.
    """
    inputs = drive(30)

    def noise_of(name, **values):
        with Unit(path, name=name).start(**values) as unit:
            return unit.run(inputs)

    np.testing.assert_array_equal(noise_of("Toy"), truth(inputs, 0))
    for name in ("left", "right", "Rover.Sensor"):
        want = truth(inputs, fnv_1a(name) ^ fnv_1a("Toy"))
        np.testing.assert_array_equal(noise_of(name), want)
        np.testing.assert_array_equal(noise_of(name, seed=0), want)
        np.testing.assert_array_equal(noise_of(name, seed=1), truth(inputs, 1))


def test_a_state_brings_the_noise_of_the_name_that_it_was_made_under(path):
    """It replays exactly, whatever the instance that takes it is called."""
    inputs = drive(40)
    with Unit(path, name="left").start() as left, Unit(path, name="right").start() as right:
        left.run(inputs[:13])
        state = left.save()
        right.restore(right.from_bytes(left.to_bytes(state)))
        want = left.run(inputs[13:], first=13)
        np.testing.assert_array_equal(right.run(inputs[13:], first=13), want)
        right.reset()
        right.start()
        assert not np.array_equal(right.run(inputs[:13]), truth(inputs, 0)[:13])
        left.release(state)


def test_seed_of_64_bits(toys):
    inputs = drive(50)
    outputs = simulate(toys[3], inputs, sample_period=PERIOD, start_values={"seed": 2**64 - 3})
    np.testing.assert_array_equal(outputs[1:], truth(inputs, 2**64 - 3))


def test_row_0_is_the_start_value(path):
    start = {"b0": 0.75, "M[1,2]": 3.0, "M[2,1]": -1.5}
    inputs = drive(2)
    outputs = simulate(path, inputs, sample_period=PERIOD, start_values=start)
    shown = [0.75, 3.0 - -1.5 + inputs[0, 1] - 25, 1.0, 0.0]
    np.testing.assert_array_equal(outputs[0], shown)


def test_matrix_goes_row_by_row(path):
    silent = SILENT | {"M[1,1]": 0.0, "M[1,2]": 5.0, "M[2,1]": 7.0, "M[2,2]": 0.0, "b0": 0.0}
    outputs = simulate(path, [[0.0, 8.0, 0, 0]], sample_period=PERIOD, start_values=silent)
    # sin(0) + cos(0) sin(0.1) is the first component, sqrt(8 + 1) the second; cos(0.1) is added to
    # the second output
    np.testing.assert_allclose(
        outputs[1, :2], [5.0 * 3.0, 7.0 * math.sin(0.1) + math.cos(0.1)], rtol=1e-15
    )


def test_other_sample_period(path):
    inputs, period = drive(200), 0.013
    outputs = simulate(path, inputs, sample_period=period, start_values={"seed": 5})
    w = normals(5, CHANNELS, 1, 200)
    np.testing.assert_array_equal(outputs[1:], BLOCK.run(inputs, w=w, sample_period=period)[0])


@pytest.mark.parametrize("held", (2, 7, 200))
@pytest.mark.parametrize("version", (2, 3))
def test_samples_do_not_depend_on_the_step(toys, version, held):
    inputs = np.repeat(drive(60), held, axis=0)
    outputs = simulate_scalars(
        toys[version], inputs, sample_period=PERIOD, samples_per_step=held, start_values={"seed": 4}
    )
    np.testing.assert_array_equal(outputs[1:], truth(inputs, 4)[held - 1 :: held])


def test_start_time_counts_in_samples(path):
    """A run that starts at 100 periods makes sample 101 first, with the noise of sample 101."""
    inputs = drive(50)
    outputs = simulate(
        path, inputs, sample_period=PERIOD, start_time=100 * PERIOD, start_values={"seed": 9}
    )
    np.testing.assert_array_equal(outputs[1:], truth(inputs, 9, first=101))


def test_time_before_zero(path):
    inputs = drive(8)
    outputs = simulate(path, inputs, sample_period=0.25, start_time=-1.0, start_values={"seed": 9})
    want = BLOCK.run(inputs, w=normals(9, CHANNELS, -3, 8), sample_period=0.25)[0]
    np.testing.assert_array_equal(outputs[1:], want)


def test_tuned_parameter_acts_from_the_next_sample(path):
    inputs = drive(20)
    with Unit(path).start(seed=1) as unit:
        before = unit.run(inputs[:10])
        unit.set("M[1,1]", 4.0)
        after = unit.run(inputs[10:], first=10)
    y, state = BLOCK.run(inputs[:10], w=normals(1, CHANNELS, 1, 10))
    tuned, _ = BLOCK.run(
        inputs[10:], p=parameters(**{"M[1,1]": 4.0}), w=normals(1, CHANNELS, 11, 10), state=state
    )
    np.testing.assert_array_equal(np.vstack([before, after]), np.vstack([y, tuned]))


def test_nan_is_left_to_the_block(path):
    inputs = drive(5)
    inputs[2, 0] = np.nan
    with Unit(path).start() as unit:
        np.testing.assert_array_equal(unit.run(inputs), truth(inputs))


# Time


def ticking(path, start_time=0.0, period=PERIOD):
    """A unit whose output ``ticks`` counts the samples that it has made."""
    return Unit(path).start(start_time=start_time, sample_period=period, counting=1, gear=1)


def walk(unit, times):
    """Step through communication points; gives ``ticks`` at each but the first."""
    counts = []
    for t, following in pairwise(times):
        unit.step(t, following - t)
        counts.append(unit.get("ticks"))
    return np.array(counts)


STEPS = st.lists(st.floats(1e-4, 3.0), min_size=1, max_size=25)


@settings(max_examples=60, deadline=None)
@given(steps=STEPS, period=st.sampled_from([1 / 976, 0.1, 1 / 3]), start=st.floats(-5.0, 50.0))
def test_a_step_makes_the_samples_within_it(toys, steps, period, start):
    """t < k period <= t + H, counted in exact fractions, for steps of any length."""
    steps = [h * 5 * period for h in steps]
    times = list(np.cumsum([start, *steps]))
    exact = [math.floor(Fraction(t) / Fraction(period)) for t in times]
    distance = [
        abs(Fraction(t) / Fraction(period) - round(Fraction(t) / Fraction(period))) for t in times
    ]
    if min(distance) > 1e-4:  # nearer to a sample than that, a master's rounding is forgiven
        with ticking(toys[2], start, period) as unit:
            assert list(walk(unit, times)) == [k - exact[0] for k in exact[1:]]


def every_sample(n):
    return np.arange(1, n + 1)


@pytest.mark.parametrize(
    "clock", ("multiples", "sums", "nanoseconds", "one ulp short", "one ulp late")
)
def test_masters_whose_clocks_round(path, clock):
    """One sample a step at 976 Hz, however the master writes its communication points down."""
    n = 4000
    multiples = np.arange(n + 1) * PERIOD
    times = {
        "multiples": multiples,
        "sums": np.cumsum([0.0] + [PERIOD] * n),
        "nanoseconds": np.round(multiples, 9),
        "one ulp short": np.nextafter(multiples, -1),
        "one ulp late": np.nextafter(multiples, 1e9),
    }[clock]
    with ticking(path) as unit:
        np.testing.assert_array_equal(walk(unit, times.tolist()), every_sample(n))


@njit
def sum_up(do_step, component, period, n):
    """Steps of a master that adds its steps up; gives the sum and the first status that is not
    fmi2OK.
    """
    time = 0.0
    for _ in range(n):
        status = do_step(component, time, period, 0)
        if status:
            return time, status
        time += period
    return time, 0


def test_sums_over_an_hour(toys):
    """3.6 million times 1 ms, added up, end more than 1e-5 ms off; the hour still has 3.6 million
    samples.
    """
    n, period = 3_600_000, 1e-3
    with ticking(toys[2], period=period) as unit:
        do_step = unit.fmu.dll.fmi2DoStep
        do_step.argtypes, do_step.restype = [c_void_p, c_double, c_double, c_int], c_int
        time, status = sum_up(do_step, unit.fmu.component, period, n)
        assert status == 0 and abs(time / period - n) > 1e-5
        assert unit.get("ticks") == n


def test_steps_shorter_than_a_sample(path):
    with ticking(path, period=1.0) as unit:
        counts = walk(unit, [0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4])
    np.testing.assert_array_equal(counts, [0, 0, 1, 1, 2, 2])


# States


def test_restored_state_replays(path):
    inputs = drive(90)
    with Unit(path).start(seed=6) as unit:
        unit.run(inputs[:30])
        state = unit.save()
        once = unit.run(inputs[30:], first=30)
        unit.restore(state)
        again = unit.run(inputs[30:], first=30)
        unit.release(state)
    np.testing.assert_array_equal(once, truth(inputs, 6)[30:])
    np.testing.assert_array_equal(again, once)


def test_state_of_another_seed_brings_its_noise(path):
    """The cached words of one seed must not be taken for the other's."""
    inputs = drive(20)
    with Unit(path).start(seed=1) as one, Unit(path).start(seed=2) as two:
        one.run(inputs[:5])
        two.run(inputs[:5])
        two.restore(two.from_bytes(one.to_bytes(one.save())))
        np.testing.assert_array_equal(two.run(inputs[5:], first=5), truth(inputs, 1)[5:])


CONTINUE = """
import sys, numpy as np
from pathlib import Path
from fmu_toy import Unit, drive
with Unit(Path(sys.argv[1])) as unit:
    unit.restore(unit.from_bytes(Path(sys.argv[2]).read_bytes()))
    np.save(sys.argv[3], unit.run(drive(90)[30:], first=30))
"""


def test_serialized_state_outlives_the_process(path, tmp_path):
    inputs = drive(90)
    with Unit(path).start(seed=6) as unit:
        unit.run(inputs[:30])
        (tmp_path / "state").write_bytes(unit.to_bytes(unit.save()))
    command = [sys.executable, "-c", CONTINUE, path, tmp_path / "state", tmp_path / "y.npy"]
    subprocess.run(list(map(str, command)), env=same_path(), check=True)
    np.testing.assert_array_equal(np.load(tmp_path / "y.npy"), truth(inputs, 6)[30:])


@pytest.mark.parametrize("damage", ("short", "long", "empty", "flipped", "foreign"))
def test_damaged_state_is_refused(path, tmp_path_factory, damage):
    with Unit(path).start() as unit:
        good = unit.to_bytes(unit.save())
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        bad = {
            "short": good[:-1],
            "long": good + b"\0",
            "empty": b"",
            "flipped": bytes(flipped),
            "foreign": good,
        }[damage]
        if damage != "foreign":
            refused(unit, lambda: unit.from_bytes(bad), "state")
            return
        other = built(toy(unit="deg/s"), tmp_path_factory)[unit.form]
        with Unit(other).start() as stranger:
            refused(stranger, lambda: stranger.from_bytes(bad), "another model")


def test_instances_do_not_touch_each_other(path):
    """Interleaved, one library for both and a second copy of it: each gives what it gives alone."""
    inputs = drive(40)
    with Unit(path).start(seed=1) as one, Unit(path).start(seed=2, b0=3.0) as two:
        y = [
            np.vstack([unit.run(inputs[k : k + 1], first=k) for unit in (one, two)])
            for k in range(40)
        ]
    np.testing.assert_array_equal([row[0] for row in y], truth(inputs, 1))
    np.testing.assert_array_equal([row[1] for row in y], truth(inputs, 2, b0=3.0))


def test_two_instances_of_one_library(path):
    inputs = drive(30)
    with Unit(path) as unit:
        first = unit.fmu.component
        unit.start(seed=1)
        unit._instantiate()
        second = unit.fmu.component
        unit.start(seed=2)
        rows = {}
        for k in range(30):
            for component in (first, second):
                unit.fmu.component = component
                rows.setdefault(component, []).append(unit.run(inputs[k : k + 1], first=k)[0])
        np.testing.assert_array_equal(rows[first], truth(inputs, 1))
        np.testing.assert_array_equal(rows[second], truth(inputs, 2))


def test_reset_starts_over(path):
    inputs = drive(20)
    with Unit(path).start(seed=3, b0=1.0) as unit:
        unit.run(inputs)
        unit.reset()
        assert unit.get("b0") == -0.125 and unit.get("seed") == 0
        unit.start(seed=5)
        np.testing.assert_array_equal(unit.run(inputs), truth(inputs, 5))


# Values


def test_values_read_back(path):
    values = {
        "rate": 0.1,
        "counting": False,
        "gear": -7,
        "doubled": True,
        "b0": 1e-300,
        "sample_period": 0.5,
        "seed": 77,
    }
    with Unit(path) as unit:
        for name, value in values.items():
            unit.set(name, value)
            assert unit.get(name) == value
        assert unit.get("temperature") == 25.0 and unit.get("time") == 0.0


def test_outputs_before_the_first_sample_follow_the_parameters(path):
    with Unit(path) as unit:
        unit.set("b0", 2.0)
        assert unit.outputs() == [2.0, 0.25 + 0.5, 1.0, 0.0]
        unit.start(b0=-3.0)
        assert unit.outputs() == [-3.0, 0.25 + 0.5, 0.0, 0.0]


def test_outputs_before_the_first_sample_follow_the_inputs(path):
    """As they are when initialization ends; an input that is set later changes them no more."""
    with Unit(path) as unit:
        unit.set("temperature", 30.0)
        assert unit.outputs()[1] == 0.75 + 5.0
        unit.start(temperature=20.0)
        assert unit.outputs()[1] == 0.75 - 5.0
        unit.set("temperature", 0.0)
        assert unit.outputs()[1] == 0.75 - 5.0


def test_time_is_the_communication_point(path):
    with Unit(path).start(start_time=2.0) as unit:
        unit.step(2.0, 0.0075)
        assert unit.get("time") == 2.0075


def test_an_integer_output_saturates(toys):
    with Unit(toys[3]).start(gear=2**31 - 1, sample_period=1.0) as unit:
        unit.step(0.0, 3.0)
        assert unit.get("ticks") == 2**31 - 1


# Refusals


def refused(unit, call, *words):
    """The call gives an error, and one message in the error category that holds all of
    ``words``.
    """
    unit.messages.clear()
    with pytest.raises(FMICallException):
        call()
    errors = [text for category, text in unit.messages if category == "logStatusError"]
    assert len(errors) == 1 and all(word in errors[0] for word in words), (unit.messages, words)


@pytest.mark.parametrize("period", (0.0, -1.0, math.inf, math.nan))
def test_sample_period_must_be_positive(path, period):
    with Unit(path) as unit:
        refused(unit, lambda: unit.set("sample_period", period), "sample_period", "positive")
        assert unit.get("sample_period") == PERIOD


@pytest.mark.parametrize("value", (-1e-9, -math.inf, math.nan))
def test_a_parameter_keeps_its_bounds(path, value):
    """Before and during a run; what was there stays."""
    with Unit(path) as unit:
        refused(unit, lambda: unit.set("noise.N", value), "noise.N must ", f"not {value:g}")
        unit.start(**{"noise.N": 0.0})
        refused(unit, lambda: unit.set("noise.N", value), "noise.N must ", f"not {value:g}")
        assert unit.get("noise.N") == 0.0


@pytest.mark.parametrize("value", (-math.inf, math.inf, math.nan))
def test_a_parameter_without_bounds_is_any_finite_number(path, value):
    """Before and during a run; what was there stays."""
    with Unit(path) as unit:
        unit.set("noise.K", -1.0)
        refused(unit, lambda: unit.set("noise.K", value), "noise.K must be finite")
        unit.start()
        refused(unit, lambda: unit.set("noise.K", value), "noise.K must be finite")
        assert unit.get("noise.K") == -1.0


BAD = (
    ({"sed": 1}, "no parameter sed, did you mean seed"),
    ({"rate": 1.0}, "no parameter rate"),
    ({"y[1]": 1.0}, r"no parameter y\[1\]"),
    *(
        ({"seed": seed}, f"seed {seed!r} is not an integer in 0 to")
        for seed in (-1, 1.5, "1", None, 2**64)
    ),
)


@pytest.mark.parametrize("values, message", BAD)
def test_start_values_that_are_none_are_refused(path, values, message):
    with pytest.raises(UserError, match=message):
        simulate(path, drive(3), sample_period=PERIOD, start_values=values)


def test_a_seed_that_the_version_has_no_number_for_is_refused(toys):
    with pytest.raises(UserError, match=r"not an integer in 0 to 2\^31 - 1"):
        simulate_scalars(toys[2], drive(3), sample_period=PERIOD, start_values={"seed": 2**31})


def test_negative_seed_is_refused(toys):
    with Unit(toys[2]) as unit:
        refused(unit, lambda: unit.set("seed", -1), "seed", "negative")


@pytest.mark.parametrize("name", ("y[1]", "ticks", "positive", "time"))
def test_outputs_and_time_cannot_be_set(path, name):
    with Unit(path) as unit:
        refused(unit, lambda: unit.set(name, 0), name, "cannot be set")


@pytest.mark.parametrize("name", ("sample_period", "seed"))
def test_fixed_parameters_cannot_be_set_any_more(path, name):
    with Unit(path).start() as unit:
        refused(unit, lambda: unit.set(name, 1), name, "cannot be set while stepping")


def test_unknown_references_and_other_types(path):
    with Unit(path) as unit:
        real = "Real" if unit.version == 2 else "Float64"
        get, put = getattr(unit.fmu, f"get{real}"), getattr(unit.fmu, f"set{real}")
        doubled = unit.variables["doubled"].valueReference
        refused(unit, lambda: get([1000]), "1000")
        refused(unit, lambda: put([4294967295], [0.0]), "4294967295")
        refused(unit, lambda: get([doubled]), "doubled", "type")
        refused(unit, lambda: put([doubled], [1.0]), "doubled", "type")
        refused(unit, lambda: unit.fmu.getString([doubled]), "doubled")


LEGAL = {
    "setup": "i",
    "enter": "i",
    "exit": "n",
    "step": "s",
    "terminate": "s",
    "reset": "inst",
    "get": "inst",
    "set input": "ins",
    "set parameter": "ins",
    "set fixed": "in",
    "save": "inst",
    "restore": "inst",
}
"""Call to the phases in which it is legal: (i)nstantiated, i(n)itialization, (s)tepping,
(t)erminated."""


def reach(unit, phase):
    if phase in "st":
        unit.start()
    if phase == "n":
        unit.fmu.enterInitializationMode()
    if phase == "t":
        unit.fmu.terminate()


@pytest.mark.parametrize("phase", "inst")
@pytest.mark.parametrize("call", LEGAL)
def test_each_call_in_each_phase(path, call, phase):
    with Unit(path) as unit:
        state = unit.save()
        reach(unit, phase)
        # FMI 3 sets up the experiment as it enters initialization.
        setup = unit.fmu.setupExperiment if unit.version == 2 else unit.fmu.enterInitializationMode
        do = {
            "setup": lambda: setup(startTime=0.0),
            "enter": unit.fmu.enterInitializationMode,
            "exit": unit.fmu.exitInitializationMode,
            "step": lambda: unit.step(0.0, PERIOD),
            "terminate": unit.fmu.terminate,
            "reset": unit.fmu.reset,
            "get": unit.outputs,
            "set input": lambda: unit.set("rate", 1.0),
            "set parameter": lambda: unit.set("b0", 1.0),
            "set fixed": lambda: unit.set("seed", 1),
            "save": unit.save,
            "restore": lambda: unit.restore(state),
        }[call]
        if phase in LEGAL[call]:
            do()
        else:
            refused(unit, do)


@pytest.mark.parametrize(
    "time, size",
    ((0.0, 0.0), (0.0, -1.0), (0.0, math.nan), (0.0, math.inf), (5.0, 1.0), (0.0, 1e300)),
)
def test_impossible_steps_are_refused(path, time, size):
    with ticking(path, period=1.0) as unit:
        refused(unit, lambda: unit.step(time, size), "Toy")
        assert unit.get("ticks") == 0 and unit.get("time") == 0.0
        unit.step(0.0, 1.0)
        assert unit.get("ticks") == 1


# The stop time


def stopping(path, stop, start=0.0, period=1.0):
    """A toy that counts its samples and knows when the experiment ends."""
    unit = Unit(path)
    setup = unit.fmu.setupExperiment if unit.version == 2 else unit.fmu.enterInitializationMode
    setup(startTime=start, stopTime=stop)
    if unit.version == 2:
        unit.fmu.enterInitializationMode()
    for name, value in {"sample_period": period, "counting": 1, "gear": 1}.items():
        unit.set(name, value)
    unit.fmu.exitInitializationMode()
    return unit


def test_no_step_goes_past_the_stop_time(path):
    """FMI 2.0.4, section 4.2.1, and FMI 3.0, section 2.3.2: error; nothing has changed then."""
    with stopping(path, 3.0) as unit:
        refused(unit, lambda: unit.step(0.0, 3.25), "stop time is 3 s")
        unit.step(0.0, 2.0)
        refused(unit, lambda: unit.step(2.0, 1.0001), "stop time is 3 s")
        unit.step(2.0, 1.0)
        refused(unit, lambda: unit.step(3.0, 1.0), "stop time is 3 s")
        assert unit.get("ticks") == 3 and unit.get("time") == 3.0


@pytest.mark.parametrize("n", (3, 1000, 36_000))
def test_a_master_that_adds_its_steps_up_reaches_the_stop_time(path, n):
    """Its last point may be some roundings past it."""
    with stopping(path, n * 0.1, period=0.1) as unit:
        for t, following in pairwise(np.cumsum([0.0] + [0.1] * n).tolist()):
            unit.step(t, following - t)
        assert unit.get("ticks") == n
        refused(unit, lambda: unit.step(n * 0.1, 0.1), "stop time")


def test_far_from_zero_a_step_does_not_make_a_sample_past_the_stop_time(path):
    """What a master may be off by at 1e6 s would be a period of 1 ms."""
    with stopping(path, 1e6, start=1e6 - 1.0, period=1e-3) as unit:
        if unit.form != "block":
            refused(unit, lambda: unit.step(1e6 - 1.0, 1.0006), "stop time")
        unit.step(1e6 - 1.0, 0.008)


def test_the_stop_time_is_kept_in_a_state_and_forgotten_at_a_reset(path):
    with stopping(path, 3.0) as unit, Unit(path).start() as other:
        other.restore(other.from_bytes(unit.to_bytes(unit.save())))
        refused(other, lambda: other.step(0.0, 4.0), "stop time is 3 s")
        unit.reset()
        unit.start(sample_period=1.0)
        unit.step(0.0, 4.0)


@pytest.mark.parametrize("stop", (0.5, math.nan, -math.inf))
def test_a_stop_time_before_the_start_is_refused(path, stop):
    with Unit(path) as unit:
        setup = unit.fmu.setupExperiment if unit.version == 2 else unit.fmu.enterInitializationMode
        refused(unit, lambda: setup(startTime=1.0, stopTime=stop), "not a time from 1 on")
        setup(startTime=1.0, stopTime=1.0)


def test_a_step_of_hours_is_refused_that_nothing_could_break_off(toys):
    """A bound on its samples; a step of as many as it allows would take seconds."""
    for version in (2, 3):
        with ticking(toys[version], period=1e-3) as unit:
            refused(unit, lambda: unit.step(0.0, 1e6), "1000000000 samples, at most 16777216")
            assert unit.get("ticks") == 0


def test_a_unit_that_takes_long_for_a_sample_makes_fewer_in_a_step(tmp_path_factory, monkeypatch):
    """The bound stands for a time; here for that of forty thousand samples."""
    each = operations(toy().step) + OF_A_NORMAL * len(toy().noise)
    monkeypatch.setattr("pyimu.fmu.variables.MOST_OPERATIONS", 40_000 * each)
    assert most_samples(toy()) == 40_000
    for version, path in built(toy(), tmp_path_factory).items():
        if version == "block":
            with Unit(path, rows=4) as unit:
                unit.fmu.enterConfigurationMode()
                refused(unit, lambda u=unit: u.set("block_size", 40_001), "1 to 40000")
        else:
            with ticking(path, period=1e-3) as unit:
                refused(unit, lambda u=unit: u.step(0.0, 40.001), "40001 samples, at most 40000")
                unit.step(0.0, 40.0)
                assert unit.get("ticks") == 40_000


# States of others


@pytest.fixture(scope="module")
def stranger(tmp_path_factory):
    """``stranger(form)``: another model's unit."""
    made = built(toy(unit="deg/s"), tmp_path_factory)
    return lambda form: Unit(made[form])


def test_a_state_of_another_model_in_memory_is_refused(path, stranger):
    """Restored, serialized, freed or overwritten; it stays its owner's."""
    # The unit comes last: fmpy hands all messages of FMI 2 to the logger of the last instance.
    with stranger(Unit(path).form).start() as other, Unit(path).start() as unit:
        theirs = other.save()
        two = unit.version == 2
        kind = c_void_p(theirs.value if hasattr(theirs, "value") else theirs)
        calls = [
            lambda: unit.restore(theirs),
            lambda: unit.to_bytes(theirs),
            lambda: unit.release(kind),
            lambda: (unit.fmu.fmi2GetFMUstate if two else unit.fmu.fmi3GetFMUState)(
                unit.fmu.component, byref(kind)
            ),
        ]
        for call in calls:
            refused(unit, call, "another model's")
        other.restore(theirs)
        other.release(theirs)


def test_foreign_token_is_refused(path):
    with Unit(path) as unit:
        unit.fmu.guid, good = "{someone-else}", unit.fmu.component
        with pytest.raises(Exception, match="instantiate"):
            unit._instantiate()
        assert "{someone-else}" in unit.messages[-1][1]
        unit.fmu.component = good


def test_events_are_told_where_asked(path):
    with Unit(path, log_events=True).start(seed=8) as unit:
        unit.fmu.terminate()
        assert [category for category, _ in unit.messages] == ["logEvents"] * 2
        assert "seed 8" in unit.messages[0][1]
    with Unit(path).start() as quiet:
        assert not quiet.messages
        quiet.fmu.setDebugLogging(True, ["logEvents"])
        quiet.fmu.terminate()
        assert len(quiet.messages) == 1


def test_log_categories_are_checked(path):
    with Unit(path) as unit:
        refused(unit, lambda: unit.fmu.setDebugLogging(True, ["logWeather"]), "logWeather")


def test_what_is_not_offered_is_refused(path):
    with Unit(path).start() as unit:
        call = unit.fmu.cancelStep if unit.version == 2 else unit.fmu.enterEventMode
        refused(unit, call, "not offered")
