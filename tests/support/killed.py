"""Commands that are killed at random moments: run as ``python killed.py FOLDER TIMES``.

Each runs in a fork of this process, which has loaded everything and started no thread, and draws no
pictures. Prints a line for each command: how often it was killed before its end, and what was
wrong, if anything.
"""

import os
import random
import signal
import sys
import time
from importlib import import_module
from pathlib import Path

import numpy as np
import raw_logs

from pyimu import cli

COMMANDS = {
    "characterize": ["characterize", "log.csv", "--out"],
    "inspect": ["inspect", "log.csv", "--out"],
    "modelica": ["modelica", "imt30", "--out"],
    "plan": ["plan", "mpu6050", "--for", "scale_factor", "--out"],
    "attitude": ["attitude", "log.csv", "--part", "imt30", "--out"],
    "navigate": ["navigate", "log.csv", "--part", "imt30", "--out"],
    "close": ["close", "log.csv", "--part", "imt30", "--out"],
    "build": ["build", "imt30", "--fmu", "sensor", "--fmi", "3", "--out"],
    "export": ["export", "mpu6050", "--to", "kalibr,vins,gazebo,ros2,matlab,px4", "--out"],
}

LOADED = (
    "pyimu.characterization.run",
    "pyimu.inspection.run",
    "pyimu.modelica.part_text",
    "pyimu.export",
    "scipy.signal",
)

EARLIER = b"earlier"


def command(words):
    """Runs it in a fork, silent; gives the process."""
    pid = os.fork()
    if pid == 0:
        quiet = os.open(os.devnull, os.O_WRONLY)
        os.dup2(quiet, 1)
        os.dup2(quiet, 2)
        sys.argv = ["pyimu", *words]
        try:
            cli.main()
        except SystemExit as end:
            os._exit(end.code)
    return pid


def files(folder):
    """What a folder holds, unfinished files apart."""
    if not folder.exists():
        return {}
    return {
        str(p.relative_to(folder)): p.read_bytes()
        for p in folder.rglob("*")
        if p.is_file() and not any(part.startswith(".pyimu-") for part in p.parts)
    }


def tried(name, words, times, rng):
    """Kills a command ``times`` times; gives how often it was before its end, and what is wrong."""
    started = time.monotonic()
    out = Path(name)
    _, status = os.waitpid(command([*words, str(out)]), 0)
    whole, took = files(out), time.monotonic() - started
    if status or not whole:
        return 0, f"{name} ends with {status}"
    for file in whole:
        (out / file).write_bytes(EARLIER)
    killed = 0
    for _ in range(times):
        pid = command([*words, str(out)])
        time.sleep(rng.uniform(0, took))
        os.kill(pid, signal.SIGKILL)
        killed += os.WIFSIGNALED(os.waitpid(pid, 0)[1])
        half = [f for f, data in files(out).items() if data not in (whole.get(f), EARLIER)]
        if half:
            return killed, f"{name} left half of {half}"
    _, status = os.waitpid(command([*words, str(out)]), 0)
    different = [f for f, data in files(out).items() if data != whole.get(f)]
    return killed, f"{name} again: {status}, {different}" if status or different else ""


def main():
    os.chdir(sys.argv[1])
    for module in LOADED:
        import_module(module)
    for module in ("pyimu.characterization.result", "pyimu.inspection.result"):
        import_module(module).page = lambda result: "a page " * 10_000
    stamps, gyro, accel = raw_logs.still(600)
    head = "time [ns]," + ",".join(
        [f"gyro_{a} [rad/s]" for a in "xyz"] + [f"accel_{a} [m/s^2]" for a in "xyz"]
    )
    raw_logs.text(Path("log.csv"), [head], [stamps, *gyro.T, *accel.T])
    rng = random.Random(int(np.random.SeedSequence().entropy) % 2**32)
    for name, words in COMMANDS.items():
        killed, wrong = tried(name, words, int(sys.argv[2]), rng)
        print(f"{name}: killed {killed}; {wrong}", flush=True)


if __name__ == "__main__":
    main()
