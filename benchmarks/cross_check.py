"""Units, inputs, references and results in the layout of the FMI cross-check:
``python benchmarks/cross_check.py out/cross_check``.

``fmus/VERSION/cs/PLATFORM/pyimu/VERSION/MODEL`` holds the unit, ``_in.csv``, ``_ref.csv`` (what
Python gives) and ``_ref.opt``; ``results/.../fmpy/VERSION/pyimu/VERSION/MODEL`` what fmpy gives as
``_out.csv``, and a file ``passed`` where that is the reference to the last bit, else ``failed``.
"""

import shutil
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np

from pyimu import __version__
from pyimu.block.block import Block
from pyimu.fmu import build_fmu, host_platform, simulate
from pyimu.fmu.build import PLATFORMS
from pyimu.fmu.generate import reference_blocks
from pyimu.fmu.sources import Form

SAMPLES = 2000
SEED = 3


def inputs_of(block: Block) -> np.ndarray:
    """Inputs (SAMPLES, nu) about their start values."""
    noise = np.random.default_rng(1).standard_normal((SAMPLES, len(block.inputs)))
    real = [v.kind == "real" for v in block.inputs]
    return block.start_inputs + np.where(real, 0.1 * noise, 0.0)


def table(path: Path, names: list[str], period: float, rows: np.ndarray) -> None:
    """A CSV with time first; numbers as they read back."""
    lines = [",".join(f'"{n}"' for n in ("time", *names))]
    for k, row in enumerate(rows):
        lines.append(",".join(repr(float(x)) for x in (k * period, *row)))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def reference(block: Block, inputs: np.ndarray) -> np.ndarray:
    """What a unit shows, rows (SAMPLES + 1, ny): row 0 for the first inputs."""
    first = np.array(block.initial(inputs[0], block.start)[1]).ravel()
    return np.vstack([first, block.run(inputs, seed=SEED if block.noise else None)[0]])


def check(block: Block, form: Form, out: Path) -> bool:
    """Write one unit and its result; whether it has passed."""
    folder = PLATFORMS[host_platform()]
    kind = Path(f"{form}.0", "cs", folder.fmi2 if form == 2 else folder.name)
    own = Path("pyimu", __version__, block.name)
    fmus, results = out / "fmus" / kind / own, out / "results" / kind
    results = results / "fmpy" / version("fmpy") / own
    for path in (fmus, results):
        path.mkdir(parents=True, exist_ok=True)
    inputs, h = inputs_of(block), block.sample_period
    unit = fmus / f"{block.name}.fmu"
    shutil.move(build_fmu(block, fmus, form), unit)
    names = [v.name for v in block.outputs]
    expected = reference(block, inputs)
    table(fmus / f"{block.name}_in.csv", [v.name for v in block.inputs], h, inputs)
    table(fmus / f"{block.name}_ref.csv", names, h, expected)
    options = {"StartTime": 0.0, "StopTime": SAMPLES * h, "StepSize": h, "RelTol": 0.0}
    text = "".join(f"{name}, {value!r}\n" for name, value in options.items())
    (fmus / f"{block.name}_ref.opt").write_text(text, encoding="utf-8", newline="\n")
    start = {"seed": SEED} if block.noise else {}
    found = simulate(unit, inputs, sample_period=h, start_values=start)
    table(results / f"{block.name}_out.csv", names, h, found)
    passed = np.array_equal(found, expected, equal_nan=True)
    for verdict in ("passed", "failed"):
        (results / verdict).unlink(missing_ok=True)
    (results / ("passed" if passed else "failed")).touch()
    return passed


def main() -> int:
    out = Path(sys.argv[1] if len(sys.argv) > 1 else "out/cross_check")
    good = True
    for block in reference_blocks():
        for form in (2, 3):
            passed = check(block, form, out)
            print(f"FMI {form}.0 {block.name}: {'passed' if passed else 'FAILED'}", flush=True)
            good = good and passed
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
