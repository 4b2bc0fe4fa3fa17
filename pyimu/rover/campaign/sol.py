"""The rover's claim: two degrees after one sol, without and with a heading sensor once an hour."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from pyimu.display.silent import silent
from pyimu.files import write_json
from pyimu.rover.campaign.campaign import Done, Say, duration, run
from pyimu.rover.campaign.motion import SOL
from pyimu.rover.campaign.report.as_json import share_of
from pyimu.rover.campaign.report.words import claim
from pyimu.rover.campaign.settings import Settings

HOURLY = 3600.0
"""s between the headings of a sensor that is asked once an hour."""

VARIANTS = {"without-heading": 0.0, "heading-hourly": HOURLY}
"""Folders of the two campaigns, and the s between headings."""


@dataclass(frozen=True)
class Sols:
    """The campaigns of the claim by the names of their folders."""

    done: dict[str, Done]
    data: Path
    """The file that has their shares as JSON."""

    def report(self) -> str:
        """The shares line by line."""
        out = []
        for name, one in self.done.items():
            out.append(
                f"{name.replace('-', ' ')}: {one.count} sols, {one.computed} of them now in "
                f"{duration(one.seconds)}"
            )
            out += [f"  {claim(one.summary, kind)}" for kind in ("end", "max")]
        return "\n".join(out)

    @property
    def where(self) -> str:
        """Where their reports are."""
        return "reports: " + ", ".join(str(one.folder.page) for one in self.done.values())


def sols(
    settings: Settings,
    runs: int,
    out: Path | str,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    say: Say = silent,
) -> Sols:
    """Run the sols of ``settings`` with and without headings, each as ``run`` does.

    Specimens, motions, temperatures and noise of a number are the same in both. ``sol.json`` has
    the shares side by side.
    """
    done = {}
    for name, every in VARIANTS.items():
        one = replace(settings, drive=SOL, heading_every=every)
        done[name] = run(one, runs, Path(out) / name, scheduler=scheduler, workers=workers, say=say)
    shares = {
        name: {kind: share_of(one.summary.within(kind)) for kind in ("end", "max")}
        for name, one in done.items()
    }
    data = Path(out) / "sol.json"
    write_json(data, shares)
    return Sols(done, data)
