"""PX4's ULog files, read by pyulog.

The stream is ``sensor_combined`` (PX4's message definition: ``timestamp`` us, ``gyro_rad`` rad/s
and ``accelerometer_m_s2`` m/s^2, forward-right-down), or ``sensor_gyro`` and ``sensor_accel`` with
the same number, ``x, y, z`` in the same units and ``temperature`` in degC. ``vehicle_attitude`` is
a filter's estimate, and no truth.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.reader import need
from pyimu.recording.formats.streams import StreamReader, onto, reading, unheard

TOPICS = ("sensor_combined", "sensor_gyro", "sensor_accel", "vehicle_imu")
"""What is read of a file."""

AXES = "xyz"


class UlogReader:
    """Opens ULog files; see the module."""

    @classmethod
    def open(cls, path: Path, topics: Mapping[str, str]) -> StreamReader:
        """``topics`` may name "imu": ``sensor_combined``, or ``sensor_gyro`` with a number behind
        it.

        Raises UserError for a file that is none, where pyulog is not installed, and for a topic
        that is not there.
        """
        core = need("pyulog.core", "ulog", path)
        with reading(path, "ULog"):
            with unheard():
                log = core.ULog(str(path), list(TOPICS), True)
            found = {
                (d.name, d.multi_id): d.data for d in log.data_list if len(d.data["timestamp"])
            }
            if "temperature" in topics:
                raise UserError(f"{path}: key topics.temperature is for ROS bags; leave it out")
            name, number = _wanted(path, topics.get("imu"), found)
            columns, findings = _columns(found, name, number)
            lost = sum(d.duration for d in log.dropouts)
            if lost:
                detail = {"total": lost * 1e-3}
                findings.append(Finding("dropouts", "time", len(log.dropouts), detail))
            if log.file_corruption:
                findings.append(Finding("damaged", "", 1, {"part": "some messages"}))
            return StreamReader(path, columns, tuple(findings))


def _wanted(path: Path, named: str | None, found: Mapping[tuple[str, int], Any]) -> tuple[str, int]:
    """Topic and number of the stream that is read."""
    known = [key for key in found if key[0] in ("sensor_combined", "sensor_gyro")]
    if named is not None:
        name, _, number = named.replace("/", " ").replace("[", " ").rstrip("]").partition(" ")
        key = name, int(number) if number.strip().isdigit() else 0
        if key not in known:
            there = ", ".join(f"{n}/{k}" for n, k in known) or "none"
            raise UserError(f"{path}: no topic {named}; there are {there}")
        return key
    if not known:
        raise UserError(f"{path}: no sensor_combined and no sensor_gyro is logged in it")
    return min(known, key=lambda key: (key[0] != "sensor_combined", key[1]))


def _columns(
    found: Mapping[tuple[str, int], Any], name: str, number: int
) -> tuple[dict[str, np.ndarray], list[Finding]]:
    data = found[name, number]
    time = data["timestamp"].astype(np.int64)
    if name == "sensor_combined":
        gyro = {f"gyro_{a} [rad/s]": data[f"gyro_rad[{k}]"] for k, a in enumerate(AXES)}
        accel = {f"accel_{a} [m/s^2]": data[f"accelerometer_m_s2[{k}]"] for k, a in enumerate(AXES)}
        return {"time [us]": time} | gyro | accel, []
    clock = data.get("timestamp_sample", data["timestamp"]).astype(np.int64)
    columns = {"time [us]": clock} | {f"gyro_{a} [rad/s]": data[a] for a in AXES}
    findings: list[Finding] = []
    other = found.get(("sensor_accel", number))
    if other is not None:
        theirs = other.get("timestamp_sample", other["timestamp"]).astype(np.int64)
        columns |= {f"accel_{a} [m/s^2]": onto(clock, theirs, other[a]) for a in AXES}
        findings.append(Finding("interpolated", "accel", len(theirs), {"topic": "sensor_accel"}))
    if "temperature" in data:
        columns["temperature [degC]"] = data["temperature"]
    return columns, findings
