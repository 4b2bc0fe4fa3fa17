"""Many drives of the shortest test as a campaign: runs a second, a worker killed in the middle, and
the same drives by another scheduler.

``python benchmarks/campaign.py [drives] [part] [rate]`` runs the turn on the spot (10,000 times, of
an imt30, at its own rate in Hz) on as many local processes as there are cores, kills one of them
when half of the drives are there, and then once more on a scheduler of its own that is reached by
its address. Both tables must be the same to the byte.
"""

import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pyimu
from pyimu.rover.campaign import Settings, run

DRIVES = 10_000


def main(drives: int = DRIVES, part: str = "imt30", rate: float | None = None) -> bool:
    settings, cores = Settings(pyimu.part(part), rate=rate), len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory(prefix="pyimu-") as folder:
        killed = Killer()
        first = run(settings, drives, Path(folder, "local"), workers=cores, say=killed)
        say(first, f"{cores} local workers, number {killed.pid} killed at {killed.share:.0%}")
        with Scheduler(cores) as address:
            second = run(settings, drives, Path(folder, "address"), scheduler=address)
        say(second, f"{cores} workers at {address}")
        tables = [done.folder.runs.read_bytes() for done in (first, second)]
        print(first.report())
        same = tables[0] == tables[1]
        print(f"tables of {len(tables[0]):,} bytes: {'the same' if same else 'DIFFERENT'}")
        return same


def say(done, what: str) -> None:
    speed = done.computed / done.seconds
    print(f"{what}: {done.computed:,} drives in {done.seconds:.0f} s, {speed:.1f} runs/s")


class Killer:
    """Kills a worker once, when half of the runs are there."""

    def __init__(self) -> None:
        self.pid, self.share = 0, 0.0

    def __call__(self, text: str, share: float | None = None) -> None:
        if not self.pid and share and share >= 0.5:
            self.pid, self.share = worker_of_this_process(), share
            os.kill(self.pid, signal.SIGKILL)


def worker_of_this_process() -> int:
    """One of the processes that this one started to compute for it."""
    shown = subprocess.run(
        ["ps", "-o", "pid=,args=", "--ppid", str(os.getpid())], capture_output=True, text=True
    ).stdout.splitlines()
    return [int(line.split()[0]) for line in shown if "spawn_main" in line][-1]


class Scheduler:
    """A Dask scheduler and its workers in processes of their own; gives its address."""

    def __init__(self, workers: int) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port, self.workers = free.getsockname()[1], workers
        self.started: list[subprocess.Popen] = []

    def __enter__(self) -> str:
        address = f"tcp://127.0.0.1:{self.port}"
        host = ["scheduler", "--host", "127.0.0.1", "--port", str(self.port)]
        commands = [[*host, "--no-dashboard", "--no-show"]]
        commands += [["worker", address, "--nthreads", "1", "--no-dashboard"]] * self.workers
        for words in commands:
            self.started.append(
                subprocess.Popen([sys.executable, "-m", "dask", *words], stderr=subprocess.DEVNULL)
            )
        return address

    def __exit__(self, *error: object) -> None:
        for process in reversed(self.started):
            process.terminate()
        time.sleep(1.0)
        for process in self.started:
            process.kill()
            process.wait()


if __name__ == "__main__":
    given = [kind(word) for kind, word in zip((int, str, float), sys.argv[1:], strict=False)]
    sys.exit(not main(*given))
