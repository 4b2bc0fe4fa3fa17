"""The verdict's logic alone, over whatever evidence there may be: what each word must not stand
beside.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pyimu.identification.fit.score import ErrorSums
from pyimu.identification.found.entries import Added, Changed, Errors
from pyimu.identification.search.investigation import Refused
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.verdict.ranges import beyond
from pyimu.identification.verdict.verdict import (
    FAR,
    NO_EFFECT,
    SHORT,
    VERDICTS,
    Evidence,
    Verdict,
    verdict,
)
from pyimu.recording.quality.inspect import beyond_range
from pyimu.recording.recording import Recording

ROWS = np.full(3, 100.0)
KINDS = ("gyro", "accel")


def sums(rms) -> ErrorSums:
    """Errors of such a size by axis over a hundred rows; NaN for an axis without rows."""
    known = np.isfinite(rms)
    return ErrorSums(np.where(known, np.square(rms), 0.0) * ROWS, np.where(known, ROWS, 0.0))


def errors(after, floor, drift=None) -> Errors:
    made = None if floor is None else sums(np.broadcast_to(floor, 3))
    wander = None if drift is None else sums(np.broadcast_to(drift, 3))
    return Errors("rad/s", sums(after), sums(after), made, wander)


sizes = st.one_of(st.floats(0.0, 20.0), st.just(float("nan")))
levels = st.floats(0.0, 5.0)
of_a_sensor = st.builds(
    errors,
    st.lists(sizes, min_size=3, max_size=3).map(np.array),
    st.one_of(st.none(), levels),
    st.one_of(st.none(), levels),
)
by_sensor = st.dictionaries(st.sampled_from(KINDS), of_a_sensor)
added = st.builds(
    Added,
    st.sampled_from(KINDS),
    st.sampled_from(["scale_factor", "found_effect"]),
    st.just(()),
    st.just({}),
    st.just(100.0),
    st.just(7.0),
)
refused = st.tuples(
    st.sampled_from(KINDS),
    st.builds(Refused, st.just("coning"), st.floats(7.0, 1e4), st.sampled_from([*NO_EFFECT, "no"])),
)
unexplained = st.builds(
    Unexplained,
    st.sampled_from(KINDS),
    st.sampled_from("xyz"),
    st.just(("rate_x",)),
    st.just(1e-6),
    st.sampled_from(["", "popcorn"]),
)


def few(items):
    return st.lists(items, max_size=2).map(tuple)


words = st.sampled_from(["named", "not_confirmed", "undecidable", "unexplained"])
evidence = st.builds(
    Evidence,
    examined=st.sampled_from([("gyro",), ("gyro", "accel")]),
    unexamined=st.sampled_from([{}, {"accel": "no reference of its force"}]),
    unfit=st.sampled_from(["", "another body"]),
    shows=st.booleans(),
    rows=st.sampled_from([SHORT - 1, SHORT, 10_000]),
    added=few(added),
    unexplained=few(unexplained),
    drift=st.sampled_from([{}, {"gyro": {}}, {"gyro": {0: 9.0}}]),
    refused=few(refused),
    errors=by_sensor,
    by_log=st.dictionaries(st.sampled_from(["one", "two"]), by_sensor),
    band_hz=st.just({"gyro": 12.0}),
    beside=st.one_of(st.none(), st.builds(Verdict, words, st.just("the magnetometer"))),
    formulas=st.sampled_from([{}, {"found_effect": "w x f"}]),
    unshown=st.sampled_from([(), ("its scale factor",)]),
)

some = st.floats(1e-3, 5.0)
quiet = st.fixed_dictionaries({"gyro": st.builds(errors, st.just(np.ones(3)), some, some)})
"""A sensor whose error is given, above noise of any level: of the evidence that leaves nothing but
this to decide.
"""


def far(e: Errors) -> float:
    """The largest ratio of what is left to its noise, of all axes together and of each."""
    axes = e.after.per_axis / np.hypot(e.floor.per_axis, e.drift.per_axis)
    return max(axes.max(), e.after.total / e.noise)


@settings(deadline=None, max_examples=400)
@given(evidence)
def test_clean_stands_beside_nothing_that_speaks_against_it(e):
    found = verdict(e)
    assert found.word in VERDICTS
    if found.word != "clean":
        assert found.reason
        return
    assert not (e.unfit or e.added or e.unexplained or e.unexamined) and e.beside is None
    assert all(r.reason in NO_EFFECT for _, r in e.refused)
    assert not any(e.drift.values())
    assert e.shows and e.rows >= SHORT and not e.unshown
    assert {*e.examined} <= {*e.errors}
    assert all(e.errors[k].after.total <= FAR * e.errors[k].noise for k in e.examined)


@settings(deadline=None, max_examples=200)
@given(quiet, st.dictionaries(st.sampled_from(["one", "two", "three"]), quiet))
def test_clean_stands_within_three_floors_of_each_axis_and_log_alone(whole, logs):
    """Of several logs and axes the limit is where one in a hundred results has one beyond it by
    chance: below four standard errors for up to a hundred and fifty axes.
    """
    found = verdict(Evidence(("gyro",), {}, "", True, SHORT, errors=whole, by_log=logs))
    assert found.word in ("clean", "unexplained")
    assert (found.word == "clean") <= (far(whole["gyro"]) <= FAR)
    worst = max((far(by["gyro"]) for by in logs.values()), default=0.0)
    assert (found.word == "clean") <= (worst < 4.0)
    assert (found.word == "unexplained") <= (max(worst, far(whole["gyro"])) > FAR)


@pytest.mark.parametrize("added", [(), (Added("gyro", "lag", (), {}, 9.0, 7.0),)])
def test_one_axis_far_above_its_own_noise_is_not_lost_among_the_others(added):
    """All axes together lie 1.02 floors high, x alone ten."""
    loud = Errors("rad/s", sums([10, 35, 35]), sums([10, 35, 35]), sums([1, 35, 35]))
    found = verdict(
        Evidence(("gyro",), {}, "", True, SHORT, added, errors={"gyro": loud}, band_hz={"gyro": 8})
    )
    assert found.word == ("partly" if added else "unexplained")
    said = " ".join([found.reason, *found.remarks])
    assert "the gyro residual below 8.00 Hz is 10 times its noise on x" in said


def test_one_log_far_above_the_noise_is_not_lost_among_the_others():
    near, loud = (errors(np.full(3, v), 1.0) for v in (1.0, 8.0))
    logs = {f"log{i}": {"gyro": near} for i in range(9)} | {"bad": {"gyro": loud}}
    whole = sum((by["gyro"] for by in logs.values()), start=errors(np.full(3, np.nan), None))
    whole = Errors("rad/s", whole.before, whole.after, sums(np.ones(3)))
    found = verdict(Evidence(("gyro",), {}, "", True, SHORT, errors={"gyro": whole}, by_log=logs))
    assert whole.after.total < FAR and found.word == "unexplained"
    assert "8.0 times its noise on x in bad" in found.reason


@pytest.mark.parametrize("added", [(), (Added("gyro", "lag", (), {}, 9.0, 7.0),)])
@pytest.mark.parametrize("times, much", [(2.9, False), (24.0, True)])
def test_noise_that_no_part_has_is_more_than_noise(added, times, much):
    """A floor that follows the residual would call anything noise."""
    declared = np.array([1e-3, 0.0, 1e-3])
    noise = Changed(
        "gyro", "angle_random_walk", "N", declared, declared * [1, 1, times], np.zeros(3), "rad"
    )
    level = errors(np.ones(3), 1.0)
    found = verdict(
        Evidence(("gyro",), {}, "", True, SHORT, added, (noise,), errors={"gyro": level})
    )
    assert found.word == (("partly", "unexplained") if much else ("named", "clean"))[not added]
    said = " ".join([found.reason, *found.remarks])
    assert ("the gyro noise is 24 times what is declared on z" in said) == much


def test_a_sensor_without_held_out_rows_is_not_called_clean():
    found = verdict(Evidence(("gyro",), {}, "", True, SHORT))
    assert found.word == "undecidable" and "no held-out row" in found.reason


@pytest.mark.parametrize("left, word", [(8.0, "undecidable"), (40.0, "unexplained")])
def test_what_positions_leave_open_of_coefficients_is_not_blamed_on_the_sensor(left, word):
    """Ten floors may be left open: eight are no sign of anything, and not clean either."""
    seen = sums(np.full(3, left))
    known = Errors("m/s^2", seen, seen, sums(np.ones(3)), unsure=sums(np.full(3, 10.0)))
    found = verdict(Evidence(("accel",), {}, "", True, SHORT, errors={"accel": known}))
    assert found.word == word, found.reason
    assert f"{left:.0f}" in found.reason or f"{left:.1f}" in found.reason
    assert ("leave open" in found.reason) == (word == "undecidable")


def test_samples_beyond_the_declared_range_are_said_first():
    time = np.arange(300) / 100
    gyro = np.column_stack([4 * np.sin(time), 0 * time, 0 * time])
    log = Recording.from_arrays("log", time=time, gyro=gyro)
    found = beyond_range(log, {"gyro": np.array([3.0, 3.0, 0.0]), "accel": np.ones(3)})
    assert [(f.column, f.detail["largest"]) for f in found] == [("gyro_x", np.max(np.abs(gyro)))]
    assert found[0].count == np.sum(np.abs(gyro) > 1.02 * 3.0)
    level = errors(np.ones(3), 40.0)
    e = Evidence(("gyro",), {}, "", True, SHORT, errors={"gyro": level}, ranges=beyond(found))
    assert "go up to 229 deg/s, beyond the 172 deg/s" in verdict(e).remarks[0]


@pytest.mark.parametrize("left, word", [(8.0, "undecidable"), (40.0, "unexplained")])
def test_what_the_fitted_rows_leave_open_on_one_axis_is_not_blamed_either(left, word):
    """In all axes together it is within three floors."""
    seen, unsure = sums(np.array([1.0, 1.0, left])), sums(np.array([0.0, 0.0, 10.0]))
    whole = Errors("rad/s", seen, seen, sums(np.full(3, 1.0)), unsure=unsure)
    found = verdict(Evidence(("gyro",), {}, "", True, SHORT, errors={"gyro": whole}))
    assert found.word == word, found.reason
    assert ("the fitted rows leave open" in found.reason) == (word == "undecidable")
    assert ("give a log to fit that moves so" in found.reason) == (word == "undecidable")


@pytest.mark.parametrize("unexamined", [{}, {"accel": "no reference of its force"}])
@pytest.mark.parametrize("size, word", [(2.9, "clean"), (40.0, "drift")])
def test_what_only_a_sum_over_seconds_shows_is_not_called_clean(size, word, unexamined):
    """The rows lie within their noise, the integral over 10 s of one axis far above what noise and
    the largest walk make of it: a bias that stepped where the reference has a gap.
    """

    def over_windows(angle):
        return replace(sums(np.ones(3)), angle_squares=np.square(angle) * ROWS, windows=ROWS)

    seen, floor = over_windows(np.array([0.5, size, 0.5])), over_windows(np.full(3, 0.01))
    slow = over_windows(np.ones(3))
    whole = Errors("rad/s", seen, seen, floor, ErrorSums(), slow=slow)
    e = Evidence(("gyro",), unexamined, "", True, SHORT, errors={"gyro": whole})
    found = verdict(e)
    assert found.word == ("undecidable" if word == "clean" and unexamined else word)
    assert ("40 times" in found.reason and "on y" in found.reason) == (word == "drift")
    unknown = replace(whole, slow=None)
    assert verdict(replace(e, errors={"gyro": unknown})).word != "drift"


@settings(deadline=None, max_examples=100)
@given(st.lists(st.floats(0.1, 10.0), min_size=6, max_size=6))
def test_slow_errors_of_several_logs_add_up_by_their_windows(sizes):
    """The mean square of both is expected, each beside its own floor."""
    made = [
        Errors("rad/s", *3 * (one,), slow=replace(one, angle_squares=4.0 * one.angle_squares))
        for one in (
            replace(sums(np.ones(3)), angle_squares=np.square(s) * ROWS, windows=ROWS)
            for s in (sizes[:3], sizes[3:])
        )
    ]
    expected = np.sqrt(5.0 * (np.square(sizes[:3]) + np.square(sizes[3:])) / 2.0)
    np.testing.assert_allclose((made[0] + made[1]).expected_slow, expected)


def test_an_axis_that_shows_one_value_all_the_time_is_not_called_clean():
    quiet = {"accel": errors(np.ones(3), 1.0)}
    clean = Evidence(("accel",), {}, "", True, 100 * SHORT, errors=quiet)
    assert verdict(clean).word == "clean"
    stands = verdict(replace(clean, dead=("the accelerometer's z",)))
    assert stands.word == "undecidable" and "the accelerometer's z" in stands.reason
