"""What stands at the head of every exported file: of what part it is, and what it leaves out."""

from __future__ import annotations

import numpy as np

from pyimu.model.kinds import KINDS
from pyimu.model.part import Part


def header(part: Part, kept: set[str], lines: tuple[str, ...] = (), mark: str = "#") -> str:
    """Comment lines: the part, the inflation, and which of its effects the format has no place for.

    ``kept`` are the names of effects that the file has.
    """
    text = [
        f"{part.name}: {part.description or 'no description'}",
        "written by pyimu; {inflation}",
        *lines,
    ]
    lost = sorted(
        f"{kind} {e.name}"
        for kind in KINDS
        for e in part.sensor(kind).effects
        if e.name not in kept
        and any(
            np.any(part.sensor(kind).values[e.name][n] != q.start) for n, q in e.parameters.items()
        )
    )
    if lost:
        text.append(f"of the part, this format has no place for: {', '.join(lost)}")
    return "".join(f"{mark} {line}\n" for line in text)
