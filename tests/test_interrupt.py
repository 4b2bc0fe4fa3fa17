"""Ctrl-C ends the work wherever it arrives, once, with the status of an interrupted run."""

import ctypes
import signal
import subprocess
import sys
import tempfile
import time

import pytest
from places import same_path

from pyimu import cli
from pyimu.cli.interrupt import LOOK, Interrupt, Interrupts

PATIENCE = 30.0
"""s; within which a lost interrupt comes again on the busiest machine."""


def press():
    signal.raise_signal(signal.SIGINT)


def swallowed():
    try:
        press()
    except BaseException:
        pass


def in_a_callback():
    ctypes.CFUNCTYPE(None)(press)()


def in_a_destructor():
    class Dying:
        def __del__(self):
            press()

    Dying()


def as_another_error():
    try:
        press()
    except BaseException:
        raise RuntimeError("what a library makes of it") from None


def work():
    """What goes on where nothing stops it."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        time.sleep(LOOK / 5)
    pytest.fail("the interrupt was lost")


@pytest.mark.parametrize("lose", [swallowed, in_a_callback, in_a_destructor])
def test_an_interrupt_that_is_lost_comes_again(lose, capsys):
    """And nothing is said of the first one."""
    with pytest.raises(Interrupt), Interrupts() as interrupts:
        lose()
        work()
    assert interrupts.asked and capsys.readouterr().err == ""


def test_an_interrupt_that_is_lost_twice_comes_again():
    with pytest.raises(Interrupt), Interrupts():
        swallowed()
        try:
            work()
        except Interrupt:
            pass
        work()


def test_what_cleans_up_is_not_interrupted_again():
    done = []
    with pytest.raises(Interrupt), Interrupts():
        try:
            press()
        finally:
            time.sleep(6 * LOOK)
            done.append("cleaned")
    time.sleep(3 * LOOK)
    assert done == ["cleaned"]


def test_other_errors_of_callbacks_are_told(monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", lambda lost: told.append(lost.exc_type))
    with Interrupts() as interrupts:
        ctypes.CFUNCTYPE(None)(lambda: 1 / 0)()
    assert told == [ZeroDivisionError] and not interrupts.asked


def test_afterwards_all_is_as_before():
    before = signal.getsignal(signal.SIGINT), sys.unraisablehook
    with pytest.raises(Interrupt), Interrupts():
        press()
    assert (signal.getsignal(signal.SIGINT), sys.unraisablehook) == before


@pytest.mark.parametrize("work", [press, as_another_error, lambda: (swallowed(), work())])
def test_an_interrupted_command_ends_with_status_130_and_one_line(work, monkeypatch, capsys):
    monkeypatch.setattr(cli, "app", lambda **_: work())
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 130
    assert capsys.readouterr().err == "pyimu: interrupted; earlier results are as they were\n"


def test_a_bug_is_called_one_and_its_traceback_is_in_a_file(monkeypatch, capsys, tmp_path):
    def fail(**_):
        raise RuntimeError("a thing\x1b[31m of ours")

    monkeypatch.setattr(cli, "app", fail)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(SystemExit) as end:
        cli.main()
    (file,) = tmp_path.glob("pyimu-bug-*.txt")
    said = capsys.readouterr().err
    assert end.value.code == 70 and said.count("\n") == 1 and str(file) in said
    assert "bug in pyimu" in said and "a thing?[31m of ours" in said
    assert "in fail" in file.read_text() and "RuntimeError" in file.read_text()


@pytest.mark.parametrize(
    "error, says",
    [
        (OSError(28, "No space left on device", "/x/y"), "/x/y: No space left on device"),
        (MemoryError(), "not enough memory"),
    ],
)
def test_what_the_system_refuses_is_no_bug(error, says, monkeypatch, capsys):
    def fail(**_):
        raise error

    monkeypatch.setattr(cli, "app", fail)
    with pytest.raises(SystemExit) as end:
        cli.main()
    assert end.value.code == 2 and says in capsys.readouterr().err


AT_EXIT = """
import atexit, signal, sys
from pyimu.cli.interrupt import ignore_at_exit
atexit.register(signal.raise_signal, signal.SIGINT)
try:
    exec("signal.raise_signal(signal.SIGINT)")
except KeyboardInterrupt:
    pass
ignore_at_exit()
sys.exit(7)
"""


def test_a_process_that_has_done_its_work_keeps_its_status(tmp_path):
    """Whether Ctrl-C comes while Python ends, or came in the making of a class."""
    (tmp_path / "ending.py").write_text(AT_EXIT)
    command, here = [sys.executable, "-m", "ending"], {"cwd": tmp_path, "env": same_path()}
    done = subprocess.run(command, **here, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (7, "")
