"""Vibration that gyro and accelerometer feel together, and lines, above the band of any motion by
hand.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from pyimu.characterization.spectrum.lines import Line, find_lines
from pyimu.characterization.spectrum.psd import SpectrumAccumulator
from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.recording.reference.band import coherence

ABOVE = 10.0
"""Hz; people, wheels and rotors' frames move below it, motors above."""

TOGETHER = 0.5
"""Share of the gyro's power that the accelerometer must explain at a frequency: by chance three
inputs explain a tenth in the fewest frames that are taken, and half of it never."""


WINDOW = 1024
"""Rows of a spectrum in which lines are looked for."""

FALSE_ALARM = 1e-6
"""Probability of a line in the noise of a log."""

STANDS_OUT = 30.0
"""Times the density beneath that a line must have to be told: what a body makes that turns and
knocks has less, and what wanders is none."""


def lines(recording: Recording) -> Iterator[Finding]:
    """A finding for each column in which a sharp line stands out of all else, with the frequency
    [Hz] and the root mean square of the strongest; its ``count`` is that of the lines.

    A reference that was differentiated does not reach there, and for it a line is noise.
    """
    groups = [g for g in ("gyro", "accel") if getattr(recording, g) is not None]
    if not groups:
        return
    spectrum = SpectrumAccumulator(recording.sample_period, WINDOW)
    values = np.hstack([getattr(recording, g) for g in groups])
    for a, b in recording.segments:
        spectrum.add(values[a:b])
        spectrum.end_segment()
    found = defaultdict(list)
    for line in find_lines(spectrum, FALSE_ALARM):
        if line.frequency > ABOVE and line.ratio > STANDS_OUT and not line.width:
            found[line.column].append(line)
    names = [f"{g}_{axis}" for g in groups for axis in "xyz"]
    for column, of_it in found.items():
        strongest: Line = max(of_it, key=lambda one: one.amplitude)
        said = {"frequency": strongest.frequency, "rms": strongest.rms}
        yield Finding("line", names[column], len(of_it), said)


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
