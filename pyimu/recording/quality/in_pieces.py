"""The quality of a log that is read in pieces.

``pyimu.recording.quality.inspect`` on windows of the log, added up.
"""

from __future__ import annotations

from dataclasses import replace

from pyimu.errors import Finding
from pyimu.recording.quality.inspect import inspect, of_reading
from pyimu.recording.quality.tally import Tally
from pyimu.recording.recording import Recording, copied, join

WINDOW_ROWS = 1 << 18
"""Samples of a window. Rare things need many samples to stand out from; a window takes some tens of
MB and a third of a second."""

OF_MOST = (
    "gravity_down",
    "force_in_g",
    "force_unit",
    "gyro_at_rest",
    "gyro_noisy",
    "temperature_unit",
)
"""Kinds that concern the log as a whole."""


def quality(recording: Recording) -> tuple[Finding, ...]:
    """What reading a recording found, and what its samples show, of any length of it."""
    inspector, cadence = Inspector(), recording.cadence
    whole = len(recording) < 1.5 * WINDOW_ROWS
    inspector.add(
        recording if whole else replace(recording, period=cadence.period, longest=cadence.longest)
    )
    return (*of_reading(recording), *inspector.findings())


class Inspector:
    """Inspects the pieces of a log, given in order; the result does not depend on the pieces.

    The kinds are those of ``pyimu.recording.quality.inspect.inspect``, found in windows of 2^18
    samples (the last one of half to one and a half of it), so that a log of one window gives
    exactly what ``inspect`` does; counts are added up, and a row is one of the log. What concerns a
    whole column is judged over the windows: ``constant_channel`` where it is in all of them (else
    these are stuck samples), those of ``OF_MOST`` in most.
    """

    def __init__(self) -> None:
        self._held: list[Recording] = []
        self._waiting = 0
        self._rows = 0
        self._windows = 0
        self._found: dict[tuple[str, str], list[tuple[int, Finding]]] = {}

    def add(self, piece: Recording) -> None:
        """The ``piece`` that follows what was added before."""
        self._held.append(piece)
        self._waiting += len(piece)
        if self._waiting < 1.5 * WINDOW_ROWS:
            return
        whole = join(self._held)
        while len(whole) >= 1.5 * WINDOW_ROWS:
            self._inspect(whole.slice(0, WINDOW_ROWS))
            whole = whole.slice(WINDOW_ROWS)
        self._held, self._waiting = [copied(whole)], len(whole)

    def findings(self) -> tuple[Finding, ...]:
        """What was found in all that was added; nothing can be added after."""
        if self._waiting:
            self._inspect(join(self._held))
            self._held, self._waiting = [], 0
        tally = Tally()
        for (kind, _), found in self._found.items():
            if kind == "constant_channel":
                tally.add(self._constant(found))
            elif kind not in OF_MOST:
                tally.add(_moved(finding, start) for start, finding in found)
            elif 2 * len(found) > self._windows:
                tally.add([found[0][1]])
        return tally.findings()

    def _inspect(self, window: Recording) -> None:
        for finding in inspect(window):
            self._found.setdefault((finding.kind, finding.column), []).append((self._rows, finding))
        self._rows += len(window)
        self._windows += 1

    def _constant(self, found: list[tuple[int, Finding]]) -> list[Finding]:
        """One finding for a channel that is always constant, else each window's stuck samples."""
        values = {finding.detail["value"] for _, finding in found}
        if len(found) == self._windows and len(values) == 1:
            return [replace(found[0][1], count=sum(finding.count for _, finding in found))]
        return [
            Finding(
                "stuck_samples",
                f.column,
                f.count,
                {"runs": 1, "longest": f.count, "first_row": start},
            )
            for start, f in found
        ]


def _moved(finding: Finding, rows: int) -> Finding:
    """The finding of a window that begins at row ``rows`` of the log."""
    if "first_row" not in finding.detail:
        return finding
    return replace(
        finding, detail={**finding.detail, "first_row": finding.detail["first_row"] + rows}
    )
