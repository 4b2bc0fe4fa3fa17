"""One run of a campaign once more, with its log and its pictures."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from pyimu.attitude.filter.status import STATUS_NAMES
from pyimu.errors import UserError
from pyimu.files import staged, write_json
from pyimu.recording.recording import Recording
from pyimu.report.figures import AFTER, BEFORE, STYLE, new_figure, unit_of_time
from pyimu.rover.campaign.one_run import Drive, driven
from pyimu.rover.campaign.score import ANGLES, row
from pyimu.rover.campaign.settings import Settings

BAND = 2.0
"""Standard deviations on either side that a band shows."""


def repeat(settings: Settings, number: int, out: Path | str) -> Path:
    """Write ``log.parquet``, ``run.json`` and ``errors.png`` of a run into its folder in ``out``.

    The log is what the filter took, at its rate, with the true attitude as its reference; ``pyimu
    attitude`` reads it. Gives the folder. Raises UserError for a number below zero.
    """
    if number < 0:
        raise UserError(f"run {number}: runs are numbered from 0 on")
    drive = driven(settings, number, keep=True)
    folder = Path(out) / f"run-{number:06d}"
    with staged(folder) as stage:
        log_of(drive).write(stage / "log.parquet")
        write_json(stage / "run.json", row(drive))
        with matplotlib.rc_context(STYLE | {"figure.facecolor": "white"}):
            errors_figure(drive).savefig(stage / "errors.png", dpi=120)
    return folder


def log_of(drive: Drive) -> Recording:
    """What the filter took, as a recording with the truth."""
    inputs = {v.name: drive.inputs[:, i] for i, v in enumerate(drive.system.filter.inputs)}
    columns = {
        "time": drive.truth.time,
        "gyro": drive.inputs[:, :3],
        "accel": drive.inputs[:, 3:6],
        "temperature": inputs["temperature"],
        "stationary": inputs["stationary"],
        "ref_q": drive.truth.q,
        "latitude": np.full(len(drive.inputs), drive.truth.latitude),
    }
    valid = inputs["heading_valid"] > 0
    if valid.any():
        columns["heading"] = np.where(valid, inputs["heading"], np.nan)
        columns["heading_std"] = np.where(valid, np.sqrt(inputs["heading_variance"]), np.nan)
    return Recording.from_arrays(name=f"run {drive.draws.number}", **columns)


def errors_figure(drive: Drive) -> Figure:
    """Errors of heading, pitch and roll [deg] with what the filter says of them, and its status."""
    figure, panels = new_figure(8.4, 7.6, 5)
    size, unit = unit_of_time(drive.truth.time[-1])
    time, found = drive.truth.time / size, np.rad2deg(drive.errors)
    # To first order of a rover that is nearly level: about its own axes.
    stds = np.rad2deg(np.column_stack([drive.output("std[1]", 2), drive.output("heading_std")]))
    for i, panel in zip((2, 1, 0), panels, strict=False):
        band = BAND * stds[:, i]
        panel.fill_between(time, -band, band, color=AFTER, alpha=0.2, lw=0)
        panel.plot(time, found[:, i], color=AFTER, lw=0.9)
        panel.set_ylabel(f"{ANGLES[i]}\nerror [deg]")
        shown = np.abs(found[drive.truth.first :, i]).max()
        panel.set_ylim(*(1.3 * max(shown, np.median(band)) * np.array([-1, 1])))
    panels[3].plot(time, np.rad2deg(np.unwrap(drive.truth.euler, axis=0))[:, 2], color=BEFORE)
    panels[3].set_ylabel("true\nheading [deg]")
    _status(drive, time, panels[4])
    panels[4].set_xlabel(f"time [{unit}]")
    fault = drive.fault
    if np.isfinite(fault.time):
        for panel in panels:
            panel.axvline(fault.time / size, color=BEFORE, ls="--", lw=1)
    said = f", {fault.name}" if np.isfinite(fault.time) else ""
    panels[0].set_title(f"run {drive.draws.number}{said}; bands: {BAND:g} std", fontsize=9.5)
    return figure


def _status(drive: Drive, time: np.ndarray, panel) -> None:
    """When each bit of the status was set that ever was."""
    status = drive.status
    names = [(bit, words) for bit, words in STATUS_NAMES.items() if (status & bit).any()]
    for place, (bit, _) in enumerate(names):
        at = (status & bit) != 0
        panel.plot(time[at], np.full(at.sum(), place), "|", color=BEFORE, ms=9)
    panel.set_yticks(range(len(names)), [words for _, words in names])
    panel.set_ylim(-0.6, max(len(names), 1) - 0.4)
    panel.set_ylabel("status" if names else "status: well")
