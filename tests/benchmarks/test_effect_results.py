"""How the cases of ``benchmarks/effects.py`` are judged and counted."""

import numpy as np
from effect_results.coverage import covered, ratios
from effect_results.judge import outcome, said, why
from effect_results.table import confusion, failures, rows


def added(effect, sensor="gyro", alternatives=(), **parameters):
    return {
        "sensor": sensor,
        "effect": effect,
        "alternatives": list(alternatives),
        "parameters": parameters,
    }


def result(truth="lag", *found, verdict="clean", name="one/8/gyro.x", **more):
    """A record with one true effect of the gyro, or none."""
    one = {
        "kind": "gyro",
        "term": truth,
        "effect": truth,
        "parameter": "p",
        "value": [1.0, 2.0],
        "size": 8.0,
        "slow": False,
    }
    base = {
        "name": name,
        "number": 0,
        "form": "declared",
        "motions": ["rover"],
        "truths": [] if truth is None else [one],
        "verdict": "named" if found else verdict,
        "reason": "",
        "added": list(found),
        "changed": [],
        "refused": [],
        "drift": [],
        "unexplained": [],
        "candidates": [],
        "visible": {"gyro.lag": "", "gyro.earth_rate": "the log lacks latitude"},
        "quality": [],
        "errors": {"gyro": {"before": 3.0, "after": 2.1, "true": 2.0}},
    }
    return base | more


def nameless(*found, **more):
    record = result("popcorn", *found, name="unknown/30/gyro.popcorn", **more)
    record["truths"][0]["effect"] = ""
    return record


def test_outcomes():
    lag, cubic = added("lag"), added("scale_factor_cubic")
    refused = [{"sensor": "gyro", "effect": "lag", "gain": 9.0, "reason": "so"}]
    assert outcome(result("lag", lag)) == "right"
    assert outcome(result("lag", lag, cubic)) == "beside"
    assert outcome(result("lag", cubic)) == "wrong"
    assert outcome(result("lag", added("lag", "accel"))) == "wrong"
    assert outcome(result("lag")) == "missed"
    assert outcome(result("lag", verdict="drift")) == "drift"
    assert outcome(result("lag", refused=refused, verdict="not_confirmed")) == "refused"
    assert outcome(result(None)) == "right"
    assert outcome(result(None, cubic)) == "wrong"
    assert outcome({"truths": [], "failed": "IndexError"}) == "failed"


def test_a_confound_is_right_only_where_it_is_listed_and_the_alternatives_name_the_truth():
    assert outcome(result("lag", added("time_delay", alternatives=["lag"]))) == "right"
    assert outcome(result("lag", added("time_delay"))) == "wrong"
    ramp = added("rate_ramp", alternatives=["lag"])
    assert outcome(result("lag", ramp)) == "wrong"
    assert outcome(result("lag", ramp, nat_apart={"rate_ramp lag": 5.9})) == "right"
    assert outcome(result("lag", ramp, nat_apart={"rate_ramp lag": 6.1})) == "wrong"
    assert outcome(result("lag", added("rate_ramp"), nat_apart={"rate_ramp lag": 0.0})) == "wrong"


def test_a_walk_that_may_be_another_noise_is_right_where_that_is_listed():
    changed = {"changed": [["gyro", "rate_random_walk", "K"]], "verdict": "drift"}
    others = {"gyro.rate_random_walk": ["gauss_markov"]}
    assert outcome(result("gauss_markov", **changed, instead=others)) == "right"
    assert outcome(result("gauss_markov", **changed)) == "drift"
    assert outcome(result("lag", **changed, instead=others)) == "drift"


def test_a_failure_says_why():
    refused = [{"sensor": "gyro", "effect": "lag", "gain": 9.0, "reason": "held-out data lose"}]
    assert why(result("lag", refused=refused)) == "refused: held-out data lose"
    assert why(result("lag")) == "clean"
    assert "gyro.warm_up is not looked for;" in why(result("warm_up"))
    assert "not looked for, the log lacks latitude" in why(result("earth_rate"))
    assert why(nameless()) == "clean"
    assert why({"truths": [], "failed": "IndexError in f: g"}) == "IndexError in f: g"


def test_a_clock_that_the_finding_gives_to_the_reference_is_right():
    assert outcome(result("clock_skew", quality=["reference_clock"])) == "right"
    assert outcome(result("clock_skew")) == "missed"
    assert outcome(result("clock_skew", added("lag"), quality=["reference_clock"])) == "beside"
    assert outcome(result("lag", quality=["reference_clock"])) == "missed"


def test_changed_values_are_named_where_they_are_no_noise():
    changed = [["gyro", "scale_factor", "s"]]
    assert outcome(result("scale_factor", changed=changed)) == "right"
    assert outcome(result("lag", changed=changed)) == "wrong"
    noise = [["gyro", "rate_random_walk", "K"]]
    assert outcome(result("lag", changed=noise)) == "missed"
    assert outcome(result("rate_random_walk", changed=noise)) == "right"
    assert outcome(result("rate_random_walk", drift=["gyro"], verdict="drift")) == "right"


def test_the_nameless_are_rightly_unexplained():
    seen = [{"sensor": "gyro", "axis": "x", "depends_on": ["rate"], "p_value": 1e-9}]
    assert outcome(nameless(unexplained=seen)) == "right"
    assert said(nameless(unexplained=seen)) == ["(unexplained)"]
    assert outcome(nameless(added("found_effect"))) == "right"
    assert outcome(nameless(added("lag"), unexplained=seen)) == "wrong"
    assert outcome(nameless()) == "missed"
    like_a_field = nameless(added("magnetic_sensitivity"))
    assert outcome(like_a_field) == "wrong"
    like_a_field["truths"][0]["term"] = "heading_locked"
    assert outcome(like_a_field) == "right"


def test_two_effects_count_when_both_are_named():
    lag, cubic = added("lag"), added("scale_factor_cubic")
    pair = result("lag", lag)
    pair["truths"].append(pair["truths"][0] | {"effect": "scale_factor_cubic"})
    assert outcome(pair) == "partly"
    assert outcome(pair | {"added": [lag, cubic]}) == "right"
    assert outcome(pair | {"added": [lag, cubic, added("warm_up")]}) == "beside"
    assert outcome(pair | {"added": []}) == "missed"


def test_the_confusion_counts_every_case_once_for_each_name():
    lag, cubic = added("lag"), added("scale_factor_cubic")
    records = [result("lag", lag), result("lag", lag, cubic), result("lag"), result(None)]
    assert confusion(records) == {
        "gyro lag": {"lag": 2, "scale_factor_cubic": 1, "(nothing)": 1},
        "(none)": {"(nothing)": 1},
    }
    assert said(result("lag", added("lag", "accel"))) == ["accel lag"]
    assert failures(records)["gyro lag"] == {"right": 1, "beside": 1, "missed": 1}


def test_the_rates_of_the_table():
    records = [result("lag", added("lag")), result("lag"), nameless(), nameless(added("lag"))]
    records += [result(None, name="clean/rover"), result(None, added("lag"), name="clean/rover")]
    found = {r.name: (r.count, r.of) for r in rows(records)}
    assert found["one log, 8 sigmas, right class, nothing beside"] == (1, 2)
    assert found["clean, rover: blamed"] == (1, 2)
    assert found["unknown, 30 sigmas: named with confidence"] == (1, 2)
    assert found["unknown, 30 sigmas: said, or a formula"] == (0, 2)
    assert found["unknown, 30 sigmas: given a formula"] == (0, 0)


def test_coverage_and_ratio():
    """Two entries 1 and 3 standard errors off, and one that was not estimated."""
    estimate = {"value": [1.1, 2.3], "std": [0.1, 0.1], "unit": "1"}
    record = result("lag", added("lag", p=estimate))
    assert covered([record], slow=False) == (1, 2)
    assert covered([record], slow=True) == (0, 0)
    estimate["std"] = [0.1, 0.0]
    assert covered([record], slow=False) == (1, 1)
    np.testing.assert_allclose(ratios([record]), [1.05])
