"""What ``close`` says of measured logs, row by row, beside what is known of them.

``python benchmarks/measured.py [ROW ...]`` closes the loop on public recordings, which lie in the
folder that ``PYIMU_DATA`` names, and prints for each row the verdict, what was added, the error on
the held-out rows before, after and floor, and of the attitude. Rows whose recordings are missing
are named as such. With ``--pairs`` the rows are each trial of BROAD, judged by each other one.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import permutations
from pathlib import Path

import numpy as np

import pyimu
from pyimu.identification.report.words import gravity_at_rest
from pyimu.identification.result import Closed

DATA = Path(os.environ.get("PYIMU_DATA", Path(__file__).parents[2] / "shared" / "data"))
SUFFIX = ".csv.gz"

BROAD = {
    "02": "broad_02_undisturbed_slow_rotation_B",
    "07": "broad_07_undisturbed_fast_rotation_B",
    "09": "broad_09_undisturbed_fast_rotation_with_breaks_B",
    "11": "broad_11_undisturbed_slow_translation_B",
    "16": "broad_16_undisturbed_fast_translation_B",
    "25": "broad_25_disturbed_tapping_B",
    "26": "broad_26_disturbed_phone_vibration_A",
}
WAND = [f"repoimu_tstick_test0{i}_trial1" for i in (5, 6, 7)]


ROCKET = """[columns]
timestamp_seconds = "time [s]"
raw_angular_rate_x_deg_per_s = "gyro_x [deg/s]"
raw_angular_rate_y_deg_per_s = "gyro_y [deg/s]"
raw_angular_rate_z_deg_per_s = "gyro_z [deg/s]"
raw_acceleration_x_gs = "accel_x [g]"
raw_acceleration_y_gs = "accel_y [g]"
raw_acceleration_z_gs = "accel_z [g]"
temperature_celsius = "temperature [degC]"
est_quaternion_w = "ref_q_w [1]"
est_quaternion_x = "ref_q_x [1]"
est_quaternion_y = "ref_q_y [1]"
est_quaternion_z = "ref_q_z [1]"
"""


SHOWN = {"gyro": (np.degrees(1.0), "deg/s"), "accel": (1.0, "m/s^2"), "mag": (1e6, "uT")}
"""Factor and unit in which a sensor's residual is printed."""


@dataclass(frozen=True)
class Row:
    """Logs to fit and to judge by, what is true of them, and what must hold of the result.

    ``columns`` is the column map of foreign logs, ``share`` from where to where they are taken.
    """

    name: str
    logs: list[str]
    holdout: list[str]
    truth: str
    holds: Callable[[Closed], bool] = lambda closed: True
    columns: str = ""
    share: tuple[float, float] = (0.0, 1.0)


def ratio(closed: Closed, kind: str = "gyro") -> float:
    """Held-out error after over before."""
    e = closed.errors[kind]
    return e.after.total / e.before.total


def delay(closed: Closed) -> float:
    """s; NaN where no delay was added."""
    found = [a.parameters["td"][0] for a in closed.added if a.effect == "time_delay"]
    return float(found[0]) if found else np.nan


def only_a_delay(largest: float) -> Callable[[Closed], bool]:
    """Whether a delay of 4.1 to 4.3 ms is all that was added to the gyro, and what it is worth."""

    def holds(closed: Closed) -> bool:
        added = [a.effect for a in closed.added if a.sensor == "gyro"]
        delay_found = added == ["time_delay"] and 4.1e-3 <= delay(closed) <= 4.3e-3
        return delay_found and ratio(closed) <= largest

    return holds


def wand(closed: Closed) -> bool:
    """Whether the gyro clips, nothing else is wrong with it, and the attitude is no worse."""
    added = {a.effect for a in closed.added if a.sensor == "gyro"}
    before, after = closed.attitude or (1.0, 1.0)
    wrong = {"clock_skew", "coning", "angular_acceleration"}
    return "saturation" in added and not added & wrong and after <= 1.02 * before


def gyro_spared(closed: Closed) -> bool:
    """Whether nothing was added to the gyro."""
    return not any(a.sensor == "gyro" for a in closed.added)


def filtered(closed: Closed) -> bool:
    """Whether nothing was added to the gyro but a low-pass filter, with which the held-out error
    falls and the attitude's does not rise.

    What is left in every half of the log, and in the trial before, falls with the square of the
    frequency by one figure; a reference of another rate or clock would leave the gyro too large.
    """
    added = {a.effect for a in closed.added if a.sensor == "gyro"}
    gyro, (before, after) = closed.errors["gyro"], closed.attitude
    better = gyro.after.total < gyro.before.total and after <= 1.02 * before
    return added <= {"first_order_lag", "lag"} and (better or not added)


def car(closed: Closed) -> bool:
    """Whether the clock was found, the heading follows the course, and the gyro is not blamed."""
    clock = closed.recordings[0].log_state["gyro"]["reference"]["clock"]
    heading = closed.heading or (np.inf, np.inf)
    blamed = not gyro_spared(closed)
    return 0.23 <= clock["late"] <= 0.27 and np.degrees(heading[1]) <= 1.5 and not blamed


ROWS = (
    Row(
        "02+09 -> 16", [BROAD["02"], BROAD["09"]], [BROAD["16"]], "delay 4.2 ms", only_a_delay(0.3)
    ),
    Row("09 -> 16", [BROAD["09"]], [BROAD["16"]], "delay 4.2 ms", only_a_delay(0.3)),
    Row("02 -> 07", [BROAD["02"]], [BROAD["07"]], "delay 4.2 ms", only_a_delay(0.2)),
    Row(
        "02+07 -> 26", [BROAD["02"], BROAD["07"]], [BROAD["26"]], "delay 4.2 ms", only_a_delay(0.6)
    ),
    Row("wand 05 to 07", WAND, [], "clips; clocks that slip", wand),
    Row(
        "wand 07",
        WAND[2:],
        [],
        "two clocks 1e-4 apart that slip by a sample; the gyro damps what is quick",
        filtered,
    ),
    *(
        Row(
            f"wand 07, {which} half",
            WAND[2:],
            [],
            "the same",
            filtered,
            share=(first, first + 0.5),
        )
        for which, first in (("first", 0.0), ("middle", 0.25), ("last", 0.5))
    ),
    Row(
        "pendulum",
        ["repoimu_pendulum_02a"],
        [],
        "one axis moves: bias alone leaves 3.23 deg/s",
        lambda c: c.verdict == "undecidable" or np.degrees(c.errors["gyro"].after.total) <= 3.3,
    ),
    Row(
        "rocket",
        ["raw/rocket_jackpot"],
        [],
        "its filter's quaternion and its gyro do not belong together",
        lambda c: c.verdict == "reference_unfit",
        ROCKET,
    ),
    Row(
        "car n",
        ["morpinet_rccar_n"],
        [],
        "clocks 0.25 s apart; a heading of 1.2 deg once that is known",
        car,
    ),
    Row(
        "rests",
        ["imucalib_unit0"],
        [],
        "scale factor, misalignment, bias of both sensors: gravity's size to 0.007 m/s^2",
        lambda c: (
            [g.sensor for g in c.at_rest] == ["accel", "gyro"]
            and c.at_rest[0].after <= 0.007
            and c.at_rest[1].after <= 0.3 * c.at_rest[1].as_measured
        ),
    ),
    Row("static", ["adis16405_unit1_static"], [], "flicker"),
    Row("thermal", ["astropi_lsm9ds1_static"], [], "accelerometer follows temperature"),
)

PAIRS = tuple(
    Row(f"{a} by {b}", [BROAD[a]], [BROAD[b]], "delay 4.2 ms", only_a_delay(1.0))
    for a, b in permutations(BROAD, 2)
)


def table(rows: Iterable[Row]) -> bool:
    """Print the rows; whether all that could be run hold."""
    good = True
    for row in rows:
        paths = [[DATA / (n + SUFFIX) for n in names] for names in (row.logs, row.holdout)]
        if not all(p.is_file() for ps in paths for p in ps):
            print(f"{row.name:14} skipped: not in {DATA}")
            continue
        began = time.perf_counter()
        try:
            fitted, judged = ([_read(p, row) for p in ps] for ps in paths)
            closed = pyimu.close(fitted, holdout=judged or None)
        except pyimu.UserError as error:
            print(f"{row.name:14} refused: {error}")
            good = False
            continue
        holds = row.holds(closed)
        good &= holds
        print(
            f"{row.name:14} {'holds' if holds else 'WRONG'}  ({time.perf_counter() - began:.0f} s)"
        )
        print(f"{'':14} true: {row.truth}")
        print(f"{'':14} said: {closed.verdict}: {'; '.join([closed.reason, *closed.remarks])}")
        for line in _figures(closed):
            print(f"{'':14} {line}")
    return good


def _read(path: Path, row: Row) -> pyimu.Recording:
    if not row.columns:
        recording = pyimu.read_recording(path)
        return recording.slice(*(round(share * len(recording)) for share in row.share))
    with tempfile.TemporaryDirectory() as folder:
        map_file = Path(folder) / "columns.toml"
        map_file.write_text(row.columns)
        return pyimu.read_recording(path, columns=map_file)


def _figures(closed: Closed):
    for kind, e in closed.errors.items():
        scale, unit = SHOWN[kind]
        values = [e.before.total, e.after.total, np.nan if e.floor is None else e.floor.total]
        before, after, floor = (scale * v for v in values)
        yield f"{kind}: {before:.4g} -> {after:.4g} {unit}, floor {floor:.3g}"
    yield from map(gravity_at_rest, closed.at_rest)
    if closed.attitude:
        yield "attitude: {:.2f} -> {:.2f} deg".format(*np.degrees(closed.attitude))
    if closed.heading:
        yield "heading: {:.2f} -> {:.2f} deg".format(*np.degrees(closed.heading))
    for r in closed.recordings:
        clock = r.log_state.get("gyro", {}).get("reference", {}).get("clock")
        if clock and clock["taken_out"]:
            yield f"clock of {r.file}: {clock['least']:.4g} to {clock['most']:.4g} s late"
    for kind, r in closed.refused:
        yield f"refused: {kind} {r.effect} ({r.gain:.0f} nat): {r.reason}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    named = [r.name for r in ROWS]
    parser.add_argument("row", nargs="*", help=f"of {', '.join(named)}; all without")
    parser.add_argument("--pairs", action="store_true", help="each trial of BROAD by each other")
    given = parser.parse_args()
    rows = {r.name: r for r in (PAIRS if given.pairs else ROWS)}
    unknown = set(given.row) - set(rows)
    if unknown:
        parser.error(f"no such row: {', '.join(sorted(unknown))}; there are {', '.join(rows)}")
    sys.exit(not table([rows[n] for n in given.row or rows]))
