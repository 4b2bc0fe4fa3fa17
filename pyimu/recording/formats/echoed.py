"""ROS's messages as ``rostopic echo`` and ``ros2 topic echo`` print them: a number on a line behind
its field, fields in fields further right, and ``---`` behind each message.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from pyimu.recording.formats.marked import Marked

END = "---"

WITHIN = (("angular_velocity.z", "linear_acceleration.z"), ("position.z", "orientation.w"))
"""Fields of the messages that are read, an inertial unit's or a pose's."""

_FIELD = re.compile(r"( *)([A-Za-z_]\w*): *(.*?) *")


def echoed(lines: Sequence[str]) -> Marked | None:
    """How printed messages are read, None of any other file, and of one whose first message is not
    whole among the ``lines``.
    """
    first = Message()
    if not any(first.take(line) for line in lines):
        return None
    names = tuple(first.whole)
    if not any(all(any(n.endswith(f) for n in names) for f in fields) for fields in WITHIN):
        return None
    said = "messages that were printed"
    # The blank row of a message's first line, so that reading begins with it.
    return Marked(
        names, lambda line: None if line.strip() == END else "", said, anew=lambda: Rows(names)
    )


class Message:
    """The numbers of one message after the other, by the names of their fields, such as
    ``header.stamp.secs``; ``whole`` are those of the last one that ended.
    """

    def __init__(self) -> None:
        self._path: list[tuple[int, str]] = []
        self._numbers: dict[str, str] = {}
        self.whole: dict[str, str] = {}

    def take(self, line: str) -> bool:
        """Take a line; whether a message ended with it."""
        line = line.rstrip("\r\n")
        if line.strip() == END:
            self.whole, self._numbers, self._path = self._numbers, {}, []
            return bool(self.whole)
        match = _FIELD.fullmatch(line)
        if match is None:
            return False
        indent = len(match[1])
        self._path = [step for step in self._path if step[0] < indent]
        if not match[3]:
            self._path.append((indent, match[2]))
        elif _is_number(match[3]):
            self._numbers[".".join([*(name for _, name in self._path), match[2]])] = match[3]
        return False


class Rows:
    """Makes a row of the lines of a message: nothing of all but its end."""

    def __init__(self, names: Sequence[str]) -> None:
        self._names, self._message = names, Message()

    def __call__(self, line: str) -> str | None:
        if not self._message.take(line):
            return None
        return ",".join(self._message.whole.get(name, "") for name in self._names)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return "_" not in text
