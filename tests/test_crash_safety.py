"""Whatever ends a run, no half file is left, and the next one gives what the first would have; two
runs do not write to one folder; what a kill leaves is cleaned after a day.
"""

import errno
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest
import typer
from killed import COMMANDS, QUICK
from places import CHECKOUT, linked

from pyimu.errors import UserError
from pyimu.files import PREFIX, whole
from pyimu.files.held import Held, work_folder

KILLED = Path(__file__).parent / "support" / "killed.py"


def kill(folder, times, names):
    """Lines of ``killed.py``, one a command."""
    environment = os.environ | {"PYTHONPATH": f"{CHECKOUT}{os.pathsep}{KILLED.parent}"}
    done = subprocess.run(
        [sys.executable, KILLED, folder, str(times), *names],
        capture_output=True,
        text=True,
        timeout=1800,
        check=False,
        env=environment,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def check_killed(lines, names):
    assert len(lines) == len(names)
    for line, name in zip(lines, names, strict=True):
        assert re.fullmatch(rf"{name}: killed \d+; ", line), line


forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="kills by signals")


@forks
def test_killed_at_random_moments(tmp_path):
    """Twice each of what takes a second or two; nearly all kills come before the end."""
    check_killed(kill(tmp_path, 2, QUICK), QUICK)


@forks
@pytest.mark.long
def test_every_command_that_writes_killed_twenty_times(tmp_path):
    check_killed(kill(tmp_path, 20, COMMANDS), COMMANDS)


def test_every_command_that_has_a_folder_for_results_is_killed_and_held():
    """Of the commands' own options: one that is new is in both lists, or in none."""
    from pyimu.cli import app

    writes = {
        command.name
        for command in typer.main.get_command(app).commands.values()
        if any({"--out", "--new"} & set(option.opts) for option in command.params)
    }
    assert writes == {words[0] for words in COMMANDS.values()} == {*WITH_FOLDER, "parts"}


HOLDER = """
import sys
from pathlib import Path
from pyimu.files.held import held
with held.holding():
    held.hold(Path(sys.argv[1]))
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(tmp_path):
    """A process that holds the folder ``out``."""
    command = [sys.executable, "-c", HOLDER, tmp_path / "out"]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "held\n"
    yield process
    process.kill()
    process.communicate()


WITH_FOLDER = {
    "attitude": ("log.csv",),
    "build": ("imt30",),
    "campaign": ("imt30", "--workers", "0"),
    "characterize": ("log.csv",),
    "close": ("log.csv", "--part", "imt30"),
    "demo": (),
    "derive": (),
    "export": ("mpu6050", "--to", "vins"),
    "heading": ("log.csv",),
    "inspect": ("log.csv",),
    "modelica": ("imt30",),
    "navigate": ("log.csv", "--part", "imt30"),
    "plan": ("mpu6050", "--for", "scale_factor"),
    "rover": (),
}
"""The commands that write to a folder, with what they need besides."""


@pytest.mark.parametrize("name", WITH_FOLDER)
def test_a_folder_that_another_run_holds_is_refused_before_any_work(name, holder, pyimu, tmp_path):
    """Before the log is read, which is not there."""
    code, said, err = pyimu(name, *WITH_FOLDER[name], "--out", "out")
    assert (code, said) == (2, "") and "out: another run is writing there" in err
    assert not any((tmp_path / "out").iterdir())


@pytest.mark.parametrize("words", [("export", "mpu6050", "--to", "vins"), ("modelica", "imt30")])
def test_a_folder_whose_holder_was_killed_is_free(words, holder, pyimu):
    holder.kill()
    holder.wait()
    assert pyimu(*words, "--out", "out")[0] == 0


def test_of_two_runs_into_one_folder_the_second_says_so(holder, pyimu):
    """The first one's end, or a kill, gives it back."""
    code, said, err = pyimu("characterize", "log.csv", "--out", "out")
    assert (code, said) == (2, "") and "another run is writing there" in err
    holder.kill()
    holder.wait()
    code, _, err = pyimu("characterize", "log.csv", "--out", "out")
    assert code == 2 and "log.csv: no such file" in err


def test_a_folder_is_held_by_another_path_to_it_as_well(holder, pyimu, tmp_path):
    out = linked(tmp_path / "link", tmp_path) / "out"
    code, said, err = pyimu("characterize", "log.csv", "--out", out)
    assert (code, said) == (2, "") and "another run is writing there" in err


def hold(folder, **environment):
    """A process with another environment that is to hold the folder; gives what it says."""
    command = [sys.executable, "-c", HOLDER, folder]
    done = subprocess.run(
        command,
        input="",
        capture_output=True,
        text=True,
        env=os.environ | environment,
        check=False,
    )
    return done.stdout + done.stderr


@pytest.mark.skipif(os.name == "nt", reason="folders are not locked there")
@pytest.mark.parametrize("there", [True, False])
def test_a_folder_is_held_whatever_the_folder_for_temporary_files_is(there, tmp_path):
    """As for jobs of a cluster, which have one each, and for two users."""
    (tmp_path / "out").mkdir() if there else None
    (tmp_path / "other").mkdir()
    first = Held()
    with first.holding():
        first.hold(tmp_path / "out")
        said = hold(tmp_path / "out", TMPDIR=str(tmp_path / "other"))
        assert "another run is writing there" in said
    assert hold(tmp_path / "out", TMPDIR=str(tmp_path / "other")) == "held\n"


@pytest.mark.skipif(os.name == "nt", reason="folders are not locked there")
def test_a_folder_that_cannot_be_locked_is_held_by_the_file(tmp_path, monkeypatch):
    """As over NFS, where the system refuses to lock what is not open for writing."""
    import fcntl

    def flock(file, how, real=fcntl.flock):
        if os.path.isdir(f"/dev/fd/{file}"):
            raise OSError(errno.EBADF, "Bad file descriptor")
        return real(file, how)

    monkeypatch.setattr("fcntl.flock", flock)
    first, second = Held(), Held()
    with first.holding():
        first.hold(tmp_path / "out")
        with second.holding(), pytest.raises(UserError, match="another run"):
            second.hold(tmp_path / "out")


def test_folders_that_were_made_and_stayed_empty_go(pyimu, tmp_path):
    """A folder that was there stays, and one with a result."""
    (tmp_path / "old").mkdir()
    for out in ("a/b/out", "old", "old/new"):
        code, _, err = pyimu("characterize", "log.csv", "--out", out)
        assert code == 2 and "log.csv: no such file" in err
    assert [path.name for path in tmp_path.rglob("*")] == ["old"]
    assert pyimu("export", "mpu6050", "--to", "vins", "--out", "a/b/out")[0] == 0
    assert any((tmp_path / "a" / "b" / "out").iterdir())


def test_a_folder_is_free_again_at_the_end_of_a_command(tmp_path):
    first, second = Held(), Held()
    with first.holding():
        first.hold(tmp_path / "out")
        first.hold(tmp_path / "out")  # its own
        with second.holding(), pytest.raises(UserError, match="another run"):
            second.hold(tmp_path / "out")
    with second.holding():
        second.hold(tmp_path / "out")
    second.hold(tmp_path / "out")  # a program that is no command holds nothing


def test_what_a_kill_left_goes_after_a_day(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    old = time.time() - 25 * 3600
    left = [tmp_path / f"{PREFIX}work", tmp_path / f"{PREFIX}half.csv"]
    left[0].mkdir()
    (left[0] / "file").touch()
    left[1].touch()
    young = tmp_path / f"{PREFIX}young"
    young.mkdir()
    for path in left:
        os.utime(path, (old, old))
    with work_folder(), whole(tmp_path / "new"):
        pass
    assert not any(path.exists() for path in left) and young.exists()
