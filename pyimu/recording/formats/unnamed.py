"""Tables without names whose columns are known by their number and by what stands in them."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

from pyimu.recording.formats.bodies import PAMAP2, WISDM, is_pamap2, is_wisdm

MESSAGE = (
    *("header.stamp.sec", "header.stamp.nanosec", "header.frame_id"),
    *(f"orientation.{a}" for a in "xyzw"),
    *(f"orientation_covariance[{k}]" for k in range(9)),
    *(f"angular_velocity.{a}" for a in "xyz"),
    *(f"angular_velocity_covariance[{k}]" for k in range(9)),
    *(f"linear_acceleration.{a}" for a in "xyz"),
    *(f"linear_acceleration_covariance[{k}]" for k in range(9)),
)
"""The fields of ROS 2's sensor_msgs/Imu in the order of its definition, in which ``ros2 topic echo
--csv`` prints them."""

POSE = (
    *MESSAGE[:3],
    *(f"pose.position.{a}" for a in "xyz"),
    *(f"pose.orientation.{a}" for a in "xyzw"),
)
"""Those of geometry_msgs/PoseStamped."""

TRAJECTORY = ("timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw")
"""A line of TUM's format, whose numbers stand between blanks."""

MATRIX = (
    "timestamp",
    *(c for r, a in enumerate("xyz") for c in (*(f"pose Rot[{3 * k + r}]" for k in range(3)), a)),
)
"""A time and the three rows of a rotation and a place, as of KAIST's ``global_pose.csv``."""

ORTHOGONAL = 0.01
"""By how much rows of a rotation of few digits may be off length one and right angles."""

LENGTH = 0.02
"""By how much the length of a quaternion of few digits may be off one."""


def names_of(rows: Sequence[Sequence[str]], separator: str) -> tuple[str, ...]:
    """The names of the columns of ``rows``, empty where these are not known."""
    if rows and all(_is_message(row, MESSAGE) for row in rows):
        return MESSAGE
    if rows and all(_is_message(row, POSE) and _is_turn(row[6:]) for row in rows):
        return POSE
    if rows and separator == " " and all(map(_is_pose, rows)) and _rises(rows):
        return TRAJECTORY
    if rows and all(map(_is_matrix, rows)) and _rises(rows):
        return MATRIX
    if rows and all(map(is_wisdm, rows)):
        return WISDM
    if rows and separator == " " and all(map(is_pamap2, rows)) and _rises(rows):
        return PAMAP2
    return ()


def _is_message(row: Sequence[str], names: Sequence[str]) -> bool:
    """Whether a row begins as a message with a header does, and has as many numbers behind it."""
    if len(row) != len(names) or _number(row[2]) is not None:
        return False
    second, part, *numbers = (_number(cell) for k, cell in enumerate(row) if k != 2)
    whole = row[0].strip().isdigit() and row[1].strip().isdigit()
    return whole and None not in numbers and part is not None and part < 1e9


def _is_pose(row: Sequence[str]) -> bool:
    numbers = [_number(cell) for cell in row]
    return len(row) == len(TRAJECTORY) and None not in numbers and _is_turn(row[4:])


def _is_matrix(row: Sequence[str]) -> bool:
    """Whether cells are a time and a rotation beside a place."""
    numbers = [n for cell in row if (n := _number(cell)) is not None]
    if len(row) != len(MATRIX) or len(numbers) < len(row):
        return False
    axes = [numbers[k : k + 3] for k in (1, 5, 9)]
    off = [abs(hypot(*axis) - 1) for axis in axes]
    pairs = ((axes[0], axes[1]), (axes[0], axes[2]), (axes[1], axes[2]))
    off += [abs(sum(a * b for a, b in zip(*pair, strict=True))) for pair in pairs]
    return max(off) < ORTHOGONAL


def _is_turn(cells: Sequence[str]) -> bool:
    """Whether four cells are those of a quaternion: of length one."""
    numbers = [_number(cell) for cell in cells]
    return abs(hypot(*(n for n in numbers if n is not None)) - 1) < LENGTH


def _rises(rows: Sequence[Sequence[str]]) -> bool:
    times = [float(row[0]) for row in rows]
    return len(times) > 2 and all(a < b for a, b in zip(times, times[1:], strict=False))


def _number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None
