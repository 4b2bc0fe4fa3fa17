"""The attitude filter in an FMU: the bits of Python, states that are taken back and carried to
another process, refusals and messages.
"""

import re
import subprocess
import sys

import numpy as np
import pytest
from attitude_cases import GRAVITY, H, eventful_recording, inputs, output, parameters, part
from built import built
from fmpy.fmi1 import FMICallException
from fmu_toy import Unit
from places import same_path
from test_attitude_faults import log

from pyimu.attitude import attitude_ukf, run
from pyimu.block import compiled as native
from pyimu.errors import UserError
from pyimu.fmu import FORMS, simulate, simulate_blocks
from pyimu.recording.recording import Recording


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    return built(attitude_ukf(part()), tmp_path_factory)


def rows(recording: Recording) -> np.ndarray:
    """The recording as the filter's inputs, as a user would write them."""
    told = np.isfinite(recording.heading)
    return inputs(
        len(recording.time),
        gyro=recording.gyro,
        accel=recording.accel,
        heading=np.where(told, recording.heading, 0),
        heading_variance=np.where(told, recording.heading_std, 0) ** 2,
        heading_valid=told,
        stationary=recording.stationary,
    )


@pytest.mark.skipif(not native.compiler_command(), reason="no compiler here")
def test_compiled_run_gives_the_bits_of_the_virtual_machine(monkeypatch, tmp_path):
    """Of so few rows none is compiled before that is said to pay."""
    monkeypatch.setenv("PYIMU_CACHE", str(tmp_path))
    monkeypatch.setattr(native, "_loaded", {})
    native._machine_code.cache_clear()
    recording = eventful_recording()
    slow = run(recording, part(), latitude=0.8)
    assert not native._loaded
    monkeypatch.setattr(native, "WORTHWHILE", 0)
    native._machine_code.cache_clear()
    quick = run(recording, part(), latitude=0.8)
    assert native._loaded
    for name in ("q", "gyro_bias", "std", "quasi_static", "nis", "status", "heading_std"):
        np.testing.assert_array_equal(getattr(quick, name), getattr(slow, name))
    native._machine_code.cache_clear()


@pytest.mark.parametrize("form", FORMS)
def test_fmu_with_the_results_parameters_gives_its_bits(fmus, form):
    recording = eventful_recording()
    result = run(recording, part(), latitude=0.8)
    period = recording.sample_period
    given = {"start_values": dict(result.parameters), "sample_period": period}
    y = (
        simulate_blocks(fmus[form], rows(recording), block_size=500, **given)
        if form == "block"
        else simulate(fmus[form], rows(recording), **given)
    )
    block = attitude_ukf(part())
    for name in ("q", "gyro_bias", "std", "quasi_static", "nis", "status", "heading_std"):
        np.testing.assert_array_equal(output(block, y[1:], name), getattr(result, name))


@pytest.mark.parametrize("form", (2, 3))
def test_state_taken_back_makes_the_same_run_again(fmus, form):
    u, half = rows(eventful_recording(600)), 300
    with Unit(fmus[form]).start() as unit:
        unit.run(u[:half], period=H)
        state = unit.save()
        first = unit.run(u[half:], first=half, period=H)
        unit.restore(state)
        np.testing.assert_array_equal(unit.run(u[half:], first=half, period=H), first)
        unit.release(state)


@pytest.fixture(params=(2, 3), ids=("fmi2", "fmi3"))
def path(request, fmus):
    return fmus[request.param]


def test_start_values_are_fixed_and_there_is_no_seed(path):
    """After initialization they would have no effect, so that setting them is refused."""
    with Unit(path) as unit:
        variability = {v.name: v.variability for v in unit.description.modelVariables}
        start = [n for n in variability if n.startswith(("q0[", "bias0[", "std0["))]
        assert len(start) == 13 and {variability[n] for n in start} == {"fixed"}
        assert variability["latitude"] == variability["gravity"] == "tunable"
        assert "seed" not in variability
        unit.set("bias0[1]", 0.5)
        unit.start()
        assert unit.get("gyro_bias[1]") == 0.5
        with pytest.raises(FMICallException):
            unit.set("bias0[1]", 0.1)
        assert unit.messages[-1][0] == "logStatusError"
        assert "bias0[1] cannot be set while stepping" in unit.messages[-1][1]


def test_a_parameter_counts_from_the_sample_after_which_it_changes(path):
    """That of a restored state, too: what a unit computes of parameters once is computed anew."""
    u, half, block = rows(eventful_recording(600)), 300, attitude_ukf(part())
    changed, p = {"latitude": 0.8, "motion_time": 0.5}, block.start.copy()
    names = [v.name for v in block.parameters]
    p[[names.index(name) for name in changed]] = list(changed.values())
    _, state = block.run(u[:half])
    as_before, after = (block.run(u[half:], state=state, p=q)[0] for q in (block.start, p))
    assert not np.array_equal(as_before, after)
    with Unit(path).start() as unit:
        unit.run(u[:half], period=H)
        saved = unit.save()
        for name, value in changed.items():
            unit.set(name, value)
        np.testing.assert_array_equal(unit.run(u[half:], first=half, period=H), after)
        unit.restore(saved)
        np.testing.assert_array_equal(unit.run(u[half:], first=half, period=H), as_before)
        unit.release(saved)


@pytest.mark.parametrize("value", (np.nan, np.inf, -np.inf))
def test_a_parameter_that_is_not_finite_is_refused_by_fmu_and_python(path, value):
    for name in ("latitude", "gravity", "gyro_error.rate_random_walk.K[2]"):
        with Unit(path).start() as unit:
            before = unit.get(name)
            with pytest.raises(FMICallException):
                unit.set(name, value)
            assert f"{name} must be finite" in unit.messages[-1][1]
            assert unit.get(name) == before
        block = attitude_ukf(part())
        with pytest.raises(UserError, match=re.escape(f"{name} must be finite")):
            block.run(inputs(3), p=parameters(block, **{name: value}))
    with pytest.raises(UserError, match="latitude"):
        run(eventful_recording(300), part(), settings={"latitude": value})


def test_sensor_and_filter_together_are_as_sure_as_the_filter_on_a_log(path, tmp_path_factory):
    """Both step, then exchange: at its first sample the filter has what the sensor shows before its
    own, which is the ideal measurement at rest.
    """
    block = attitude_ukf(part())
    sensor = built(part().block, tmp_path_factory)[2 if "fmi2" in path.name else 3]
    with Unit(sensor).start(seed=5) as source, Unit(path).start() as unit:
        seen, y = [], []
        for k in range(100):
            seen.append(source.outputs())
            source.step(k * H, (k + 1) * H - k * H)
            seen[-1], (temperature,) = seen[-1][:6], seen[-1][6:]
            shown = {"gyro": seen[-1][:3], "accel": seen[-1][3:], "temperature": temperature}
            y.append(unit.run(inputs(1, **shown), k, H)[0])
    assert seen[0] == [0, 0, 0, 0, 0, GRAVITY] and np.std(seen[1:], axis=0).min() > 0
    measured = np.array(seen[1:])
    log, _ = block.run(inputs(99, gyro=measured[:, :3], accel=measured[:, 3:]))
    pair = output(block, np.array(y), "std")
    # Both have had as many samples; their noise makes hardly a difference to how sure they are.
    np.testing.assert_allclose(pair[9, :2], output(block, log, "std")[9, :2], rtol=1e-3)
    np.testing.assert_allclose(pair[98, :2], output(block, log, "std")[98, :2], rtol=1e-3)
    assert output(block, np.array(y), "quasi_static").all()


def test_step_back_in_time_is_refused_and_changes_nothing(path):
    u = log(None)[0][:60]
    want, _ = attitude_ukf(part()).run(u)
    with Unit(path).start() as unit:
        first = unit.run(u[:30], period=H)
        with pytest.raises(Exception, match="doStep|fmi[23]DoStep"):
            unit.step(10 * H, H)
        assert any(
            category == "logStatusError" and "last one ended" in text
            for category, text in unit.messages
        )
        np.testing.assert_array_equal(
            np.vstack([first, unit.run(u[30:], first=30, period=H)]), want
        )


def test_each_change_of_the_status_is_an_event_in_the_log(path):
    u = log(None)[0][:60]
    u[20:25, 3] = np.nan
    with Unit(path, log_events=True).start() as unit:
        unit.run(u, period=H)
        told = [
            text for category, text in unit.messages if category == "logEvents" and "status" in text
        ]
        assert told == [
            "AttitudeUkf: status is 1 after sample 21",
            "AttitudeUkf: status is 0 after sample 26",
        ]


CONTINUE = """
import sys, numpy as np
from pathlib import Path
from fmu_toy import Unit
from test_attitude_fmu import H, eventful
with Unit(Path(sys.argv[1])) as unit:
    unit.restore(unit.from_bytes(Path(sys.argv[2]).read_bytes()))
    np.save(sys.argv[3], unit.run(eventful()[150:], first=150, period=H))
"""


def eventful() -> np.ndarray:
    """300 rows with faults, and headings that came late."""
    u, truth = log(None)
    u = u[:300].copy()
    u[140:160, 0], u[145:152, 4], u[200, 2] = np.nan, np.inf, np.nan
    told = np.arange(60, 300, 20)
    u[told, 7:11] = np.column_stack(
        [
            truth.as_euler("ZYX")[told - 37, 0],
            np.full((len(told), 2), [1e-3, 1]),
            np.full(len(told), 37 * H),
        ]
    )
    return u


def test_state_serialised_into_another_process_goes_on_bit_for_bit(path, tmp_path):
    want, _ = attitude_ukf(part()).run(eventful())
    with Unit(path).start() as unit:
        unit.run(eventful()[:150], period=H)
        (tmp_path / "state").write_bytes(unit.to_bytes(unit.save()))
    command = [sys.executable, "-c", CONTINUE, path, tmp_path / "state", tmp_path / "y.npy"]
    subprocess.run(list(map(str, command)), env=same_path(), check=True)
    np.testing.assert_array_equal(np.load(tmp_path / "y.npy"), want[150:])
