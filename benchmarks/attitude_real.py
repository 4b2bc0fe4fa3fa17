"""Error of the attitude filter on measured recordings with a known attitude, beside that of vqf on
the same samples: the inclination by six axes, all of it and the heading by nine.

``python benchmarks/attitude_real.py [--data FOLDER]``; the folder (else the environment's
``PYIMU_DATA``, else ``../shared/data`` beside the checkout) holds recordings of the BROAD data set
(Laidig, Caruso, Cereatti and Seel 2021) in this package's format. Needs vqf, which the package
itself does not. With six axes both filters see gyro and accelerometer alone; they run with their
defaults: ours finds the noise of the part in the rest that a recording starts with, where its
samples are clipped, and what else it needs are constants of the package. Those were chosen on
recordings 02, 11 and 26 and on the wand; the others were looked at as well, so that only recordings
that are not here show what the filter will do. Scored are the rows of the phase ``moving`` for
which there is a reference, RMS in degrees, as in the data set's paper.

With nine axes the magnetometer is used too. The data set's reference is against magnetic north, so
that the heading is compared as it is, without an offset that is fitted or taken off at a row; vqf's
mean is then the published one. What the magnetometer's update has for constants was chosen on
recordings 02, 11 and 26, and not on the others.

Three recordings of another part follow, a wand swung by hand (RepoIMU, Szczesna et al. 2016). Two
of them drive an axis of its gyro to the limit, the first one over and over: by how much it turned
meanwhile the samples before and after tell roughly. The reference has an unknown mounting
rotation, fitted for each filter to the nine tenths of the rows that agree best.

A last table has the same with the magnetometer calibrated by the log itself, and by each other log
of the set that turns enough. The recordings come with a magnetometer that is calibrated already,
in a room whose field is not the same everywhere.

A table before that has nine axes with declination, strength and dip from the World Magnetic Model
of the place (needs pygeomag); the reference's magnetic north is turned to the true one for it. The
room's field is a tenth weaker than the model's.

A second table has the smoothed attitude of the recordings of BROAD, of which each sample is
estimated by all others, beside vqf's ``offlineVQF``, with what the smoother claims of its error.
The smoother has no constant of its own.

A third has the recordings of BROAD begun in motion: of each what moves, from 15 s and from 45 s
after its first row that does, by gyro and accelerometer. Nothing was chosen on these.

The constants of the motion (``pyimu.attitude.filter.velocity``) were chosen on 02, 11 and 26 as
well, the noise that grows with the rate of a gyro of which no part says anything on 02, 07, 09 and
26.
"""

import os
import sys
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.attitude import run
from pyimu.attitude.error import angle_between, root_mean_square
from pyimu.attitude.outcome import DISTURBED
from pyimu.attitude.world_field import world_field
from pyimu.characterization.magnetometer.estimate import magnetometer_fit

SCORED = (
    "broad_02_undisturbed_slow_rotation_B",
    "broad_07_undisturbed_fast_rotation_B",
    "broad_09_undisturbed_fast_rotation_with_breaks_B",
    "broad_11_undisturbed_slow_translation_B",
    "broad_16_undisturbed_fast_translation_B",
    "broad_25_disturbed_tapping_B",
    "broad_26_disturbed_phone_vibration_A",
)
FURTHER = (
    "repoimu_tstick_test05_trial1",
    "repoimu_tstick_test07_trial1",
    "repoimu_tstick_test06_trial1",
)
SKIPPED = 5.0
"""s; the start of a further recording, in which the filters settle; of its end a twentieth, where
one has spikes in its reference."""

BEGUN = (15.0, 45.0)
"""s; after the first row that moves, from which on a recording is taken for one that begins so."""

DRIFT_TIME = 20.0
"""s; over which a heading without a magnetometer drifts."""

BERLIN = (np.radians(52.5), np.radians(13.3)), "2020-01-01"
"""Where BROAD was recorded, and about when: in rad, and a day."""

FITS = 3
"""Rounds in which a mounting is fitted."""


def main() -> None:
    try:
        from vqf import VQF
    except ImportError:
        print("vqf, the peer, is not installed: pip install vqf")
        return
    paths = [folder() / f"{name}.csv.gz" for name in (*SCORED, *FURTHER)]
    missing = [p.name for p in paths if not p.exists()]
    if missing:
        print(
            f"{', '.join(missing)} not in {paths[0].parent}: --data FOLDER says where the "
            "recordings are"
        )
        return
    print(
        f"{'inclination error, RMS [deg]':42s}{'pyimu':>8s}{'vqf':>8s}{'ratio':>8s}"
        f"{'95 %: pyimu':>13s}{'vqf':>8s}{'quasi-static':>13s}"
    )
    logs = {path: pyimu.read_recording(path) for path in paths}
    drifts = {}
    for path, log in logs.items():
        scored = np.isfinite(log.ref_q).all(axis=1) & moving_rows(log)
        ours = run(log, magnetometer=False)
        theirs = VQF(log.sample_period).updateBatch(
            np.ascontiguousarray(log.gyro), np.ascontiguousarray(log.accel)
        )["quat6D"]
        drifts[path] = [drift(q, log) for q in (ours.q, theirs)]
        errors = [
            inclination(q[scored], log.ref_q[scored], mounted=log.moving is None)
            for q in (ours.q, theirs)
        ]
        rms, most = [root_mean_square(e) for e in errors], [np.percentile(e, 95) for e in errors]
        print(
            f"{path.name.split('.')[0]:42s}{rms[0]:8.3f}{rms[1]:8.3f}{rms[0] / rms[1]:8.3f}"
            f"{most[0]:13.3f}{most[1]:8.3f}"
            f"{np.mean(ours.quasi_static[scored]):12.0%} {verdict(rms)}"
        )
    drift_table(drifts)
    smoothed_table(paths[: len(SCORED)])
    begun_table([logs[p] for p in paths[: len(SCORED)]], VQF)
    magnetic = [log for log in logs.values() if log.mag is not None]
    nine_axes(magnetic, VQF)
    placed_table(magnetic)
    calibrated_table(magnetic)


def nine_axes(logs: list, peer) -> None:
    """Total and heading error of both with the magnetometer, of each recording and their means;
    then the same smoothed.
    """
    from vqf import offlineVQF

    for smooth in (False, True):
        kind = "nine axes, smoothed" if smooth else "nine axes"
        print(
            f"\n{kind + ', RMS [deg]':42s}{'total':>8s}{'vqf':>8s}{'heading':>9s}{'vqf':>8s}"
            f"{'NEES':>7s}{'disturbed':>11s}"
        )
        rows = []
        for log in logs:
            samples = [np.ascontiguousarray(v) for v in (log.gyro, log.accel, log.mag)]
            theirs = (
                offlineVQF(*samples, log.sample_period)
                if smooth
                else peer(log.sample_period).updateBatch(*samples)
            )["quat9D"]
            rows.append(_nine_axes_row(log, run(log, smooth=smooth), theirs))
        mean = np.mean(rows, axis=0)
        print(
            f"{'mean':42s}{mean[0]:8.3f}{mean[1]:8.3f}{mean[2]:9.3f}{mean[3]:8.3f} "
            f"{verdict(mean[:2])}{verdict(mean[2:])}"
        )


def placed_table(logs: list) -> None:
    """Total and heading error without and with the magnetic field of the place."""
    try:
        north = Rotation.from_euler("z", -world_field(*BERLIN).declination)
    except pyimu.UserError as error:
        print(error)
        return
    print(
        f"\n{'nine axes, RMS [deg]':42s}{'total':>8s}{'placed':>8s}{'heading':>9s}{'placed':>8s}"
        f"{'NEES':>7s}{'placed':>8s}{'disturbed':>11s}{'placed':>8s}"
    )
    rows = []
    for log in logs:
        scored = np.isfinite(log.ref_q).all(axis=1) & moving_rows(log)
        true = north * Rotation.from_quat(log.ref_q[scored], scalar_first=True)
        place, date = BERLIN
        row = []
        for found, reference in (
            (run(log), log.ref_q[scored]),
            (run(log, place=place, date=date), true.as_quat(scalar_first=True)),
        ):
            total, heading = total_and_heading(found.q[scored], reference)
            nees = np.mean((heading / found.heading_std[scored]) ** 2)
            off = np.mean(found.status[scored] & DISTURBED > 0)
            rms = np.degrees([root_mean_square(total), root_mean_square(heading)])
            row.append([*rms, nees, 100 * off])
        rows.append(np.array(row).T.ravel())
        _placed_row(log.name.split(".")[0], rows[-1])
    _placed_row("mean", np.mean(rows, axis=0))


def _placed_row(name: str, row: np.ndarray) -> None:
    widths = (8, 8, 9, 8, 7, 8)
    cells = "".join(f"{v:{w}.3f}" for v, w in zip(row[:6], widths, strict=True))
    print(f"{name:42s}{cells}{row[6]:10.1f}%{row[7]:7.1f}%")


def calibrated_table(logs: list) -> None:
    """Total and heading error with the magnetometer as it is, by the calibration of the log itself
    and by that of each other log that gives one.

    Heading errors have their mean taken off in the last column: a calibration cannot know what the
    field's direction is in a place, and takes part of what the place bends for soft iron.
    """
    found = {}
    for log in logs:
        try:
            fitted = magnetometer_fit(log, run(log, magnetometer=False, smooth=True))
            found[log.name.split("_")[1]] = fitted.calibration
        except pyimu.UserError as error:
            print(error)
    print(
        f"\n{'nine axes, calibrated by, RMS [deg]':42s}{'total':>8s}{'heading':>9s}{'varying':>9s}"
    )
    for log in logs:
        scored = np.isfinite(log.ref_q).all(axis=1) & moving_rows(log)
        for name, calibration in ({"nothing": True} | found).items():
            q = run(log, magnetometer=calibration).q
            total, heading = total_and_heading(q[scored], log.ref_q[scored])
            own = " (itself)" if name == log.name.split("_")[1] else ""
            rms = (root_mean_square(total), root_mean_square(heading), np.std(heading))
            cells = "".join(f"{np.degrees(v):9.3f}" for v in rms)
            print(f"{log.name.split('.')[0][:20] + ' by ' + name + own:41s}{cells}")


def _nine_axes_row(log, ours, theirs: np.ndarray) -> np.ndarray:
    scored = np.isfinite(log.ref_q).all(axis=1) & moving_rows(log)
    errors = [total_and_heading(q[scored], log.ref_q[scored]) for q in (ours.q, theirs)]
    rms = np.degrees([[root_mean_square(e) for e in pair] for pair in errors]).T.ravel()
    nees = np.mean((errors[0][1] / ours.heading_std[scored]) ** 2)
    print(
        f"{log.name.split('.')[0]:42s}{rms[0]:8.3f}{rms[1]:8.3f}{rms[2]:9.3f}{rms[3]:8.3f}"
        f"{nees:7.2f}{np.mean(ours.status[scored] & DISTURBED > 0):11.1%}"
    )
    return rms


def total_and_heading(q: np.ndarray, reference: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angle (n,) in rad of the error of ``q`` (n, 4), and of its part about the vertical.

    The latter is that of the turn about the vertical which leaves the least (Laidig et al. 2021).
    """
    error = (
        Rotation.from_quat(q, scalar_first=True)
        * Rotation.from_quat(reference, scalar_first=True).inv()
    )
    w, _, _, z = error.as_quat(canonical=True, scalar_first=True).T
    return error.magnitude(), 2 * np.arctan2(z, w)


def smoothed_table(paths: list[Path]) -> None:
    """The error of the smoothed attitude on each recording, and the mean over them."""
    from vqf import offlineVQF

    print(
        f"\n{'smoothed: inclination error, RMS [deg]':42s}{'pyimu':>8s}{'vqf':>8s}{'ratio':>8s}"
        f"{'claimed':>9s}"
    )
    found = []
    for path in paths:
        log = pyimu.read_recording(path)
        scored = np.isfinite(log.ref_q).all(axis=1) & moving_rows(log)
        ours = run(log, smooth=True)
        gyro, accel = (np.ascontiguousarray(v) for v in (log.gyro, log.accel))
        theirs = offlineVQF(gyro, accel, None, log.sample_period)["quat6D"]
        rms = [
            root_mean_square(inclination(q[scored], log.ref_q[scored])) for q in (ours.q, theirs)
        ]
        claimed = np.degrees(np.sqrt(2) * root_mean_square(ours.tilt_std[scored]))
        found.append(rms)
        _smoothed_row(path.name.split(".")[0], rms, f"{claimed:9.3f}")
    _smoothed_row("mean", np.mean(found, axis=0), "")


def begun_table(logs: list, peer) -> None:
    """The error of recordings that begin in motion, and the mean over them."""
    print(f"\n{'begun in motion: inclination, RMS [deg]':52s}{'pyimu':>8s}{'vqf':>8s}{'ratio':>8s}")
    found = []
    for log in logs:
        moves = np.flatnonzero(moving_rows(log))
        for after in BEGUN:
            first = int(np.searchsorted(log.time, log.time[moves[0]] + after))
            begun = log.slice(first, int(moves[-1]) + 1)
            known = np.isfinite(begun.ref_q).all(axis=1)
            gyro, accel = (np.ascontiguousarray(v) for v in (begun.gyro, begun.accel))
            theirs = peer(log.sample_period).updateBatch(gyro, accel)["quat6D"]
            rms = [
                root_mean_square(inclination(q[known], begun.ref_q[known]))
                for q in (run(begun, magnetometer=False).q, theirs)
            ]
            found.append(rms)
            name = f"{log.name.split('.')[0]}, {after:.0f} s"
            print(f"{name:52s}{rms[0]:8.3f}{rms[1]:8.3f}{rms[0] / rms[1]:8.3f} {verdict(rms)}")
    mean = np.mean(found, axis=0)
    print(f"{'mean':52s}{mean[0]:8.3f}{mean[1]:8.3f}{mean[0] / mean[1]:8.3f} {verdict(mean)}")


def _smoothed_row(name: str, rms, claimed: str) -> None:
    ratio = rms[0] / rms[1]
    print(f"{name:42s}{rms[0]:8.3f}{rms[1]:8.3f}{ratio:8.3f}{claimed:9s} {verdict(rms)}")


def moving_rows(log) -> np.ndarray:
    if log.moving is not None:
        return log.moving > 0.5
    return (log.time > log.time[0] + SKIPPED) & (
        log.time < log.time[0] + 0.95 * (log.time[-1] - log.time[0])
    )


def verdict(rms) -> str:
    return "" if rms[0] <= rms[1] else "loses"


def folder() -> Path:
    if "--data" in sys.argv[:-1]:
        return Path(sys.argv[sys.argv.index("--data") + 1])
    return Path(os.environ.get("PYIMU_DATA", Path(__file__).parents[2] / "shared" / "data"))


def drift(q: np.ndarray, log) -> float:
    """deg; root mean square of how much the error of the heading of ``q`` (n, 4) changes over
    ``DRIFT_TIME`` of motion without a pause; nan where there is none.
    """
    known = np.isfinite(log.ref_q).all(axis=1)
    moves = known & (log.moving is not None and moving_rows(log))
    axes, true = (
        Rotation.from_quat(np.where(known[:, None], v, [1, 0, 0, 0]), scalar_first=True)
        for v in (q, log.ref_q)
    )
    w, _, _, z = (axes * true.inv()).as_quat(scalar_first=True).T
    off, step = 2 * np.arctan2(z, w), round(DRIFT_TIME / log.sample_period)
    starts = [i for i in range(0, len(q) - step, step) if moves[i : i + step + 1].all()]
    changes = [off[i + step] - off[i] for i in starts]
    turned = (np.array(changes) + np.pi) % (2 * np.pi) - np.pi
    return np.degrees(root_mean_square(turned)) if starts else np.nan


def drift_table(drifts: dict[Path, list[float]]) -> None:
    """The drift of the headings by six axes, and the means of those recordings that have one."""
    title = f"heading, six axes: drift in {DRIFT_TIME:g} s of motion, RMS [deg]"
    print(f"\n{title:62s}{'pyimu':>8s}{'vqf':>8s}")
    rows = {p.name.split(".")[0]: v for p, v in drifts.items() if np.isfinite(v).all()}
    rows["mean"] = np.mean(list(rows.values()), axis=0).tolist()
    for name, (ours, theirs) in rows.items():
        print(f"{name:62s}{ours:8.3f}{theirs:8.3f}")


def inclination(q: np.ndarray, reference: np.ndarray, mounted: bool = False) -> np.ndarray:
    """Angle (n,) in degrees between the vertical of ``q`` (n, 4) and that of the reference: no
    heading is in it.

    ``mounted``: the reference's body axes are turned against the sensor's, by a rotation that is
    fitted first.
    """
    up, true_up = (
        Rotation.from_quat(v, scalar_first=True).apply([0, 0, 1], inverse=True)
        for v in (q, reference)
    )
    kept = np.ones(len(up), dtype=bool)
    for _ in range(FITS if mounted else 0):
        turned = Rotation.align_vectors(up[kept], true_up[kept])[0].apply(true_up)
        off = np.linalg.norm(up - turned, axis=1)
        kept = off < np.percentile(off, 90)
    return np.degrees(angle_between(up, turned if mounted else true_up))


if __name__ == "__main__":
    main()
