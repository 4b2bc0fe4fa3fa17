"""ArduPilot's dataflash logs, binary (.bin) and text (.log), read by pymavlink.

Messages ``IMU`` (log messages of ArduPilot: ``TimeUS`` us, ``GyrX`` rad/s, ``AccX`` m/s^2, ``T``
degC, forward-right-down) of one instance ``I``; in older logs ``IMU``, ``IMU2`` and ``IMU3`` are
the instances. ``ATT`` is a filter's estimate, and no truth.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.reader import need
from pyimu.recording.formats.streams import StreamReader, reading, unheard

NAMES = ("IMU", "IMU2", "IMU3")

FIELDS = {"GyrX": "gyro_x [rad/s]", "GyrY": "gyro_y [rad/s]", "GyrZ": "gyro_z [rad/s]"} | {
    "AccX": "accel_x [m/s^2]",
    "AccY": "accel_y [m/s^2]",
    "AccZ": "accel_z [m/s^2]",
}

TEMPERATURES = ("T", "Temp")
"""What the thermometer's field is called, in newer and older logs."""


MAGIC = b"\xa3\x95"
"""What a binary log begins with."""

DAMAGE = ("bad header", "unknown msg type", "Skipped", "bad msg", "Failed to parse")
"""What pymavlink's lines say where it passes over bytes."""


class DataflashReader:
    """Opens dataflash logs; see the module."""

    @classmethod
    def open(cls, path: Path, topics: Mapping[str, str]) -> StreamReader:
        """``topics`` may name "imu": ``IMU[1]`` or ``IMU2`` for the second instance.

        Raises UserError for a file that is none, where pymavlink is not installed, and for an
        instance that is not there.
        """
        module = need("pymavlink.DFReader", "ardupilot", path)
        with reading(path, "a dataflash log"):
            if "temperature" in topics:
                raise UserError(f"{path}: key topics.temperature is for ROS bags; leave it out")
            with unheard(DAMAGE) as damaged:
                streams = _streams(_opened(module, path))
            columns, findings = _columns(streams, _instance(path, topics.get("imu"), streams))
            if damaged():
                findings += (Finding("damaged", "", 1, {"part": "some messages"}),)
            return StreamReader(path, columns, findings)


def is_dataflash(path: Path) -> bool:
    """Whether a ``.log`` is one of these, or the text of something else, as of a serial monitor."""
    with path.open("rb") as file:
        head = file.read(4096)
    return head[:2] == MAGIC or re.search(rb"^FMT, ?", head, re.M) is not None


def _opened(module: ModuleType, path: Path) -> Any:
    """Raises UserError for a file that begins as no dataflash log does."""
    with path.open("rb") as file:
        head = file.read(2)
    if head == MAGIC:
        return _in_python(module.DFReader_binary)(str(path))
    if path.suffix.lower() == ".log":
        return module.DFReader_text(str(path))
    raise UserError(f"{path}: no dataflash log, it begins with {head.hex()}, not a395")


def _in_python(reader: type) -> type:
    """The reader without its index in C.

    That passes over damaged messages in silence, or with lines that only the system could keep
    from the screen, and saves little: nearly all the time goes into the messages themselves.
    """
    return type("Reader", (reader,), {"init_arrays_fast": reader.init_arrays})


def _streams(log: Any) -> dict[int, list[Any]]:
    """The messages of each instance, as (time, six values, temperature)."""
    streams: dict[int, list[Any]] = {}
    while (message := log.recv_match(type=list(NAMES))) is not None:
        values = message.to_dict()
        kind = values.pop("mavpackettype")
        instance = int(values.get("I", NAMES.index(kind)))
        degrees = next((float(values[t]) for t in TEMPERATURES if t in values), np.nan)
        row = [float(values[name]) for name in FIELDS]
        streams.setdefault(instance, []).append((int(values["TimeUS"]), row, degrees))
    return streams


def _instance(path: Path, named: str | None, streams: Mapping[int, Any]) -> int:
    if not streams:
        raise UserError(f"{path}: no IMU messages in it (LOG_BITMASK of ArduPilot turns them on)")
    if named is None:
        return min(streams)
    known = {f"IMU[{k}]": k for k in streams} | {f"IMU{k + 1 if k else ''}": k for k in streams}
    if named not in known:
        there = ", ".join(f"IMU[{k}]" for k in sorted(streams))
        raise UserError(f"{path}: no topic {named}; there are {there}")
    return known[named]


def _columns(
    streams: Mapping[int, list[Any]], wanted: int
) -> tuple[dict[str, np.ndarray], tuple[Finding, ...]]:
    rows = streams[wanted]
    values = np.array([row for _, row, _ in rows])
    columns = {"time [us]": np.array([time for time, _, _ in rows], dtype=np.int64)}
    columns |= {name: values[:, k] for k, name in enumerate(FIELDS.values())}
    degrees = np.array([value for _, _, value in rows])
    if np.isfinite(degrees).any():
        columns["temperature [degC]"] = degrees
    others = ", ".join(f"IMU[{k}]" for k in sorted(streams) if k != wanted)
    unused = (Finding("unused_topic", "", len(streams) - 1, {"topics": others}),) if others else ()
    return columns, unused
