"""Vibration that gyro and accelerometer feel together, and lines, above the band of any motion by
hand.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from pyimu.characterization.spectrum.lines import Line, find_lines
from pyimu.characterization.spectrum.psd import SpectrumAccumulator
from pyimu.errors import Finding
from pyimu.identification.fit.trial import Trial
from pyimu.recording.recording import Recording
from pyimu.recording.reference.band import coherence

ABOVE = 10.0
"""Hz; people, wheels and rotors' frames move below it, motors above."""

TOGETHER = 0.5
"""Share of the gyro's power that the accelerometer must explain at a frequency: by chance three
inputs explain a tenth in the fewest frames that are taken, and half of it never."""

WINDOW = 1024
"""Rows of a spectrum in which lines are looked for."""

STRETCH = 256
"""Rows over which a line keeps its phase by the frequency that is known of it; a sine takes a
hundredth of the noise of as many away."""

FALSE_ALARM = 1e-6
"""Probability of a line in the noise of a log."""

STANDS_OUT = 30.0
"""Times the density beneath that a line must have to be told: what a body makes that turns and
knocks has less, and what wanders is none."""


def lines(recording: Recording) -> Iterator[Finding]:
    """A finding for each column in which a sharp line stands out of all else, with the frequency
    [Hz] and the root mean square of the strongest; its ``count`` is that of the lines.

    A reference that was differentiated does not reach there.
    """
    groups = [g for g in ("gyro", "accel") if getattr(recording, g) is not None]
    if not groups:
        return
    values = np.hstack([getattr(recording, g) for g in groups])
    found = _lines(values, recording.segments, recording.sample_period)
    names = [f"{g}_{axis}" for g in groups for axis in "xyz"]
    for column, of_it in found.items():
        strongest = max(of_it, key=lambda one: one.amplitude)
        said = {"frequency": strongest.frequency, "rms": strongest.rms}
        yield Finding("line", names[column], len(of_it), said)


def less_lines(trial: Trial) -> Trial:
    """The trial with samples less their sharp lines, which are not white: of each stretch of
    ``STRETCH`` rows the sine of a line's frequency that fits it best.
    """
    found = _lines(trial.y, trial.segments, trial.h)
    if not found:
        return trial
    y = np.array(trial.y)
    for axis, of_it in found.items():
        turn = 2.0 * np.pi * trial.h * np.array([one.frequency for one in of_it])
        for a, b in trial.segments:
            for piece in np.array_split(y[a:b, axis], max(1, (b - a) // STRETCH)):
                piece -= _sines_in(piece, turn)
    return replace(trial, y=y)


def _sines_in(piece: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """The sines in a piece (n,) that turn by ``turn`` (k,) rad a row.

    Under a Hann window, as the motion beside them would lean on them else.
    """
    angle = np.outer(np.arange(len(piece)), turn)
    sines = np.hstack([np.cos(angle), np.sin(angle)])
    weight = np.hanning(len(piece) + 2)[1:-1]
    beside = np.column_stack([sines, np.ones(len(piece))]) * weight[:, None]
    return sines @ np.linalg.lstsq(beside, piece * weight)[0][: sines.shape[1]]


def _lines(
    values: np.ndarray, segments: Sequence[tuple[int, int]], h: float
) -> dict[int, list[Line]]:
    """The sharp lines of values (n, k) that stand out of all else, by column."""
    spectrum = SpectrumAccumulator(h, WINDOW)
    for a, b in segments:
        spectrum.add(values[a:b])
        spectrum.end_segment()
    found: dict[int, list[Line]] = {}
    for line in find_lines(spectrum, FALSE_ALARM):
        if line.frequency > ABOVE and line.ratio > STANDS_OUT and not line.width:
            found.setdefault(line.column, []).append(line)
    return found


def vibrations(recording: Recording) -> Iterator[Finding]:
    """A finding with the frequencies [Hz] between which the gyro feels what the accelerometer
    feels; its ``count`` is that of the frequencies.

    No reference shows it, nor does an effect of the sensor: it is motion.
    """
    if recording.gyro is None or recording.accel is None:
        return
    frequency, share = coherence(recording.time, recording.gyro, recording.accel)
    if share is None:
        return
    felt = frequency[(frequency >= ABOVE) & (share > TOGETHER)]
    if len(felt):
        rates = {"least_frequency": float(felt.min()), "largest_frequency": float(felt.max())}
        yield Finding("vibration", "gyro", len(felt), rates)


def shaken_together(findings: Iterable[Finding]) -> str:
    """Which vibration the gyro and the accelerometer of a log feel together, and what it does to
    effects that join the two; nothing where they feel none.
    """
    felt = next((f for f in findings if f.kind == "vibration"), None)
    if felt is None:
        return ""
    low, high = felt.detail["least_frequency"], felt.detail["largest_frequency"]
    return (
        f"gyro and accelerometer shake together at {low:.0f} to {high:.0f} Hz, which is motion "
        "that no reference shows, and looks like such an effect"
    )
