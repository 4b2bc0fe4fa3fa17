"""Commands that are killed at random moments: run as ``python killed.py FOLDER TIMES NAME...``.

Each runs in a fork of this process, which has loaded everything and started no thread, draws no
pictures, and computes less where it takes long: what is tried is how results are written. Prints a
line for each command: how often it was killed before its end, and what was wrong, if anything.
"""

import os
import random
import shutil
import signal
import sys
import time
from dataclasses import replace
from functools import partial
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import raw_logs

from pyimu import cli
from pyimu.model.part_file import part, save_part

QUICK = {
    "characterize": ["characterize", "log.csv", "--out", "OUT"],
    "inspect": ["inspect", "log.csv", "--out", "OUT", "--write-map", "OUT/map.toml"],
    "modelica": ["modelica", "imt30", "--out", "OUT"],
    "navigate": ["navigate", "log.csv", "--part", "imt30", "--out", "OUT"],
    "close": ["close", "log.csv", "--part", "imt30", "--out", "OUT"],
    "build": ["build", "imt30", "--fmu", "sensor", "--fmi", "3", "--out", "OUT"],
    "export": ["export", "mpu6050", "--to", "kalibr,vins,gazebo,ros2,matlab,px4", "--out", "OUT"],
    "heading": ["heading", "turns.csv", "--start-up", "3", "--out", "OUT"],
    "derive": ["derive", "--out", "OUT"],
    "parts": ["parts", "--new", "OUT"],
}
"""OUT is a folder for the results, and the name of a new part."""

SLOW = {
    "rover": ["rover", "--part", "slow.toml", "--seeds", "1", "--out", "OUT"],
    "attitude": ["attitude", "log.csv", "--part", "imt30", "--out", "OUT"],
    "plan": ["plan", "mpu6050", "--for", "scale_factor", "--out", "OUT"],
    "demo": ["demo", "--out", "OUT"],
    "campaign": ["campaign", "slow.toml", "--runs", "2", "--workers", "0", "--out", "OUT"],
}

COMMANDS = QUICK | SLOW

RESUMED = ("campaign",)
"""Commands that go on from what an earlier run has left, and so take no other file for theirs."""

LOADED = (
    "pyimu.characterization.run",
    "pyimu.inspection.run",
    "pyimu.modelica.part_text",
    "pyimu.export",
    "pyimu.heading.run",
    "pyimu.rover.table6",
    "pyimu.derivations",
    "scipy.signal",
)

TURN = np.pi / 0.1
"""s of half a turn at 0.1 rad/s."""

DRIVE = (
    (30.0, 0.0, 0.0),
    (TURN, 0.0, 0.1),
    (TURN, 0.0, -0.1),
    (10.0, 0.0, 0.0),
    (TURN, 0.0, 0.1),
    (TURN, 0.0, -0.1),
    (20.0, 0.0, 0.0),
)
"""The demo's, in two minutes and a half: s, m/s, rad/s."""

EARLIER = b"earlier"


def command(words, out):
    """Runs it in a fork, silent; gives the process."""
    pid = os.fork()
    if pid == 0:
        quiet = os.open(os.devnull, os.O_WRONLY)
        os.dup2(quiet, 1)
        os.dup2(quiet, 2)
        sys.argv = ["pyimu", *(word.replace("OUT", str(out)) for word in words)]
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
    _, status = os.waitpid(command(words, out), 0)
    whole, took = files(out), time.monotonic() - started
    if status or not whole:
        return 0, f"{name} ends with {status}"
    killed = 0
    for _ in range(times):
        if name in RESUMED:
            shutil.rmtree(out, ignore_errors=True)
        else:
            for file in whole:
                (out / file).write_bytes(EARLIER)
        killed += _killed(words, out, rng.uniform(0, took))
        half = [f for f, data in files(out).items() if data not in (whole.get(f), EARLIER)]
        if half:
            return killed, f"{name} left half of {half}"
    _, status = os.waitpid(command(words, out), 0)
    found = files(out)
    different = [f for f in whole.keys() | found.keys() if found.get(f) != whole.get(f)]
    return killed, f"{name} again: {status}, {different}" if status or different else ""


def _killed(words, out, after):
    """Kills a command after so many s; whether it was before its end."""
    pid = command(words, out)
    time.sleep(after)
    os.kill(pid, signal.SIGKILL)
    return os.WIFSIGNALED(os.waitpid(pid, 0)[1])


def tried_new(words, times, rng):
    """As ``tried`` for the part of a new name, which is written once: it is there whole or not at
    all, and made where it is not.
    """
    started = time.monotonic()
    _, status = os.waitpid(command(words, "own-part"), 0)
    took = time.monotonic() - started
    whole = Path("own-part.toml").read_bytes()
    killed = 0
    for k in range(times):
        path = Path(f"own-{k}.toml")
        want = whole.replace(b"own-part", path.stem.encode())
        killed += _killed(words, path.stem, rng.uniform(0, took))
        if path.exists() and path.read_bytes() != want:
            return killed, f"half of {path}"
        there = path.exists()
        _, status = os.waitpid(command(words, path.stem), 0)
        if path.read_bytes() != want or bool(status) != there:
            return killed, f"{path} again: {status}"
    return killed, ""


def lightened():
    """Fewer pictures, results, drives and samples."""
    for module in LOADED:
        import_module(module)
    for module in ("pyimu.characterization.result", "pyimu.inspection.result"):
        import_module(module).page = lambda result: "a page " * 10_000
    derivations = import_module("pyimu.derivations")
    derivations.DERIVATIONS = derivations.DERIVATIONS[:3]
    import_module("pyimu.rover.demo").MANOEUVRES = DRIVE
    table6 = import_module("pyimu.rover.table6")
    table6.loop_closed = _as_if_closed
    table6.rover_tests = partial(table6.rover_tests, drives=table6.PAPER_DRIVES[-1:])
    known = part("imt30")
    save_part(replace(known, name="slow", sample_rate=25.0), "slow.toml")


def _as_if_closed(rover, say=None):
    """The loop closed with the truth."""
    scale = rover.known.gyro.with_values("scale_factor", s=-6.5 / 180)
    return SimpleNamespace(
        after=rover.true.with_sensor(scale), verdict="named", reason="scale_factor", added=()
    )


def main():
    os.chdir(sys.argv[1])
    lightened()
    stamps, gyro, accel = raw_logs.still(600)
    columns = [f"gyro_{a} [rad/s]" for a in "xyz"] + [f"accel_{a} [m/s^2]" for a in "xyz"]
    raw_logs.text(Path("log.csv"), [",".join(["time [ns]", *columns])], [stamps, *gyro.T, *accel.T])
    turns(stamps, gyro)
    rng = random.Random(int(np.random.SeedSequence().entropy) % 2**32)
    times = int(sys.argv[2])
    for name in sys.argv[3:]:
        words = COMMANDS[name]
        killed, wrong = (
            tried_new(words, times, rng) if name == "parts" else tried(name, words, times, rng)
        )
        print(f"{name}: killed {killed}; {wrong}", flush=True)


def turns(stamps, gyro):
    """Writes the log of a robot that turns, one way and the other, with its heading."""
    t = stamps * 1e-9
    rate = 0.3 * np.sign(np.sin(t)) * (np.abs(np.sin(t)) > 0.5)
    heading = np.cumsum(rate) * 0.01
    columns = [stamps, *gyro[:, :2].T, gyro[:, 2] + rate, heading]
    names = ["time [ns]", *(f"gyro_{a} [rad/s]" for a in "xyz"), "ref_heading [rad]"]
    raw_logs.text(Path("turns.csv"), [",".join(names)], columns)


if __name__ == "__main__":
    main()
