"""References in tables of optical systems: the attitude and the place of one body.

Their axes of the world are what was calibrated, in Motive with y up; a comparison with the
accelerometer turns them. Lost frames are blank, or no rotation.
"""

from __future__ import annotations

from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.counts import Scale
from pyimu.recording.formats.optical import FRAME, SECONDS, SUB_FRAME, TIME
from pyimu.recording.formats.reader import Reader
from pyimu.units import parse

PLACE = tuple(zip(XYZ, ("ref_east", "ref_north", "ref_up"), strict=True))

BODIES = (
    (SECONDS, " Rotation ", "XYZW", " Position "),
    (SUB_FRAME, " R", "XYZW", " T"),
    (TIME, " attitude ", "xyzw", " "),
)
"""By the second column what stands before the axes of an attitude, its axes, and what before those
of a place: of Motive, Vicon and Qualisys."""


def bodies(reader: Reader) -> dict[str, dict[str, str]]:
    """The bodies in a table of an optical system, each with the columns of its attitude and place
    and what they are; empty of any other table.
    """
    if reader.header[:1] != [FRAME]:
        return {}
    second, turn, axes, place = next((b for b in BODIES if reader.header[1:2] == [b[0]]), BODIES[0])
    cells = {cell.partition(" [")[0]: cell for cell in reader.header}
    found = {}
    for cell in reader.header:
        name = cell.removesuffix(turn + axes[-1])
        if name != cell and all(f"{name}{turn}{a}" in cells for a in axes):
            attitude = {f"{name}{turn}{a}": f"ref_q_{a.lower()} [1]" for a in axes}
            found[name] = attitude | {
                cells[f"{name}{place}{a.upper()}"]: f"{target} [{unit}]"
                for a, target in PLACE
                if (unit := _unit(cells.get(f"{name}{place}{a.upper()}", "")))
            }
    return found


def _unit(cell: str) -> str:
    return cell.partition(" [")[2].rstrip("]")


def optical_body(reader: Reader) -> ForeignMap | None:
    """The map of a table of an optical system that holds one body.

    Frames count the time where the rate is said, but of Qualisys: Motive rounds its times to
    milliseconds, and Vicon has none.
    """
    found = bodies(reader)
    if len(found) != 1:
        return None
    (columns,) = found.values()
    if reader.rate is None or reader.header[1] == TIME:
        if reader.header[1] == SUB_FRAME:
            return None
        return ForeignMap(columns={reader.header[1]: "time [s]"} | columns)
    scale = {"time": Scale(1 / reader.rate, parse("s"))}
    return ForeignMap(columns={FRAME: "time [count]"} | columns, scale=scale)


def question(reader: Reader) -> str:
    """What is to be asked of a table of an optical system without a map: which body, or for
    another export; empty of any other table.
    """
    if reader.header[:1] != [FRAME] or reader.header[1:2] not in [[b[0]] for b in BODIES]:
        return ""
    found = bodies(reader)
    if len(found) > 1:
        return (
            f"it holds {len(found)} bodies: {', '.join(found)}: name the one's columns in the map"
        )
    return (
        "it holds no attitude of a body as quaternions or a matrix: export those (Motive: rigid "
        "bodies, Rotation Type Quaternion; Vicon: RX to RW; Qualisys: 6D data)"
    )


def lines_of(reader: Reader) -> list[str]:
    """The lines of a column map for each body, of a table with several."""
    found = bodies(reader)
    each = {b: ", ".join(f'"{c}" = "{t}"' for c, t in own.items()) for b, own in found.items()}
    return [f"the body {body}: {said}" for body, said in each.items()] if len(found) > 1 else []
