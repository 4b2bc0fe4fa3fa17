"""The runner that the benchmarks of many cases share: it resumes, and mixes no two versions."""

import json
import math

import pytest
from runs.intervals import wilson
from runs.pool import digest, finished, run_all
from scipy.stats import binomtest


def square(number):
    return {"square": number**2}


def doubled(number):
    return {"square": 2 * number}


def never(number):
    raise AssertionError("a finished case was run again")


def keys(count):
    return [(k,) for k in range(count)]


def test_a_stopped_run_goes_on_where_it_was(tmp_path):
    """A run of three cases, a line that its end tore, then a run of five."""
    file = tmp_path / "results.jsonl"
    first = run_all(square, keys(3), file, "v1", jobs=1)
    assert first == {str(k): {"square": k**2} for k in range(3)}
    with file.open("a") as torn:
        torn.write('{"key": "3", "code": "v1", "resu')
    told = []
    whole = run_all(square, keys(5), file, "v1", jobs=2, tell=lambda key, _: told.append(key))
    assert sorted(told) == ["3", "4"]
    assert whole == {str(k): {"square": k**2} for k in range(5)}
    assert finished(file, "v1") == whole
    assert run_all(never, keys(5), file, "v1", jobs=1) == whole


def test_results_of_other_code_are_not_used(tmp_path):
    file = tmp_path / "results.jsonl"
    run_all(square, keys(3), file, "v1", jobs=1)
    assert run_all(doubled, keys(3), file, "v2", jobs=1)["2"] == {"square": 4}
    assert finished(file, "v1")["2"] == finished(file, "v2")["2"] == {"square": 4}
    assert finished(file) == finished(file, "v2")
    assert len(file.read_text().splitlines()) == 6


def test_a_failing_case_leaves_what_is_finished(tmp_path):
    file = tmp_path / "results.jsonl"
    run_all(square, keys(2), file, "v1", jobs=1)
    with pytest.raises(AssertionError, match="run again"):
        run_all(never, keys(4), file, "v1", jobs=1)
    assert len(finished(file, "v1")) == 2


def test_two_runs_do_not_write_to_one_file(tmp_path):
    file = tmp_path / "results.jsonl"

    def meanwhile(key, result):
        with pytest.raises(RuntimeError, match="another run"):
            run_all(square, keys(1), file, "v1", jobs=1)

    run_all(square, keys(1), file, "v1", jobs=1, tell=meanwhile)
    assert len(file.read_text().splitlines()) == 1
    assert json.loads(file.read_text())["key"] == "0"


def test_the_digest_follows_the_sources(tmp_path):
    (tmp_path / "a.py").write_text("x = 1\n")
    before = digest(tmp_path)
    (tmp_path / "a.txt").write_text("not a source")
    assert digest(tmp_path) == before
    (tmp_path / "a.py").write_text("x = 2\n")
    assert digest(tmp_path) != before
    assert digest(tmp_path / "a.py") != digest(tmp_path / "a.txt")


@pytest.mark.parametrize("count, of", [(0, 20), (3, 44), (20, 20), (51, 51)])
def test_wilson_interval_of_scipy(count, of):
    low, high = binomtest(count, of).proportion_ci(0.95, method="wilson")
    assert math.isclose(wilson(count, of)[0], low, abs_tol=1e-7)
    assert math.isclose(wilson(count, of)[1], high, abs_tol=1e-7)
