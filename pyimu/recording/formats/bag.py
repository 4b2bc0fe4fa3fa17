"""ROS 1 and ROS 2 bags and MCAP files, read by rosbags.

Messages are of ``sensor_msgs/Imu`` and ``sensor_msgs/Temperature``.

Units are those of the message definitions: rad/s, m/s^2, degC. The time is the header's stamp, or
the time of logging where the stamps are not set. An Imu's orientation is a filter's estimate and
no truth, so it is left out; covariances too, but for a first element of -1, by which the definition
marks a quantity that the sensor does not have.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.columns import GROUPS, column_names
from pyimu.recording.formats.reader import Columns, Reader, need
from pyimu.recording.formats.streams import reading

TYPES = {"imu": "sensor_msgs/msg/Imu", "temperature": "sensor_msgs/msg/Temperature"}
"""What a topic of each role holds."""

BATCH = 1 << 14
"""Messages of a piece."""

_FIELDS = {"gyro": "angular_velocity", "accel": "linear_acceleration"}


@dataclass(frozen=True)
class BagReader(Reader):
    """A bag: its Imu messages, and a temperature interpolated at their times.

    ``topic`` is that of the Imu messages, ``messages`` their number, ``groups`` the sensors in
    them, ``temperature`` the times [ns] and values [degC].

    Imu messages are read one by one, those of the temperature all at once.
    """

    path: Path
    header: list[str]
    topic: str
    messages: int
    groups: tuple[str, ...]
    logged: bool
    temperature: tuple[np.ndarray, np.ndarray] | None
    findings: tuple[Finding, ...] = ()

    @classmethod
    def open(cls, path: Path, topics: Mapping[str, str]) -> BagReader:
        """Open a bag; ``topics`` names those of "imu" and "temperature".

        A topic that is not named is the only one of its type.

        Raises UserError for a file that is no bag, where rosbags is not installed, and for a topic
        that is not there or not clear.
        """
        with _bag(path) as bag:
            findings: list[Finding] = []
            topic = _imu_topic(path, bag, topics.get("imu"))
            first = next(
                (_message(bag, *item) for item in bag.messages(_connections(bag, topic))), None
            )
            if first is None:
                raise UserError(f"{path}: topic {topic} has no messages")
            logged = _stamp(first) == 0
            groups = tuple(
                g for g, name in _FIELDS.items() if getattr(first, f"{name}_covariance")[0] != -1
            )
            count = sum(c.msgcount for c in _connections(bag, topic))
            if logged:
                findings.append(Finding("log_time", "time", count, {"topic": topic}))
            temperature = _temperature(path, bag, topics.get("temperature"), logged, findings)
            return cls(
                path,
                _header(groups, temperature is not None),
                topic,
                count,
                groups,
                logged,
                temperature,
                tuple(findings),
            )

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        with _bag(self.path) as bag:
            times, rows, done = [], [], 0
            for connection, logged, raw in bag.messages(_connections(bag, self.topic)):
                message = _message(bag, connection, logged, raw)
                times.append(logged if self.logged else _stamp(message))
                rows.append(
                    [
                        part
                        for group in self.groups
                        for part in _xyz(getattr(message, _FIELDS[group]))
                    ]
                )
                if len(rows) == BATCH:
                    done += BATCH
                    yield self._columns(times, rows, positions), done / self.messages
                    times, rows = [], []
            if rows:
                yield self._columns(times, rows, positions), 1.0

    def _columns(
        self, times: list[int], rows: list[list[float]], positions: Sequence[int]
    ) -> Columns:
        time = np.array(times, dtype=np.int64)
        columns = [time, *np.array(rows, dtype=float).reshape(len(rows), -1).T]
        if self.temperature is not None:
            stamp, value = self.temperature
            columns.append(
                np.interp((time - stamp[0]).astype(float), (stamp - stamp[0]).astype(float), value)
            )
        return [columns[position] for position in positions]

    def count(self, long: int) -> int:
        return self.messages

    def place(self, index: int) -> str:
        return f"message {index} of {self.topic}"


@contextmanager
def _bag(path: Path) -> Iterator[Any]:
    highlevel = need("rosbags.highlevel", "ros", path)
    typesys = need("rosbags.typesys", "ros", path)
    # bags of ROS 2 before Iron hold no definitions; Imu and Temperature have been the same in all
    # Its errors have no common class: those of SQLite, YAML and two bag formats pass through.
    with (
        reading(path, "a ROS bag"),
        highlevel.AnyReader(
            [path], default_typestore=typesys.get_typestore(typesys.Stores.LATEST)
        ) as bag,
    ):
        yield bag


def _message(bag: Any, connection: Any, logged: int, raw: bytes) -> Any:
    return bag.deserialize(raw, connection.msgtype)


def _stamp(message: Any) -> int:
    """ns of the header's stamp."""
    return message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec


def _xyz(vector: Any) -> tuple[float, float, float]:
    return vector.x, vector.y, vector.z


def _topics(bag: Any, role: str) -> list[str]:
    return sorted({c.topic for c in bag.connections if c.msgtype == TYPES[role]})


def _connections(bag: Any, topic: str) -> list[Any]:
    return [c for c in bag.connections if c.topic == topic]


def _named(path: Path, role: str, topic: str, known: Sequence[str]) -> str:
    if topic not in known:
        raise UserError(
            f"{path}: no topic {topic} of type {TYPES[role]}; there are "
            f"{', '.join(known) or 'none of it'}"
        )
    return topic


def _imu_topic(path: Path, bag: Any, named: str | None) -> str:
    known = _topics(bag, "imu")
    if named is not None:
        return _named(path, "imu", named, known)
    if not known:
        others = ", ".join(sorted({f"{c.topic} ({c.msgtype})" for c in bag.connections})[:8])
        raise UserError(
            f"{path}: no topic of type {TYPES['imu']}; there are {others or 'no topics'}"
        )
    if len(known) > 1:
        raise UserError(
            f"{path}: {len(known)} topics of type {TYPES['imu']} ({', '.join(known)}), "
            f'name one in a column map: [topics] imu = "{known[0]}"'
        )
    return known[0]


def _temperature(
    path: Path, bag: Any, named: str | None, logged: bool, findings: list[Finding]
) -> tuple[np.ndarray, np.ndarray] | None:
    """Times [ns] and temperatures [degC] of the topic, in order of time.

    None where there is no such topic or it is not clear which.
    """
    known = _topics(bag, "temperature")
    if named is None and len(known) != 1:
        findings += (
            [Finding("unused_topic", "temperature", len(known), {"topics": ", ".join(known)})]
            if known
            else []
        )
        return None
    topic = known[0] if named is None else _named(path, "temperature", named, known)
    pairs = [
        (time if logged else _stamp(m), m.temperature)
        for time, m in (
            (time, _message(bag, c, time, raw))
            for c, time, raw in bag.messages(_connections(bag, topic))
        )
    ]
    pairs = sorted(pair for pair in pairs if pair[0] and np.isfinite(pair[1]))
    if not pairs:
        findings.append(Finding("unused_topic", "temperature", 1, {"topics": topic}))
        return None
    findings.append(Finding("interpolated", "temperature", len(pairs), {"topic": topic}))
    return np.array([time for time, _ in pairs], dtype=np.int64), np.array(
        [value for _, value in pairs], dtype=float
    )


def _header(groups: Sequence[str], temperature: bool) -> list[str]:
    names = [
        f"{name} [{GROUPS[group].unit}]"
        for group in (*groups, *(["temperature"] if temperature else []))
        for name in column_names(group)
    ]
    return ["time [ns]", *names]
