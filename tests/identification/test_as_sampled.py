"""What samples show of the output by themselves: where they stop, where they are zero, and on the
multiples of which step they lie.
"""

import numpy as np
import pytest
from loop_cases import inputs, trial

from pyimu.identification.noise.rounding import rounding
from pyimu.identification.search.as_sampled import GATE, ceiling_of, threshold_of
from pyimu.identification.search.ceiling import piled
from pyimu.identification.search.forward import investigate
from pyimu.identification.verdict.fates import fates
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.quality.resolution import comb_step, is_written

TIME = np.arange(20_000) * 0.01
NOISE = 2e-3
U = inputs(np.random.default_rng(1), TIME)
N = NOISE * np.sqrt(0.01) * np.ones(3)
PART = Sensor("gyro", {"turn_on_bias": {}, "angle_random_walk": {"N": N}})


def noisy(seed):
    return U[:, OWN["gyro"]] + NOISE * np.random.default_rng(seed).standard_normal((len(TIME), 3))


def found(y, sensor=PART):
    fitted, held = trial(TIME, y, U).split(0.3)
    return investigate(sensor, frozenset(), [fitted], [held])


def fit_of(y):
    """The model as declared, with nothing added, and the rows that are held out."""
    fitted, held = trial(TIME, y, U).split(0.3)
    return investigate(PART, frozenset(), [fitted], [held]).before, [held]


def test_few_samples_that_are_equal_at_the_top_are_a_limit():
    """Five of 20000 samples are cut off, which explains next to nothing of the squares."""
    y = noisy(2)
    limit = np.sort(np.abs(y[:, 1]))[-5]
    y[:, 1] = np.clip(y[:, 1], -limit, limit)
    (step,) = found(y).steps
    assert step.effect == "saturation" and step.as_sampled and step.gain > GATE
    assert found(y).after.sensor.values["saturation"]["limit"] == pytest.approx([0, limit, 0])


@pytest.mark.parametrize("step", [0.0, 0.05, 0.2, 0.5, 1.0, 3.0])
def test_samples_that_stop_nowhere_are_piled_up_nowhere(step):
    """Rounded to any step of the noise, the largest of them is no level, to one in a hundred."""
    rng, q = np.random.default_rng(3), step * NOISE
    piles = []
    for _ in range(100):
        rate = 0.3 * np.sin(2 * np.pi * rng.uniform(0.2, 1.0) * TIME[:3000])[:, None]
        y = rate + NOISE * rng.standard_normal((3000, 3))
        y = q * np.round(y / q) if q else y
        made = trial(TIME[:3000], y, U[:3000])
        piles += [piled([made], i)[1] for i in range(3)]
    # Of 300 at the gate's rate of 0.04 % each, more than 2 are there by chance once in 4000.
    assert np.sum(np.array(piles) > GATE) <= 2


@pytest.mark.parametrize("zone", [0.5, 2.0])
def test_a_hard_dead_zone_shows_by_its_zeros(zone):
    y, d = noisy(4), zone * NOISE
    y[:, 2] = np.where(np.abs(y[:, 2]) > d, y[:, 2], 0.0)
    read = threshold_of(*fit_of(y))
    assert read.effect == "hard_dead_zone" and not read.alternatives
    # The least of some hundred outputs lies as far above the zone as they lie apart.
    assert read.values == pytest.approx([0.0, 0.0, d], rel=0.1)


def test_a_soft_dead_zone_shows_by_its_zeros():
    y, d = noisy(5), NOISE
    y[:, 0] -= np.clip(y[:, 0], -d, d)
    read = threshold_of(*fit_of(y))
    assert read.effect == "dead_zone" and not read.alternatives
    count = np.sum(y[:, 0] == 0.0)
    assert read.values[0] == pytest.approx(d, rel=4 / np.sqrt(count))


def test_samples_that_were_lost_are_no_dead_zone():
    """Zeros at any time, on one axis alone."""
    y = noisy(6)
    y[np.random.default_rng(7).integers(100, len(y), 30), 0] = 0.0
    assert threshold_of(*fit_of(y)) is None


def test_rounded_samples_are_no_dead_zone_and_no_limit():
    for q in (0.1, 1.0, 5.0):
        made = fit_of(q * NOISE * np.round(noisy(8) / (q * NOISE)))
        assert threshold_of(*made) is None and ceiling_of(*made) is None


def test_fault_values_are_no_limit():
    """A code for a fault, beyond all samples, at any time."""
    y = noisy(9)
    y[[3000, 3001, 9000, 12000], 0] = 8.0
    assert ceiling_of(*fit_of(y)) is None


# Combs


@pytest.mark.parametrize("share", [0.01, 0.05, 0.3])
def test_a_comb_far_finer_than_the_noise_is_found(share):
    q = share * NOISE * 1.2345
    assert comb_step(q * np.round(noisy(10)[:, 0] / q)) == pytest.approx(q, rel=1e-6)


def test_samples_on_no_comb():
    """Neither full numbers, nor such of which most lie closer together than others lie apart."""
    y = noisy(11)[:, 0]
    still = np.where(TIME < 150.0, 1e-8 * y, y)
    assert comb_step(y) is None and comb_step(still) is None


@pytest.mark.parametrize("unit", [1.0, np.pi / 180])
def test_the_digits_of_a_file_are_no_step_of_the_sensor(unit):
    digits = unit * np.round(noisy(12)[:, 0] / unit, 5)
    single = unit * (noisy(12)[:, 0] / unit).astype(np.float32).astype(float)
    units = (1.0, np.pi / 180)
    assert is_written(comb_step(digits), np.abs(digits).max(), units)
    step = comb_step(single)
    assert step is None or is_written(step, np.abs(single).max(), units)
    assert not is_written(1.2345e-5, 1.0, units)


def rounded(share, of_increments):
    """Rounding as the loop tells it, of samples or of their integral, and the step."""
    y, q = noisy(13), share * NOISE
    if of_increments:
        y = q * np.diff(np.round(np.cumsum(y, axis=0) / q), axis=0, prepend=0.0)
    else:
        y = q * np.round(y / q)
    inv = found(y)
    return rounding("gyro", inv), inv, q


@pytest.mark.parametrize("of_increments", [False, True])
def test_a_step_as_large_as_the_noise_tells_what_is_rounded(of_increments):
    told, _, q = rounded(2.0, of_increments)
    (added,) = told.added
    (value, _, unit) = added.parameters["q"]
    assert added.effect == ("angle_quantization" if of_increments else "quantization")
    assert not added.alternatives and told.relevant
    assert unit == ("rad" if of_increments else "rad/s")
    assert value == pytest.approx(np.full(3, q * (0.01 if of_increments else 1.0)), rel=1e-6)


def test_a_step_far_below_the_noise_is_one_or_the_other():
    told, inv, _ = rounded(0.0123, True)
    (added,) = told.added
    assert added.effect == "quantization" and added.alternatives == ("angle_quantization",)
    assert not told.relevant, "it adds nothing to the noise"
    (other,) = [f for f in fates("gyro", inv, [added], "") if f.effect == "angle_quantization"]
    assert (other.outcome, other.by) == ("alternative", ("quantization",))


def test_what_was_looked_for_is_not_said_to_be_not():
    inv = found(noisy(14))
    assert not inv.steps and not rounding("gyro", inv).added
    told = {f.effect for f in fates("gyro", inv, [], "")}
    assert not {"quantization", "angle_quantization"} & told
