"""A recording simulated is the part's chain on the recording's truth, sample by sample, through
gaps and missing cells.
"""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from catalogue_cases import H, as_part, everything, motion, one_of_each_kind
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.block import compiled as native
from pyimu.block.normals import normals
from pyimu.errors import Finding, UserError
from pyimu.model import measure
from pyimu.model import truth as truth_module
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS
from pyimu.model.simulate import simulate, simulate_recording
from pyimu.recording.recording import Recording

N = 500
STEP = 2.0**-7
"""s; a sample period that sums, quotients and differences of times leave exact."""

GYRO = Sensor(
    "gyro",
    {
        "scale_factor": {"s": [0.01, 0.02, 0.03]},
        "g_sensitivity": {"G": 1e-3 * np.arange(9).reshape(3, 3)},
        "thermal_bias": {"kT": 1e-3},
        "lag": {"wn": 30.0},
        "angle_random_walk": {"N": 1e-3},
        "rate_random_walk": {"K": 1e-3},
    },
)
ACCEL = Sensor(
    "accel", {"misalignment": {"m": 1e-2 * (1 - np.eye(3))}, "angle_random_walk": {"N": 1e-2}}
)
PART = Part("test", 1 / STEP, GYRO, ACCEL)


@pytest.fixture(params=[True, False], ids=("compiled", "virtual machine"))
def compiled(request, monkeypatch, tmp_path):
    """Both ways to run: at once compiled, and without a compiler."""
    for name in ("LOOKED_FOR", "WORTHWHILE"):
        monkeypatch.setattr(native, name, 0)
    monkeypatch.setenv("PYIMU_CACHE", str(tmp_path))
    if not request.param:
        monkeypatch.setenv("CC", "no-such-compiler")
    native._machine_code.cache_clear()
    native._loaded.clear()
    yield
    native._machine_code.cache_clear()


def truth(n=N, seed=1, **more):
    rng = np.random.default_rng(seed)
    return Recording.from_arrays(
        name="drive",
        time=STEP * np.arange(n),
        ref_rate=rng.standard_normal((n, 3)),
        ref_force=9 * rng.standard_normal((n, 3)),
        temperature=20 + rng.random(n),
        **more,
    )


def ramp(n, name="ramp"):
    """A truth on straight lines of exact numbers, of which any rows may be left out and drawn
    again.
    """
    k = np.arange(n)[:, None]
    return Recording.from_arrays(
        name=name,
        time=STEP * k[:, 0],
        ref_rate=k * [0.5, -0.25, 1.0],
        ref_force=k * [1.0, 2.0, -0.5],
        temperature=k[:, 0] * 0.125,
    )


def arrays(part, log, seed):
    return simulate(part, log.ref_rate, log.ref_force, log.temperature, seed=seed)


# Arrays


@pytest.mark.parametrize("seed", [None, 0, 2**64 - 1])
def test_arrays_go_through_the_block_bit_for_bit(compiled, seed, monkeypatch):
    monkeypatch.setattr(measure, "PIECE", 64)
    log, block = truth(), PART.block
    w = (
        np.zeros((N, len(block.noise)))
        if seed is None
        else normals(seed, [c.number for c in block.noise], 1, N)
    )
    want, _ = block.run(np.column_stack([log.ref_rate, log.ref_force, log.temperature]), w=w)
    np.testing.assert_array_equal(np.hstack(arrays(PART, log, seed)), want[:, :6])


def test_every_effect_at_once_goes_through_the_block(compiled):
    part = as_part(everything("gyro"), everything("accel"))
    whole = dict(
        zip(
            SIGNALS, np.split(motion(N), np.cumsum([s.size for s in SIGNALS.values()])[:-1], axis=1)
        )
    )
    names = list(dict.fromkeys(v.name.partition("[")[0] for v in part.block.inputs))
    given = {name: whole[name] if SIGNALS[name].size > 1 else whole[name][:, 0] for name in names}
    want, _ = part.block.run(np.hstack([whole[name] for name in names]), seed=3)
    np.testing.assert_array_equal(np.hstack(simulate(part, **given, seed=3)), want[:, :6])
    assert part.sample_period == H and {"supply", "mag", "attitude", "latitude", "velocity"} < set(
        names
    )


def test_constants_stand_for_arrays():
    log = truth()
    want = simulate(PART, log.ref_rate, np.tile([0, 0, 9.8], (N, 1)), np.full(N, 30.0), seed=1)
    np.testing.assert_array_equal(simulate(PART, log.ref_rate, [0, 0, 9.8], 30.0, seed=1), want)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"rate": np.zeros((N, 2))}, "rate has shape"),
        ({"temperature": np.zeros(3)}, "temperature has shape"),
        ({"suply": 3.3}, "unknown input 'suply', did you mean supply"),
        ({"jerk": np.zeros(3)}, "unknown input 'jerk'"),
        ({"rate": 0.0}, r"rate has shape \(\), expected \(n, 3\)"),
        ({"rate": None}, "rate must be an array of real numbers"),
        ({"rate": np.zeros(N)}, "rate has shape"),
        ({"rate": [[1, 2, 3], [4]]}, "rate: its rows are of unequal length"),
        ({"specific_force": np.zeros((N, 3), complex)}, "real numbers, not complex"),
        ({"temperature": "warm"}, "temperature must be .* 'warm'"),
        ({"part": "imt31"}, "did you mean imt30"),
        ({"part": 3}, "a part is a Part, the name of one or a TOML file, not '3'"),
        *(
            ({"seed": seed}, f"seed {seed!r} is not an integer in 0 to")
            for seed in (-1, 2**64, 1.5, "a", np.nan, True)
        ),
        *(
            (
                {"sample_period": h},
                "the sample period must be a positive and finite number of seconds, not",
            )
            for h in (0.0, -0.01, np.nan, np.inf, "h")
        ),
    ],
)
def test_wrong_input_is_refused(given, message):
    with pytest.raises(UserError, match=message) as caught:
        simulate(
            **{"part": PART, "rate": np.zeros((N, 3)), "specific_force": np.zeros((N, 3)), **given}
        )
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("rate", [0, -100.0, np.nan, np.inf, 1e-320, "100", None])
def test_a_part_without_a_sample_rate_is_refused(rate):
    with pytest.raises(
        UserError,
        match="part test: the sample rate must be a positive and finite number of Hz, from 0",
    ):
        Part("test", rate)


def test_a_name_stands_for_a_part():
    motion_ = np.zeros((20, 3)), np.zeros((20, 3))
    np.testing.assert_array_equal(
        simulate("imt30", *motion_, seed=1), simulate(pyimu.part("imt30"), *motion_, seed=1)
    )


@pytest.mark.parametrize("name", one_of_each_kind())
def test_an_unknown_motion_is_an_unknown_measurement(name):
    """Of each kind of part, with its ranges and filters: what is not known is not full scale,
    and is over when it is over.
    """
    rate, force = 0.01 * np.ones((60, 3)), np.tile([0.1, 0.2, 9.8], (60, 1))
    rate[20, 1] = force[30, 2] = np.nan
    gyro, accel = simulate(name, rate, force, seed=1)
    np.testing.assert_array_equal(np.argwhere(np.isnan(gyro)), [[20, 1]])
    np.testing.assert_array_equal(np.argwhere(np.isnan(accel)), [[30, 2]])


def test_saturation_cuts_off_at_either_end():
    part = Part("test", 100.0, Sensor("gyro", {"saturation": {"limit": [1.0, 2.0, 0.0]}}))
    rate = np.array(
        [
            [-3.0, -3.0, -3.0],
            [1.0, -2.0, 0.0],
            [1.0 + 1e-15, np.inf, np.inf],
            [np.nan, np.nan, np.nan],
            [0.5, 3.0, -9.0],
        ]
    )
    want = [
        [-1.0, -2.0, -3.0],
        [1.0, -2.0, 0.0],
        [1.0, 2.0, np.inf],
        [np.nan] * 3,
        [0.5, 2.0, -9.0],
    ]
    np.testing.assert_array_equal(simulate(part, rate, np.zeros(3))[0], want)


def test_missing_input_is_refused():
    with pytest.raises(UserError, match="supply"):
        simulate(
            PART.with_sensor(GYRO.with_values("supply_sensitivity")),
            np.zeros((N, 3)),
            np.zeros((N, 3)),
        )


def test_memory_does_not_grow_with_the_length(compiled, monkeypatch):
    """Beyond the measurements no more is made than for a tenth of the length."""
    rate, force = np.zeros((40_000, 3)), np.zeros((40_000, 3))

    def beyond(n):
        tracemalloc.start()
        measured = simulate(PART, rate[:n], force[:n], seed=1)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return peak - sum(m.nbytes for m in measured)

    monkeypatch.setattr(measure, "PIECE", 1024)
    beyond(1000)  # whatever is made once
    assert beyond(40_000) < beyond(4_000) + 40_000  # a byte a row would be as much


# Recordings


@pytest.mark.parametrize("seed", [None, 5])
def test_recording_is_measured_as_its_arrays_are(seed):
    log = truth()
    simulated = simulate_recording(PART, log, seed=seed)
    gyro, accel = arrays(PART, log, seed)
    np.testing.assert_array_equal(simulated.gyro, gyro)
    np.testing.assert_array_equal(simulated.accel, accel)


def test_all_but_the_measurements_is_kept():
    log = truth(gyro=np.zeros((N, 3)), supply=np.ones(N), moving=np.ones(N))
    log = replace(log, findings=(Finding("stuck_samples", "gyro_x"), Finding("gaps", "time")))
    simulated = simulate_recording(PART, log)
    assert [f.kind for f in simulated.findings] == ["gaps"]
    for group in ("name", "time", "ref_rate", "ref_force", "temperature", "supply", "moving"):
        assert getattr(simulated, group) is getattr(log, group)


@pytest.mark.parametrize("sensor", [GYRO, ACCEL], ids=lambda s: s.kind)
def test_one_sensor_measures_what_it_does_in_its_part(sensor):
    log = truth(gyro=np.zeros((N, 3)), accel=np.zeros((N, 3)))
    alone, whole = simulate_recording(sensor, log, seed=4), simulate_recording(PART, log, seed=4)
    other = {"gyro": "accel", "accel": "gyro"}[sensor.kind]
    np.testing.assert_array_equal(getattr(alone, sensor.kind), getattr(whole, sensor.kind))
    assert getattr(alone, other) is getattr(log, other)


def test_other_seeds_are_other_noise():
    log = truth()
    one, again, other = (simulate_recording(PART, log, seed=s) for s in (1, 1, 2))
    np.testing.assert_array_equal(one.gyro, again.gyro)
    assert (one.gyro != other.gyro).all() and (one.accel != other.accel).all()


def test_rounded_time_stamps_leave_the_parts_own_period():
    part = replace(PART, sample_rate=976.0)
    log = truth(976)
    log = replace(log, time=np.round(np.arange(976) / 976.0, 9))
    assert log.sample_period != part.sample_period
    gyro, _ = simulate(part, log.ref_rate, log.ref_force, log.temperature, seed=1)
    np.testing.assert_array_equal(simulate_recording(part, log, seed=1).gyro, gyro)


def test_another_sample_period_is_the_recordings():
    log = truth()
    gyro, _ = simulate(
        PART, log.ref_rate, log.ref_force, log.temperature, seed=1, sample_period=STEP
    )
    np.testing.assert_array_equal(
        simulate_recording(replace(PART, sample_rate=1.0), log, seed=1).gyro, gyro
    )


# Gaps and missing cells


@pytest.mark.parametrize("piece", [3, 8192])
def test_in_a_gap_the_sensor_runs_on_along_a_straight_line(piece, monkeypatch):
    """Gaps of 7 and 15 samples: shares of 1/8 and 1/16 are exact, so the truth that is drawn is the
    one left out.
    """
    monkeypatch.setattr(measure, "PIECE", piece)
    log = ramp(200)
    rows = np.r_[0:40, 47:90, 105:200]
    cut = Recording.from_arrays(
        name="cut",
        time=log.time[rows],
        **{g: getattr(log, g)[rows] for g in ("ref_rate", "ref_force", "temperature")},
    )
    assert len(cut.segments) == 3
    whole, simulated = simulate_recording(PART, log, seed=6), simulate_recording(PART, cut, seed=6)
    np.testing.assert_array_equal(simulated.gyro, whole.gyro[rows])
    np.testing.assert_array_equal(simulated.accel, whole.accel[rows])


def test_a_long_gap_counts_as_the_longest(monkeypatch):
    monkeypatch.setattr(truth_module, "LONGEST_GAP", 16 * STEP)
    log = ramp(100)
    times = [np.where(log.time < 50 * STEP, log.time, log.time + gap) for gap in (15 * STEP, 1e7)]
    one, other = (simulate_recording(PART, replace(log, time=t), seed=1) for t in times)
    np.testing.assert_array_equal(one.gyro, other.gyro)


def test_missing_truth_is_drawn_straight_and_its_rows_are_missing():
    log = ramp(100)
    rate = log.ref_rate.copy()
    rate[[20, 21, 22, 60], [0, 0, 0, 2]] = np.nan
    temperature = np.where(
        np.arange(100) % 4, np.nan, log.temperature
    )  # known last at row 96, and held from there
    whole = simulate_recording(
        PART, replace(log, temperature=np.minimum(log.temperature, log.temperature[96])), seed=1
    )
    simulated = simulate_recording(
        PART, replace(log, ref_rate=rate, temperature=temperature), seed=1
    )
    known = np.setdiff1d(np.arange(100), [20, 21, 22, 60])
    np.testing.assert_allclose(simulated.gyro[known], whole.gyro[known], rtol=1e-12)
    np.testing.assert_array_equal(simulated.accel, whole.accel)
    assert np.isnan(simulated.gyro[[20, 21, 22, 60]]).all()
    assert [(f.kind, f.column, f.count) for f in simulated.findings] == [
        ("unknown_truth", "gyro", 4)
    ]


def test_missing_attitude_is_held():
    log, q = ramp(6), np.tile([1.0, 0, 0, 0], (6, 1))
    q[3:] = [-0.6, 0.8, 0, 0]
    seen = np.where(np.array([0, 1, 0, 1, 0, 0])[:, None], q, np.nan)
    sensor = GYRO.with_values("earth_rate", k=1.0)
    logs = [replace(log, ref_q=x, latitude=np.full(6, 0.9)) for x in (q, seen)]
    np.testing.assert_array_equal(*(simulate_recording(sensor, log, seed=1).gyro for log in logs))


# Where the truth comes from


def plain(kind, **values):
    return Sensor(kind, values)


def test_without_a_reference_the_part_rests():
    log = Recording.from_arrays(time=STEP * np.arange(50), temperature=np.full(50, 30.0))
    simulated = simulate_recording(PART, log, seed=2)
    np.testing.assert_array_equal(
        np.hstack([simulated.gyro, simulated.accel]),
        np.hstack(simulate(PART, np.zeros((50, 3)), [0, 0, 9.80665], 30.0, seed=2)),
    )


def test_at_rest_the_mean_of_the_accelerometer_is_the_force():
    accel = np.random.default_rng(1).standard_normal((64, 3)) + [1, 2, 9]
    log = Recording.from_arrays(time=STEP * np.arange(64), accel=accel)
    for values in (accel, np.where(np.arange(64)[:, None] < 60, accel, np.nan)):
        y = simulate_recording(plain("accel"), replace(log, accel=values), seed=None).accel
        np.testing.assert_array_equal(y, np.tile(np.nanmean(values, axis=0), (64, 1)))


def test_rate_follows_from_the_reference_attitude():
    """A turn at constant rate: the rate is the one that turns."""
    time, rate = STEP * np.arange(100), np.array([0.3, -0.2, 0.5])
    q = Rotation.from_rotvec(time[:, None] * rate).as_quat(scalar_first=True)
    log = Recording.from_arrays(time=time, ref_q=q)
    np.testing.assert_allclose(
        simulate_recording(plain("gyro"), log).gyro, np.tile(rate, (100, 1)), atol=1e-9
    )


def test_temperature_is_25_degrees_where_none_is_known():
    log = replace(truth(), temperature=None)
    want, _ = simulate(PART, log.ref_rate, log.ref_force, 25.0, seed=1)
    np.testing.assert_array_equal(simulate_recording(PART, log, seed=1).gyro, want)
    assert simulate_recording(PART, log).temperature is None


def test_measured_force_stands_for_an_unknown_one_in_the_gyros_errors_alone():
    accel = truth().ref_force
    log = replace(truth(), ref_force=None, accel=accel)
    want, _ = simulate(PART, log.ref_rate, accel, log.temperature, seed=1)
    np.testing.assert_array_equal(simulate_recording(GYRO, log, seed=1).gyro, want)
    with pytest.raises(UserError, match="ref_force_x"):
        simulate_recording(PART, log)


@pytest.mark.parametrize(
    ("sensor", "without", "column"),
    [
        (GYRO, ["ref_rate"], "ref_rate_x"),
        (GYRO, ["ref_force"], "ref_force_x"),
        (ACCEL, ["ref_force"], "ref_force_x"),
        (plain("gyro", supply_sensitivity={}), [], "no supply:"),
        (plain("gyro", magnetic_sensitivity={}), [], "mag_x"),
        (plain("gyro", earth_rate={}), ["ref_q"], "ref_q_w"),
        (plain("gyro", transport_rate={}), [], "ref_q_w"),
        (plain("accel", size_effect={}), ["ref_rate"], "ref_rate_x"),
    ],
)
def test_what_is_missing_is_named(sensor, without, column):
    """``moving`` rules out that the part rests."""
    log = replace(truth(moving=np.ones(N)), **dict.fromkeys(without))
    with pytest.raises(UserError, match=f"drive: .*{column}"):
        simulate_recording(sensor, log)


def test_heading_alone_gives_no_rate_about_the_other_axes():
    log = replace(truth(), ref_rate=None, ref_heading=np.linspace(0, 1, N))
    with pytest.raises(UserError, match="ref_rate_x"):
        simulate_recording(GYRO, log)


def test_what_no_effect_needs_may_be_missing():
    log = replace(truth(), ref_force=None, temperature=None)
    assert simulate_recording(plain("gyro", scale_factor={"s": 0.1}), log).gyro.shape == (N, 3)


def test_one_row_is_refused():
    with pytest.raises(UserError, match="at least 2"):
        simulate_recording(PART, truth(1))


def test_built_in_part_simulates_a_static_log():
    log = Recording.from_arrays(time=np.arange(2000) / 976.0)
    simulated = simulate_recording(pyimu.part("imt30"), log, seed=1)
    assert np.isfinite(simulated.gyro).all() and simulated.gyro.std() > 0
