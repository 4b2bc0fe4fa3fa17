"""A body that turns evenly from the first sample on, as on a turntable, or rests there."""

from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import GRAVITY, H
from drives import bodies

from pyimu.attitude import run
from pyimu.attitude.even_turns import ALIKE, with_later_rests
from pyimu.attitude.rest import EvenTurn, find_rest
from pyimu.recording.recording import Recording

N, TURN = 1e-4, 0.02
"""rad/sqrt(s), of the gyro; rad/s, of the table."""


def turned(*rates: float, seconds: float = 15.0, seed: int = 0) -> Recording:
    """A level body that turns by each of the ``rates`` rad/s for so many ``seconds``, in between
    for 2 s by a rate that changes evenly.
    """
    rng, n = np.random.default_rng([7, seed]), round(seconds / H)
    parts = [np.full(n, rates[0])]
    for before, after in zip(rates[:-1], rates[1:], strict=True):
        parts += [np.linspace(before, after, round(2 / H)), np.full(n, after)]
    rate = np.concatenate(parts)
    gyro = N / H**0.5 * rng.standard_normal((len(rate), 3)) + 0.005
    accel = 1e-3 / H**0.5 * rng.standard_normal((len(rate), 3)) + [0.0, 0.0, GRAVITY]
    gyro[:, 2] += rate
    return Recording.from_arrays(time=H * np.arange(len(rate)), gyro=gyro, accel=accel)


def of_log(recording: Recording) -> EvenTurn:
    return with_later_rests(find_rest(recording), recording).even


@pytest.mark.parametrize(
    "rates",
    [(0.0,), (0.0, TURN, 0.0), (0.0, TURN, 0.0, -TURN, 0.0, TURN), (0.0, TURN), (0.0, TURN) * 2],
)
def test_a_rest_that_comes_back_as_often_as_any_turn_is_one(rates):
    assert of_log(turned(*rates)) == EvenTurn()


def test_a_turn_between_rests_that_are_alike_is_none_of_the_bias():
    """The rests' means are known to 5e-5 rad/s."""
    even = of_log(turned(TURN, 0.0, -TURN / 2, 0.0))
    assert even.turn == pytest.approx(TURN, abs=2e-4) and even.std == ALIKE


@pytest.mark.parametrize("drift", [3e-4, 1.5e-3])
def test_a_bias_that_warms_is_no_turn(drift):
    assert of_log(turned(0.0, drift, drift)) == EvenTurn()


def test_of_two_levels_that_come_equally_often_either_may_be_the_rest():
    """By even odds: no gyro tells, and the attitude claims as much of its heading."""
    log = turned(TURN, 0.0, -TURN / 2, 0.0, -TURN / 2, seconds=6.0)
    even = of_log(log)
    away = np.sqrt((TURN**2 + (1.5 * TURN) ** 2) / 2)
    assert even.in_doubt and even.std == pytest.approx(away, rel=0.02)
    found = run(log)
    assert found.heading_std[-1] > 0.9 * even.std * log.time[-1]
    assert found.tilt_std[-1] < 0.02
    assert [f.kind for f in found.findings if f.kind == "even_turn"]


def test_a_log_that_begins_without_forces_or_swings_in_its_first_second_is_taken_as_it_is():
    """Either had no level second: nothing was looked at, and the run ended in an error."""
    log = turned(TURN, 0.0, -TURN / 2, 0.0)
    accel = log.accel.copy()
    accel[: round(0.4 / H)] = np.nan
    late = Recording.from_arrays(time=log.time, gyro=log.gyro, accel=accel)
    assert of_log(late).turn == pytest.approx(TURN, abs=2e-4)
    leaning = replace(find_rest(log), force=GRAVITY * np.array([0.5, 0.0, 0.866]))
    assert with_later_rests(leaning, log) == leaning


def test_a_turntable_that_turns_from_the_start_is_known_by_its_stops():
    """Its headings were off by up to hundreds of degrees, and a ten-thousandth of that claimed."""
    for seed in range(3):
        log = bodies.turntable(np.random.default_rng([106, seed]), -5.0)
        found = run(Recording.from_arrays(time=log.time, gyro=log.gyro, accel=log.accel))
        w, x, y, z = log.q.T
        off = found.euler[:, 2] - np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        off = (off - off[0] + np.pi) % (2 * np.pi) - np.pi
        assert np.mean((off[1000:] / found.heading_std[1000:]) ** 2) < 3
        if not found.rest.even.in_doubt:
            assert np.degrees(np.abs(off)).max() < 10
