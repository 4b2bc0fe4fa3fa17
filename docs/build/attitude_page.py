"""Write the tables of ``docs/attitude.md`` from the definitions, and draw its picture.

``python docs/build/attitude_page.py [--picture]``. The text around the tables is written by hand; a
test keeps the tables fresh. The picture takes a minute, as the loop is closed for it: it is drawn
only where it is asked for, and the figures in its caption are printed then.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import numpy as np
from pages import DOCS, row, write_changed

from pyimu import attitude, close
from pyimu.attitude.error import root_mean_square
from pyimu.attitude.filter.status import STATUS
from pyimu.attitude.filter.variables import SETTINGS
from pyimu.attitude.result import AttitudeResult
from pyimu.report.figures import AFTER, BEFORE, FLOOR, legend, new_figure, style
from pyimu.rover.demo import recording

NAME = "attitude"

BETWEEN = re.compile(r"(<!-- (\w+), by make generate -->\n).*?(<!-- end -->)", re.DOTALL)


def settings() -> str:
    """The filter's settings with their units and start values."""
    lines = [row(("setting", "unit", "else", "what it is")), row(["---"] * 4)]
    seen = set()
    for v in SETTINGS:
        name, _, axis = v.name.partition("[")
        if name not in seen:
            seen.add(name)
            shown = f"`{name}[1..6]`" if axis else f"`{name}`"
            lines.append(row((shown, v.unit, f"{v.start:g}", v.description)))
    return "\n".join(lines)


def status() -> str:
    """The bits of the status."""
    lines = [row(("bit", "what it says")), "| --- | --- |"]
    return "\n".join([*lines, *(row((f"{bit}", text)) for bit, text in STATUS.items())])


FOUND = "part that close found"

TABLES = {"settings": settings, "status": status}


def filled(text: str) -> str:
    """The page's ``text`` with its tables as the definitions have them."""
    return BETWEEN.sub(lambda found: f"{found[1]}\n{TABLES[found[2]]()}\n\n{found[3]}", text)


def draw(path: Path) -> list[str]:
    """Draw what a part is worth on the demo's drive; gives a line for each curve."""
    log = recording()
    found = close(log, "imt30").after
    shown = {
        "part as declared": (attitude.run(log, "imt30"), BEFORE),
        FOUND: (attitude.run(log, found), AFTER),
        "the same, smoothed": (attitude.run(log, found, smooth=True), FLOOR),
    }
    with style({"figure.facecolor": "white", "axes.facecolor": "white"}):
        figure, (panel,) = new_figure(8.4, 3.2)
        for name, (a, colour) in shown.items():
            error = a.error
            heading = np.degrees(error.heading)[::25]
            panel.plot(error.time[::25], heading, color=colour, lw=1.4, label=name)
        filtered, colour = shown[FOUND]
        # The heading is set right at the start, where nothing tells it.
        std = np.sqrt(np.maximum(filtered.heading_std**2 - filtered.heading_std[0] ** 2, 0))
        wide, label = 2 * np.degrees(std)[::25], "±2 std that the filter claims"
        panel.fill_between(
            filtered.time[::25], -wide, wide, color=colour, alpha=0.15, lw=0, label=label
        )
        panel.set(xlabel="time [s]", ylabel="heading error [deg]")
        legend(figure, panel, 4)
        figure.savefig(path, dpi=130)
    return [f"{name}: {_sizes(a)}" for name, (a, _) in shown.items()]


def _sizes(a: AttitudeResult) -> str:
    sides = {"heading": a.error.heading, "inclination": a.error.inclination}
    return ", ".join(f"{n} {np.degrees(root_mean_square(v)):.3g} deg RMS" for n, v in sides.items())


def write(folder: Path = DOCS, picture: bool = False) -> None:
    """Bring the page in ``folder`` up to date, and say what changed."""
    page = folder / f"{NAME}.md"
    if write_changed(page, filled(page.read_text(encoding="utf-8"))):
        print(page)
    if picture:
        print("\n".join(draw(folder / f"{NAME}.png")))


if __name__ == "__main__":
    write(picture="--picture" in sys.argv[1:])
