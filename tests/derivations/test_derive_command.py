"""The command ``pyimu derive``."""

import json
import sys
from dataclasses import replace

import pytest

from pyimu import cli, derivations
from pyimu.derivations import Derived
from pyimu.derivations.model import Check


def run(monkeypatch, capsys, *words):
    monkeypatch.setattr(sys, "argv", ["pyimu", *map(str, words)])
    with pytest.raises(SystemExit) as end:
        cli.main()
    return end.value.code, *capsys.readouterr()


def test_command_prints_and_writes_the_same(quick, monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(derivations, "derive", lambda say: quick)
    code, out, err = run(monkeypatch, capsys, "derive", "--out", tmp_path / "here")
    report = (tmp_path / "here" / "derivations.txt").read_text(encoding="utf-8")
    assert code == 0 and err == "" and out.startswith(report)
    assert out[len(report) :].split() == [
        str(tmp_path / "here" / f"derivations.{e}") for e in ("txt", "tex", "md")
    ]


def test_command_ends_with_one_where_a_check_fails(quick, monkeypatch, capsys):
    failed = Derived((replace(quick.results[0], checks=(Check("x", 1, 2.0, 1.0),)),))
    monkeypatch.setattr(derivations, "derive", lambda say: failed)
    code, out, _ = run(monkeypatch, capsys, "derive")
    assert code == 1 and "FAILED" in out


def test_its_json_is_the_results_and_quiet_is_silent(quick, monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(derivations, "derive", lambda say: quick)
    code, out, err = run(monkeypatch, capsys, "derive", "--json", "--out", tmp_path)
    data = json.loads(out)
    assert (code, err, data["passed"]) == (0, "", True)
    assert [r["key"] for r in data["results"]] == [r.derivation.key for r in quick.results]
    for told, r in zip(data["results"], quick.results, strict=True):
        assert [e["right"] for e in told["equations"]] == [e.right for e in r.derivation.equations]
        assert [(c["largest"], c["bound"]) for c in told["checks"]] == [
            (c.largest, c.bound) for c in r.checks
        ]
    assert sorted(data["files"]) == sorted(str(p) for p in tmp_path.iterdir())
    assert run(monkeypatch, capsys, "derive", "--quiet") == (0, "", "")
    assert run(monkeypatch, capsys, "derive", "--quiet", "--json")[0] == 2


def test_out_that_is_a_file_is_refused_before_the_work(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(derivations, "derive", lambda say: pytest.fail("worked first"))
    (tmp_path / "file").write_text("")
    code, _, err = run(monkeypatch, capsys, "derive", "--out", tmp_path / "file")
    assert code == 2 and err.count("\n") == 1 and "file" in err
