"""Damaged part files: a UserError, or a part that is written and read back the same.

python fuzz/part_files.py --seconds 60
"""

from __future__ import annotations

import random
import re
import sys
from importlib.resources import files
from pathlib import Path

import harness

from pyimu.errors import UserError
from pyimu.model.part_file import load_part, part_names
from pyimu.model.part_reader import parse_part
from pyimu.model.part_writer import format_part

NAME = "part_files"

LOADED = ()

WORDS = [
    "",
    "1e308",
    "-1e308",
    "nan",
    "inf",
    "-inf",
    "0",
    "-1",
    "1e-320",
    "true",
    '""',
    "[]",
    "{}",
] + [
    "[[1, 2], [3]]",
    "[" * 200 + "]" * 200,
    '"estimate"',
    '["deg/s"]',
    '"' + "(" * 300 + '"',
    '"deg/s/sqrt(Hz)"',
    "9" * 5000,
    "2026-01-01",
    "[gyro]",
    "[tolerance.gyro.turn_on_bias]",
    "name = 3",
    'sample_rate = {value = 1e308, unit = "Hz"}',
    'sample_rate = {value = 1.0, unit = ["Hz"]}',
    "\x00",
    "\\u001b",
    "é",
    "x" * 5000,
]


def seeds(folder: Path) -> None:
    """The built-in parts."""
    for name in part_names():
        text = files("pyimu.model").joinpath("parts", f"{name}.toml").read_text(encoding="utf-8")
        (folder / f"{name}.toml").write_text(text)


def mutate(seed: Path, folder: Path, rng: random.Random) -> Path:
    """A damaged copy: numbers, units and names changed in place, or anything at all."""
    text, path = seed.read_text(encoding="utf-8"), folder / "part.toml"
    if rng.random() < 0.6:
        places = list(re.finditer(r"-?\d[\d.e-]*|\"[^\"\n]*\"|\[[^\]\n]*\]|\w+(?= =)", text))
        for match in sorted(rng.sample(places, min(2, len(places))), key=lambda m: -m.start()):
            text = text[: match.start()] + rng.choice(WORDS) + text[match.end() :]
        path.write_text(text, encoding="utf-8")
    elif rng.random() < 0.7:
        path.write_text(harness.mutated_text(text, rng, WORDS), encoding="utf-8")
    else:
        path.write_bytes(harness.mutated(text.encode(), rng))
    return path


def try_one(path: Path) -> str:
    """What became of the file: read, or refused."""
    try:
        part = load_part(path)
    except UserError as error:
        if not str(error).isprintable():
            raise AssertionError(f"a message that a terminal obeys: {error!r}") from None
        return "refused"
    again = parse_part(format_part(part))
    if again != part:
        raise AssertionError("what was written does not read back the same")
    return "read"


if __name__ == "__main__":
    harness.main(sys.modules[__name__])
