"""A campaign on Dask: the same bytes on any workers, whichever of them dies, and wherever."""

import contextlib
import os
import signal
import socket
import subprocess
import sys

import pytest

import pyimu
from pyimu.errors import UserError
from pyimu.rover.campaign import workers as room
from pyimu.rover.campaign.campaign import run
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.table import BATCH

distributed = pytest.importorskip("distributed", reason="the campaign's workers are Dask's")

RUNS = 6 * BATCH


def settings():
    return Settings(pyimu.part("imt30"), rate=25.0, terrains=1)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The table of a campaign of this process alone."""
    out = tmp_path_factory.mktemp("alone")
    return run(settings(), RUNS, out, workers=0).folder.runs.read_bytes()


@pytest.fixture
def scheduler():
    """Address and process of a scheduler, with a worker in another process."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    host, port = address.removeprefix("tcp://").split(":")
    words = ["scheduler", "--host", host, "--port", port, "--no-dashboard", "--no-show"]
    dask = [sys.executable, "-m", "dask"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    started = [subprocess.Popen([*dask, *words], **quiet)]
    worker = ["worker", address, "--nthreads", "1", "--no-dashboard", "--no-nanny"]
    started.append(subprocess.Popen([*dask, *worker], **quiet))
    yield address, started[0].pid
    for process in started:
        process.kill()  # a worker that is asked to end waits for its scheduler
        process.wait()


@pytest.mark.long
def test_a_killed_worker_loses_nothing(alone, tmp_path):
    """Killed as soon as it has begun to compute, so that it dies with a batch in hand."""
    killed, told = [], []

    def say(text, share=None):
        told.append(text)
        if not killed:
            killed.append(_one_of_my_workers())
            os.kill(killed[0], signal.SIGKILL)

    done = run(settings(), RUNS, tmp_path, workers=2, say=say)
    assert killed and done.computed == RUNS
    assert done.folder.runs.read_bytes() == alone
    assert any("left" in text for text in told)


def _one_of_my_workers():
    """A process that this one started to compute for it."""
    found = []
    for folder in (f for f in os.listdir("/proc") if f.isdigit()):
        with contextlib.suppress(OSError):  # it has ended meanwhile
            with open(f"/proc/{folder}/stat") as file:
                parent = int(file.read().rpartition(")")[2].split()[1])
            with open(f"/proc/{folder}/cmdline") as file:
                if parent == os.getpid() and "spawn_main" in file.read():
                    found.append(int(folder))
    return found[-1]


@pytest.mark.long
def test_a_scheduler_reached_by_its_address_gives_the_same(alone, scheduler, tmp_path, monkeypatch):
    """Then the scheduler is lost, which is one line, and what was computed is kept."""
    address, process = scheduler
    done = run(settings(), RUNS, tmp_path / "whole", scheduler=address)
    assert done.folder.runs.read_bytes() == alone

    monkeypatch.setattr(room, "AWAY", 1.0)
    with pytest.raises(UserError, match=f"{address}: lost .*the same command goes on"):
        run(
            settings(),
            RUNS,
            tmp_path / "lost",
            scheduler=address,
            say=lambda *said: os.kill(process, signal.SIGKILL),
        )
    done = run(settings(), RUNS, tmp_path / "lost", workers=0)
    assert done.computed < RUNS and done.folder.runs.read_bytes() == alone


def test_a_scheduler_that_does_not_answer_is_one_line(pyimu, monkeypatch, tmp_path):
    monkeypatch.setattr(room, "ANSWER", 0.5)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    words = ["campaign", "imt30", "--runs", "5", "--scheduler", address]
    code, out, err = pyimu(*words)
    assert (code, out) == (2, "")
    assert err.startswith(f"pyimu: --scheduler {address}: no Dask scheduler answers there")
    assert err.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_a_scheduler_without_workers_is_one_line(monkeypatch, tmp_path):
    monkeypatch.setattr(room, "ARRIVAL", 0.5)
    with distributed.LocalCluster(
        n_workers=0, dashboard_address=None, processes=False, protocol="tcp"
    ) as cluster:
        with pytest.raises(UserError, match="no worker has come within 0.5 s"):
            run(settings(), 5, tmp_path, scheduler=cluster.scheduler_address)


def test_other_code_on_the_workers_is_one_line(monkeypatch, tmp_path):
    """Of a worker of this process, as another one would take seconds to start."""
    theirs = iter(["0.0.1", "0.0.2"])
    monkeypatch.setattr(room, "made_by", lambda: next(theirs))
    with distributed.LocalCluster(
        n_workers=1, dashboard_address=None, processes=False, protocol="tcp"
    ) as cluster:
        with pytest.raises(UserError, match="has pyimu 0.0.2, not 0.0.1: runs would not be"):
            run(settings(), 5, tmp_path, scheduler=cluster.scheduler_address)


def test_without_dask_is_one_line(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(UserError, match="distributed is not installed: pip install"):
        run(settings(), 5, tmp_path, workers=2)
    assert run(settings(), 5, tmp_path, workers=0).count == 5
