"""A run of the attitude filter in a few lines, for a terminal or a notebook."""

from __future__ import annotations

from collections.abc import Iterator

from pyimu.attitude.outcome import Outcome
from pyimu.attitude.report.words import (
    about,
    error_words,
    gravity_used,
    heading_from,
    last_attitude,
    last_bias,
    notes,
    reference_words,
)
from pyimu.report.findings import in_line


def in_lines(a: Outcome) -> str:
    """The report for a terminal."""
    return "\n".join([f"{a.name}: {about(a)}", *_indented(a)])


def _indented(a: Outcome) -> Iterator[str]:
    yield from (f"  note            {text}" for text in notes(a))
    yield f"  last attitude   {last_attitude(a)}"
    yield f"  last gyro bias  {last_bias(a)}"
    yield f"  quasi-static    {gravity_used(a)}"
    if a.magnetometer.used:
        yield f"  heading         {heading_from(a)}"
    if a.error is not None:
        yield f"  error           {error_words(a)}"
        if other := reference_words(a):
            yield f"  reference       {other}"
    for event in a.events:
        name = f"status {event.bit}"
        yield (
            f"  {name:14s}  {event.samples} samples, {event.first:.2f} to {event.last:.2f} s: "
            f"{event.text}"
        )
    yield from (f"  log             {text}" for text in in_line(a.findings))
