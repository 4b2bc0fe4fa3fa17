"""A campaign's files: the same bytes however it came to its end, and nothing half written."""

import errno
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import pyarrow as pa
import pytest
from places import CHECKOUT
from pyarrow import parquet

import pyimu
from pyimu.errors import UserError
from pyimu.rover.campaign import made_by, table
from pyimu.rover.campaign.campaign import run
from pyimu.rover.campaign.score import row_of
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.table import BATCH, Folder, batches

RUNS = 2 * BATCH + 5


def settings(**more):
    return Settings(pyimu.part("imt30"), **{"rate": 25.0, "terrains": 1, **more})


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The folder of a campaign that went through at once."""
    out = tmp_path_factory.mktemp("whole")
    run(settings(), RUNS, out, workers=0)
    return out


def table_of(out):
    return (out / "runs.parquet").read_bytes()


def test_the_table_has_a_row_a_run_in_order(whole):
    found = parquet.read_table(whole / "runs.parquet")
    assert found["run"].to_pylist() == list(range(RUNS))
    again = row_of(settings(), RUNS - 2)
    there = {k: v for k, v in found.slice(RUNS - 2, 1).to_pylist()[0].items() if v == v}
    assert there == {k: v for k, v in again.items() if v == v}


def test_every_number_of_the_table_has_its_unit(whole):
    schema = parquet.read_schema(whole / "runs.parquet")
    for field in schema:
        if pa.types.is_floating(field.type):
            assert field.name.endswith("]"), field.name


def test_what_was_broken_off_goes_on_and_ends_in_the_same_bytes(whole, tmp_path):
    class Stop(Exception):
        pass

    def say(text, share=None):
        raise Stop

    with pytest.raises(Stop):
        run(settings(), RUNS, tmp_path, workers=0, say=say)
    assert not (tmp_path / "runs.parquet").exists()
    kept = list((tmp_path / "parts").iterdir())
    done = run(settings(), RUNS, tmp_path, workers=0)
    assert len(kept) == 1 and done.computed == RUNS - BATCH
    assert table_of(tmp_path) == table_of(whole)


def test_the_order_of_the_parts_does_not_matter(whole, tmp_path):
    folder = Folder(tmp_path, settings())
    folder.claim()
    for batch in reversed(batches(RUNS)):
        rows = parquet.read_table(Folder(whole, settings()).part(batch)).to_pylist()
        folder.keep(batch, rows)
    folder.finish(RUNS)
    assert table_of(tmp_path) == table_of(whole)


def test_a_part_that_is_damaged_is_computed_again(whole, tmp_path):
    shutil.copytree(whole, tmp_path, dirs_exist_ok=True)
    part = Folder(tmp_path, settings()).part(batches(RUNS)[1])
    part.write_bytes(part.read_bytes()[:1000])
    assert run(settings(), RUNS, tmp_path, workers=0).computed == BATCH
    assert table_of(tmp_path) == table_of(whole)


def test_a_longer_campaign_keeps_the_runs_that_are_there(whole, tmp_path):
    shutil.copytree(whole, tmp_path, dirs_exist_ok=True)
    assert run(settings(), 3 * BATCH, tmp_path, workers=0).computed == BATCH
    found, before = (parquet.read_table(out / "runs.parquet") for out in (tmp_path, whole))
    assert found.slice(0, RUNS).to_pandas().equals(before.to_pandas())


def test_groups_of_rows_are_of_one_size_whatever_the_parts(monkeypatch):
    monkeypatch.setattr(table, "GROUP", 7)
    tables = [pa.table({"run": list(range(a, b))}) for a, b in ((0, 5), (5, 21), (21, 23))]
    groups = list(table._groups(tables))
    assert [len(g) for g in groups] == [7, 7, 7, 2]
    assert pa.concat_tables(groups)["run"].to_pylist() == list(range(23))


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ({"seed": 1}, "its seed is 0, not 1"),
        ({"drive": "straight"}, "its drive is turn-on-spot, not straight"),
    ],
)
def test_a_folder_of_another_campaign_is_refused(whole, other, words):
    with pytest.raises(UserError, match=f"holds another campaign \\({words}\\)"):
        run(settings(**other), RUNS, whole, workers=0)


def test_a_folder_of_another_part_is_refused(whole):
    with pytest.raises(UserError, match="of another part"):
        run(
            Settings(pyimu.part("stim300"), rate=25.0, terrains=1),
            RUNS,
            whole,
            workers=0,
        )


def test_a_folder_of_other_code_is_refused(whole, monkeypatch):
    """As after a change in a checkout, whose version stays; its parts are not used either."""
    monkeypatch.setattr(table, "made_by", lambda: "0.1.0+other")
    with pytest.raises(
        UserError, match=r"holds another campaign \(its version is .*, not 0.1.0\+o"
    ):
        run(settings(), RUNS, whole, workers=0)
    assert Folder(whole, settings()).missing(RUNS) == batches(RUNS)


def test_the_code_is_told_by_every_file_and_not_by_its_place(tmp_path, monkeypatch):
    def told(folder, **files):
        package = tmp_path / folder
        for name, text in files.items():
            (package / name).mkdir(parents=True)
            (package / name / "a.py").write_bytes(text)
        monkeypatch.setattr(made_by, "PACKAGE", package)
        made_by.made_by.cache_clear()
        return made_by.made_by()

    try:
        same = [told("one", x=b"a\n", y=b"b\n"), told("two", x=b"a\r\n", y=b"b\n")]
        others = [told("three", x=b"a\n", y=b"c\n"), told("four", x=b"b\n", y=b"a\n")]
    finally:
        made_by.made_by.cache_clear()
    assert same[0] == same[1] and len({same[0], *others}) == 3


def test_a_full_disk_is_one_line_and_leaves_what_is_whole(whole, tmp_path, monkeypatch):
    """The disk fills up with the second part; when there is room again the campaign goes on."""
    real, written = parquet.write_table, []

    def write(rows, path):
        if len(written) == 1:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        written.append(path)
        real(rows, path)

    monkeypatch.setattr(table.parquet, "write_table", write)
    with pytest.raises(UserError, match="cannot be written .No space left on device"):
        run(settings(), RUNS, tmp_path, workers=0)
    monkeypatch.undo()
    assert not any(p.name.startswith(".") for p in tmp_path.rglob("*"))
    run(settings(), RUNS, tmp_path, workers=0)
    assert table_of(tmp_path) == table_of(whole)


def test_a_command_that_is_killed_goes_on_where_it_was(whole, tmp_path):
    words = ["imt30", "--rate", "25", "--terrains", "1", "--workers", "0"]
    command = [sys.executable, "-m", "pyimu", "campaign", *words, "--runs", str(RUNS)]
    command += ["--out", str(tmp_path)]
    process = subprocess.Popen(command, cwd=CHECKOUT, stdout=subprocess.DEVNULL)
    while not (list((tmp_path / "parts").glob("0*.parquet")) if tmp_path.exists() else []):
        assert process.poll() is None
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
    run(settings(), RUNS, tmp_path, workers=0)
    assert table_of(tmp_path) == table_of(whole)


@pytest.mark.parametrize("more, file", [([], "report.json"), (["--run", "3"], "run.json")])
def test_the_command_prints_its_json_alone_or_nothing(whole, tmp_path, pyimu, more, file):
    words = ["campaign", "imt30", "--rate", "25", "--terrains", "1", "--workers", "0"]
    words += ["--runs", str(RUNS), "--out", str(tmp_path / "out"), *more]
    if not more:
        shutil.copytree(whole, tmp_path / "out")
    code, out, _ = pyimu(*words, "--json")
    (written,) = tmp_path.rglob(file)
    assert (code, json.loads(out)) == (0, json.loads(written.read_text()))
    assert pyimu(*words, "--quiet")[:2] == (0, "")


def test_the_report_is_of_the_table(whole):
    report = json.loads((whole / "report.json").read_text())
    assert report["runs"] == RUNS
    found = parquet.read_table(whole / "runs.parquet")["heading_error_max [rad]"].to_pylist()
    half = next(q for q in report["errors"]["heading"]["max"] if q["p"] == 0.5)
    assert half["value"] == sorted(found)[RUNS // 2]
    assert "What drives" not in (whole / "report.html").read_text()  # of so few runs
