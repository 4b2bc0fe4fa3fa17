"""Example: python modelica/check.py

OpenModelica's ``checkModel`` on every class of the library that is no partial one, and short
simulations of the examples. Needs ``omc`` on the path and the Modelica Standard Library 4.0.0
(``installPackage(Modelica, "4.0.0")``); exit status 0 where all is well, 1 where not, 2 where there
is no omc.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

LIBRARY = Path(__file__).resolve().parent / "PyImu"
MARK = "=== "
"""Begins a class in the output."""

_CLASS = re.compile(r"^( *)(?:impure )?(block|model|function) (\w+) ", re.MULTILINE)
_COUNTS = re.compile(r"has (\d+) equation\(s\) and (\d+) variable\(s\)")


def classes(library: Path = LIBRARY) -> list[str]:
    """Full names of the blocks, models and functions that are not partial, nested ones too."""
    found = []
    for path in sorted(library.rglob("*.mo")):
        if path.stem == "package":
            continue
        text = path.read_text(encoding="utf-8")
        above = ".".join(path.relative_to(library.parent).with_suffix("").parts)
        for indent, _, name in _CLASS.findall(text):
            if not indent and name == path.stem:
                found.append(above)
            elif indent == "  " and f"\npackage {path.stem} " in text:
                found.append(f"{above}.{name}")
    return found


def examples(names: list[str]) -> list[str]:
    """Those that can be simulated as they are."""
    at_top = r"PyImu\.Examples\.\w+"
    own = [n for n in names if re.fullmatch(at_top, n)]
    return [n for n in own if "extends Modelica.Icons.Example;" in _text(n)]


def _text(name: str) -> str:
    path = LIBRARY.joinpath(*name.split(".")[1:]).with_suffix(".mo")
    return path.read_text(encoding="utf-8")


def script(names: list[str], simulated: list[str]) -> str:
    """What omc is to do; each class begins with a mark."""
    lines = ['loadModel(Modelica, {"4.0.0"});', f'loadFile("{LIBRARY / "package.mo"}");']
    lines.append("print(getErrorString());")
    for name in names:
        lines.append(f'print("\\n{MARK}{name}\\n");')
        lines.append(f"print(checkModel({name}));")
        lines.append("print(getErrorString());")
    for name in simulated:
        lines.append(f'print("\\n{MARK}{name} simulated\\n");')
        lines.append(f"simulate({name}, stopTime=0.2);")
        lines.append("print(getErrorString());")
    return "\n".join(lines) + "\n"


def failures(output: str, wanted: list[str]) -> dict[str, str]:
    """What omc said of each of the wanted that did not pass, or that it did not say anything."""
    said = dict(part.partition("\n")[::2] for part in output.split(f"\n{MARK}")[1:])
    return {name: said.get(name, "nothing was said") for name in wanted if not _passed(said, name)}


def _passed(said: dict[str, str], name: str) -> bool:
    text = said.get(name, "")
    if name.endswith(" simulated"):
        return "finished successfully" in text and "Error:" not in text
    counts = _COUNTS.search(text)
    balanced = counts is None or counts[1] == counts[2]
    return "completed successfully" in text and balanced and "Error:" not in text


def main() -> int:
    if shutil.which("omc") is None:
        print("omc, the compiler of OpenModelica, is not on the path", file=sys.stderr)
        return 2
    names = classes()
    simulated = examples(names)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "check.mos").write_text(script(names, simulated), encoding="utf-8")
        run = subprocess.run(
            ["omc", "check.mos"], cwd=folder, capture_output=True, text=True, check=False
        )
    failed = failures(run.stdout, [*names, *(f"{n} simulated" for n in simulated)])
    for name, text in failed.items():
        print(f"{name}\n{text.strip()}\n")
    print(f"{len(names)} classes, {len(simulated)} simulations, {len(failed)} failed")
    return 1 if failed or run.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
