"""The result of ``pyimu.plan``: what it says, and what can be done with it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pyimu.display.silent import silent
from pyimu.files import staged, write_json, write_text
from pyimu.identification.plan.outcome import Outcome
from pyimu.identification.plan.page import page
from pyimu.identification.plan.words import in_lines


@dataclass(frozen=True)
class Plan(Outcome):
    """Result of ``pyimu.plan``: motions to make, and what they would show."""

    def __repr__(self) -> str:
        return (
            f"Plan({self.part!r}: {self.kind} {', '.join(self.effects)}; {len(self.logs)} "
            f"log{'s' * (len(self.logs) != 1)})"
        )

    def report(self) -> str:
        """A few lines for a terminal or a notebook."""
        return in_lines(self)

    def write(
        self,
        out: str | os.PathLike,
        say: Callable[[str, float], None] = silent,
    ) -> Path:
        """Write ``plan.html``, ``plan.json`` and the motions as recordings into the folder ``out``.

        Gives the page's path; ``say(text, share)`` hears what is being done, and which share of it
        is. Raises UserError where the folder cannot be written.
        """
        out = Path(out)
        with staged(out) as stage:
            html = page(self, lambda share: say("drawing the page", share / 2))
            write_text(stage / "plan.html", html)
            write_json(stage / "plan.json", self.as_dict())
            for i, (name, log) in enumerate(zip(self.files(), self.logs, strict=True)):
                say(f"writing {name}", (1 + i / len(self.logs)) / 2)
                log.recording.write(stage / name)
        return out / "plan.html"
