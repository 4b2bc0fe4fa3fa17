"""Commands with absurd words: exit status 0 or 2 and one line, never a traceback.

python fuzz/command_line.py --seconds 60
"""

from __future__ import annotations

import io
import os
import random
import sys
import tempfile
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import harness
import raw_logs

from pyimu import cli

NAME = "command_line"

LOADED = (
    "pyimu.attitude.run",
    "pyimu.characterization.run",
    "pyimu.derivations.model",
    "pyimu.export.targets",
    "pyimu.fmu.package",
    "pyimu.heading.run",
    "pyimu.identification.close",
    "pyimu.inspection.run",
    "pyimu.modelica.part_text",
    "pyimu.ins.run",
)

COMMANDS = {
    "inspect": ["--write-map", "--out", "--columns", "--json"],
    "characterize": ["--out", "--columns", "--level"],
    "close": [
        "--part",
        "--out",
        "--holdout",
        "--columns",
        "--reference",
        "--latitude",
        "--effects",
    ],
    "attitude": [
        "--part",
        "--out",
        "--heading0",
        "--place",
        "--date",
        "--settings",
        "--declination",
    ],
    "heading": ["--part", "--out", "--method", "--known", "--start-up", "--threshold", "--slip"],
    "navigate": ["--part", "--out", "--method", "--zupt", "--latitude"],
    "plan": ["--for", "--out", "--within"],
    "build": ["--out", "--fmu", "--fmi", "--platform", "--specimen", "--ssp"],
    "parts": [],
    "modelica": ["--out"],
    "export": ["--to", "--out", "--inflate", "--effects", "--json", "--quiet"],
    "derive": ["--out", "--help"],
    "demo": ["--nothing"],
    "rover": ["--nothing"],
    "campaign": ["--nothing"],
    "--version": [],
    "": [],
}
"""Commands and options; what would take minutes has only options that it refuses."""

VALUES = [
    "",
    "x",
    "-1",
    "0",
    "1e308",
    "nan",
    "1e-300",
    "part.toml",
    "log.csv",
    "map.toml",
    "missing.csv",
] + [
    "/dev/null",
    "/dev/zero",
    "/proc/self/mem",
    ".",
    "/",
    "a" * 5000,
    "x\x1b[2Jy",
    "\udcff",
    "é",
    "52.5,13.3",
    "2026-02-30",
    "-h",
    "--",
    "..",
    "link.csv",
    "pipe.csv",
    "huge.csv.gz",
    "gyro",
    "g_sensitivity",
    "imt30",
    "sensor,ukf",
    "2,3,block",
    "kalibr,gazebo",
]


def seeds(folder: Path) -> None:
    """The folder that commands run in: a short log, a part, a map, and traps."""
    import gzip

    time, gyro, accel = raw_logs.still(60)
    raw_logs.text(folder / "log.csv", [_HEAD], [time, *gyro.T, *accel.T])
    (folder / "part.toml").write_text('name = "p"\nsample_rate = {value = 100.0, unit = "Hz"}\n')
    (folder / "map.toml").write_text('[columns]\n"t" = "time [s]"\n')
    (folder / "link.csv").symlink_to("/dev/zero")
    os.mkfifo(folder / "pipe.csv")
    with gzip.open(folder / "huge.csv.gz", "wb", compresslevel=1) as stream:
        for _ in range(64):
            stream.write(bytes(1 << 20))


_HEAD = "time [ns],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]," + ",".join(
    f"accel_{a} [m/s^2]" for a in "xyz"
)


def mutate(seed: Path, folder: Path, rng: random.Random) -> Path:
    """The words of a command, in a file of their own."""
    command = rng.choice(sorted(COMMANDS))
    words = [command] if command else []
    if rng.random() < 0.9:
        words += rng.choices([*VALUES, "log.csv", "part.toml"], k=rng.choice((0, 1, 1, 1, 2)))
    for option in rng.sample(COMMANDS[command], min(len(COMMANDS[command]), rng.randrange(3))):
        words += [option, rng.choice(VALUES)] if rng.random() < 0.9 else [option]
    path = folder / "words"
    path.write_text(repr((str(seed.parent), words)))
    return path


def try_one(path: Path) -> str:
    """What became of the command: its exit status."""
    import ast

    folder, words = ast.literal_eval(path.read_text())
    if words and words[0] in ("build", "rover", "demo", "campaign") and _is_long(words):
        return "left out, would take long"
    said, out = io.StringIO(), io.StringIO()
    with tempfile.TemporaryDirectory(prefix="pyimu-fuzz-") as name:
        for file in Path(folder).iterdir():
            (Path(name) / file.name).symlink_to(file)
        os.chdir(name)
        sys.argv = ["pyimu", *words]
        try:
            with redirect_stderr(said), redirect_stdout(out):
                cli.main()
        except SystemExit as end:
            status = end.code
        os.chdir(folder)
    text = said.getvalue()
    if status not in (0, 2) or text.count("\n") > 1 or not text.rstrip("\n").isprintable():
        raise AssertionError(f"{words!r}: status {status}, {text!r}")
    return f"ended with {status}"


def _is_long(words: list[str]) -> bool:
    """Whether a command may be valid and take more than the fuzzer has: it compiles, or runs."""
    return (
        words[0] != "build"
        and "--nothing" not in words
        or "imt30" in words
        or ("part.toml" in words)
    )


if __name__ == "__main__":
    harness.main(sys.modules[__name__])
