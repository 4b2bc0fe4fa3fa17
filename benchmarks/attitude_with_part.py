"""Attitude with the part that ``close`` found, beside attitude without one, on measured recordings.

``python benchmarks/attitude_with_part.py [--data FOLDER] [--parts FOLDER]`` closes the loop on some
recordings (BROAD: Laidig, Caruso, Cereatti and Seel 2021; RepoIMU: Szczesna et al. 2016), and runs
the attitude filter over all of the same set with the part and without. ``--parts`` keeps the parts
that were found, and takes those that are there: each takes a minute or more. Printed are the errors
in degrees without and with the part and their ratio: of the inclination, RMS over the rows of the
phase ``moving``, and of the whole attitude with heading set right at the first row of each 10 s,
over all rows with a reference. What the package's constants are was chosen on BROAD 02, 11 and 26
(marked c), the others are reported.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from attitude_real import folder, inclination, moving_rows
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.attitude import run
from pyimu.attitude.error import error_against, root_mean_square
from pyimu.model.part import Part
from pyimu.model.part_file import load_part, save_part
from pyimu.recording.recording import Recording

SETS = {
    "broad": (
        ("02", "07", "09", "11", "16", "25", "26"),
        (
            (("02", "11"), ("26",)),
            (("11", "26"), ("02",)),
            (("02", "07"), ("26",)),
            (("07", "16"), ("09",)),
        ),
    ),
    "repoimu_tstick_test": (("05", "06", "07"), ((("05", "06"), ("07",)), (("07",), ("06",)))),
}
"""By the start of the files' names: the recordings, and what is fitted and held out of them."""

CHOSEN = ("02", "11", "26")
"""Recordings of BROAD on which constants were chosen."""

WINDOW = 10.0
"""s."""


def main() -> None:
    for start, (numbers, fits) in SETS.items():
        logs = {n: _log(start, n) for n in numbers}
        if None in logs.values():
            print(f"{start}: recordings missing in {folder()}; --data FOLDER says where they are")
            continue
        without = {n: errors(log, None) for n, log in logs.items()}
        for fitted, held in fits:
            part = _part(f"{start}_{'+'.join(fitted)}-{'+'.join(held)}", logs, fitted, held)
            print(f"\n{start}, part of {' and '.join(fitted)} (held out {held[0]}): {_told(part)}")
            for n, log in logs.items():
                _line(n, fitted, start, without[n], errors(log, part))


def _line(number: str, fitted: tuple, start: str, without: list, found: list) -> None:
    marks = ("c" if start == "broad" and number in CHOSEN else " ") + "f" * (number in fitted)
    pairs = zip(("inclination", "in 10 s"), without, found, strict=True)
    text = "   ".join(f"{name} {a:7.3f} {b:7.3f} {b / a:6.3f}" for name, a, b in pairs)
    print(f"  {number} {marks:3s} {text}", flush=True)


def errors(log: Recording, part: Part | None) -> list[float]:
    """Of inclination and of attitude in windows, RMS in degrees."""
    q, known = run(log, part).q, np.isfinite(log.ref_q).all(axis=1)
    scored, mounted = known & moving_rows(log), log.moving is None
    tilt = root_mean_square(inclination(q[scored], log.ref_q[scored], mounted=mounted))
    reference = Rotation.from_quat(log.ref_q[known], scalar_first=True)
    whole = error_against(log.time[known], q[known], reference).in_windows(WINDOW)
    return [tilt, float(np.degrees(whole.rms))]


def _log(start: str, number: str) -> Recording | None:
    found = sorted(folder().glob(f"{start}{'_' * (start == 'broad')}{number}_*.csv.gz"))
    return pyimu.read_recording(found[0]) if found else None


def _part(name: str, logs: dict, fitted: tuple, held: tuple) -> Part:
    """The part that ``close`` finds, out of the folder of parts where it is there."""
    path = _kept() / f"{name}.toml"
    if not path.exists():
        closed = pyimu.close([logs[n] for n in fitted], holdout=[logs[n] for n in held])
        save_part(closed.after, path)
    return load_part(path)


def _kept() -> Path:
    kept = "--parts" in sys.argv[:-1]
    path = Path(sys.argv[sys.argv.index("--parts") + 1] if kept else tempfile.mkdtemp())
    path.mkdir(parents=True, exist_ok=True)
    return path


def _told(part: Part) -> str:
    return ", ".join(e.name for e in part.gyro.effects)


if __name__ == "__main__":
    main()
