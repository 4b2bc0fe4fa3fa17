"""The examples run, bad coefficients are refused, and the solver's steps change no sample."""

import numpy as np
import pytest
from modelica_cases import compiler, measured, simulated, vector

from pyimu.model.part_file import part

EXAMPLES = "PyImu.Examples."
REST = {"rate": [0, 0, 0], "force": [0, 0, 9.80665]}


def imt30(rows):
    """What the part measures of these rows (n, 7), sampled every 0.01 s with the seed 1."""
    return part("imt30").block.run(rows, seed=1, sample_period=0.01)[0]


def test_imu_at_rest_is_the_part_at_rest():
    n = 6
    rows = simulated(f"{EXAMPLES}ImuAtRest", n * 0.01, 0.01)
    want = imt30(np.tile([*REST["rate"], *REST["force"], 25.0], (n, 1)))
    np.testing.assert_array_equal(measured(rows)[1:], want)


def test_thermal_ramp_drifts_with_the_temperature():
    """15 degC and 2 K a second."""
    n = 6
    rows = simulated(f"{EXAMPLES}ThermalRamp", n * 0.01, 0.01)
    warm = 15 + 2 * 0.01 * np.arange(1, n + 1)
    want = imt30(np.column_stack([np.tile([*REST["rate"], *REST["force"]], (n, 1)), warm]))
    np.testing.assert_allclose(vector(rows, "imu.gyro")[1:], want[:, :3], rtol=0, atol=1e-15)


def test_turn_on_the_spot_runs_through_all_blocks():
    """At rest before the turn the gyro reads the Earth's rate with its scale factor, and noise: of
    0.07 mrad/sqrt(s) at 10 Hz five standard deviations are 1.1 mrad/s.
    """
    rows = simulated(f"{EXAMPLES}TurnOnTheSpot", 0.5, 0.1)
    gyro = vector(rows, "gyroscope.y")[1:]
    assert np.ptp(gyro, axis=0).all() and np.abs(gyro).max() < 1.2e-3
    heading = rows["headingError"]
    assert abs(heading[0]) < 1e-12 and 0 < abs(heading[-1]) < 0.5 * 1.2e-3


def test_noise_spectra_draw_every_noise():
    rows = simulated(f"{EXAMPLES}NoiseSpectra", 0.03, 0.01)
    for block in ("white", "walk", "markov", "flicker", "ramp"):
        assert np.ptp(vector(rows, f"{block}.y"), axis=0).all(), block


# A bench of one block with its inputs bound

BENCH = "model Bench {block}; end Bench;"


@pytest.mark.parametrize(
    ("block", "said"),
    [
        ("Effects.GaussMarkov.Gyro e(tau={0, 1, 1}, w={0, 0, 0}, x={0, 0, 0})", "tau must not be"),
        ("Effects.AngleRandomWalk.Gyro e(N={-1, 0, 0}, w={0, 0, 0}, x={0, 0, 0})", "N must not be"),
        ("Effects.Lag.Accel e(zeta=5, x={0, 0, 0})", "lag: zeta must not be above 2"),
        (
            "Effects.Misalignment.Gyro e(m={{1,0,0},{0,0,0},{0,0,0}}, x={0, 0, 0})",
            "misalignment: m must have zeros on its diagonal",
        ),
        ("Effects.TimeDelay.Gyro e(td=1, x={0, 0, 0})", "td must not be above 30 sample periods"),
        (
            "Effects.BiasInstability.Gyro e(f_low=1, f_high=2, x={0, 0, 0}, w=fill(0, 18))",
            "f_high must lie 2 to 5 decades above f_low",
        ),
        ("Noise.Normals e(seed=-1, channel={1, 2, 3})", "seed must be a whole number"),
        ("Noise.Normals e(seed=1.5, channel={1, 2, 3})", "seed must be a whole number"),
        ("Noise.Normals e(seed=9.1e15, channel={1, 2, 3})", "not negative, below 2^53"),
        ("Noise.Normals e(seed=1, channel={1.5, 2, 3})", "channel must be whole numbers"),
        ("Noise.GlobalSeed e(seed=-1)", "globalSeed.seed must not be negative"),
        ("ShapingFilters.GaussMarkov e(tau=0, u=0)", "gauss_markov: tau must not be below 1e-06"),
        (
            "ShapingFilters.BiasInstability e(f_low=1, f_high=2, u=fill(0, 6))",
            "f_high must lie 2 to 5 decades above f_low",
        ),
        ("Thermal.Heating e(tau=0, ambient=20)", "tau must not be below"),
        ("Thermal.WarmUp e(tau=0)", "tau must not be below"),
        ("Thermal.Ramp e(duration=0)", "duration must not be below"),
        ("Thermal.Cycle e(period=0)", "period must not be below"),
        ("Rover.Ackermann e(radius=0)", "radius must not be below"),
        ("Rover.Straight e(cruiseSpeed=0)", "cruiseSpeed and length must be above 0"),
        ("Rover.Square e(speed=100)", "a leg or a turn is shorter than rampTime"),
        ("Sensors.Parts.Imt30.Imu e(seed=1)", "unbalanced"),
        ("Effects.ScaleFactor.Gyro e(samplePeriod=0, x={0, 0, 0})", "strictly positive"),
        ("Effects.ScaleFactor.Gyro e(samplePeriod=-1, x={0, 0, 0})", "strictly positive"),
        ("Effects.ScaleFactor.Gyro e(samplePeriod=0.01 + time, x={0, 0, 0})", "not parameter"),
        ("Sensors.Imu e(seed=1, part=PyImu.Sensors.Part.Nosuch)", "Part.Nosuch"),
    ],
)
def test_bad_coefficients_are_refused(block, said):
    """By the library's own words, but for the sample period, which rumoca checks itself, and inputs
    that nothing is connected to, for which a tool lacks equations.
    """
    with pytest.raises(Exception) as caught:
        simulated("Bench", 0.02, 0.01, BENCH.format(block=f"PyImu.{block}"))
    assert said in str(caught.value)


def test_limits_are_inclusive():
    """The values at which a limit is just kept pass."""
    block = "PyImu.Effects.TimeDelay.Gyro e(td=0.3, samplePeriod=0.01, x={0, 0, 0})"
    assert simulated("Bench", 0.02, 0.01, BENCH.format(block=block))["e.y[1]"][-1] == 0


def test_of_an_input_that_jumps_at_a_sample_the_value_after_the_jump_counts():
    """And of one that jumps just after it, the value before."""
    text = """model Bench
      PyImu.Sensors.Sampler at(samplePeriod=0.5, y0={0, 0, 0});
    equation
      at.x = {if time >= 1 then 1 else 0, if time > 1.001 then 1 else 0, time};
    end Bench;"""
    rows = simulated("Bench", 2.0, 0.5, text)
    np.testing.assert_array_equal(rows["at.y[1]"], [0, 0, 1, 1, 1])
    np.testing.assert_array_equal(rows["at.y[2]"], [0, 0, 0, 1, 1])
    np.testing.assert_array_equal(rows["at.y[3]"], [0, 0.5, 1, 1.5, 2])


@pytest.mark.parametrize("step", [0.01, 0.05, 0.5])
def test_a_longer_step_of_the_solver_changes_no_sample(step):
    """With a continuous state beside the sampled blocks, and output every ``step`` s."""
    text = """model Bench
      PyImu.Examples.Excitation motion(samplePeriod=0.01);
      PyImu.Examples.Excitation normals(samplePeriod=0.01, shift=3);
      PyImu.Effects.RateRandomWalk.Gyro walk(samplePeriod=0.01, K={1, 2, 3});
      Real slow(start=1, fixed=true);
    equation
      der(slow) = -slow;
      connect(motion.y, walk.x);
      connect(normals.y, walk.w);
    end Bench;"""
    fine, coarse = (simulated("Bench", 0.5, h, text) for h in (0.01, step))
    every = round(step / 0.01)
    np.testing.assert_array_equal(vector(coarse, "walk.y"), vector(fine, "walk.y")[::every])


def test_an_effect_without_memory_is_continuous_as_well():
    """The same function at every instant, with no sample."""
    text = """model Bench
      PyImu.Effects.ScaleFactorNonlinearity.AccelContinuous e(s2={1, 2, 3});
    equation
      e.x = {time, 2*time, -time};
    end Bench;"""
    rows, t = simulated("Bench", 1.0, 0.125, text), np.arange(9) * 0.125
    x = np.column_stack([t, 2 * t, -t])
    np.testing.assert_array_equal(vector(rows, "e.y"), x + [1.0, 2.0, 3.0] * (x * x))


def test_an_array_given_element_by_element_is_read_late_by_rumoca():
    """Why the library's equations give arrays whole. Where this fails, rumoca has mended it."""
    rumoca, _ = compiler()
    text = """model Bench
      PyImu.Examples.Excitation motion(samplePeriod=0.01);
      Real parts[3];
      Real whole[3];
      discrete Real late(start=0, fixed=true);
      discrete Real right(start=0, fixed=true);
    equation
      parts[1] = motion.y[1];
      parts[2] = motion.y[2];
      parts[3] = motion.y[3];
      whole = {motion.y[1], motion.y[2], motion.y[3]};
      when sample(0.01, 0.01) then
        late = parts[1];
        right = whole[1];
      end when;
    end Bench;"""
    rows = simulated("Bench", 0.2, 0.01, text)
    np.testing.assert_array_equal(rows["right"], rows["motion.y[1]"])
    if rumoca.version().endswith("0.10.2"):
        np.testing.assert_array_equal(rows["late"][1:], rows["motion.y[1]"][:-1])
