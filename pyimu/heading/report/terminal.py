"""The heading by several methods as lines for a terminal."""

from __future__ import annotations

from pyimu.heading.outcome import Outcome
from pyimu.heading.report.words import (
    CALIBRATION_HEAD,
    HEAD,
    PAIRED_HEAD,
    about,
    calibration_rows,
    error_rows,
    paired_rows,
    remarks,
    transfer_words,
)
from pyimu.report.lines import in_columns


def in_lines(found: Outcome) -> str:
    """The report for a terminal."""
    lines = [about(found), *(f"  note: {text}" for text in remarks(found)), ""]
    lines += in_columns([HEAD, *error_rows(found)])
    for head, rows in (
        (PAIRED_HEAD, paired_rows(found)),
        (CALIBRATION_HEAD, calibration_rows(found)),
    ):
        lines += ["", *in_columns([head, *rows])] if rows else []
    if found.transfer is not None:
        lines += ["", f"rate transfer: {transfer_words(found.transfer)}"]
    return "\n".join(lines)
