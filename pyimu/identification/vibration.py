"""Vibration that gyro and accelerometer feel together, above the band of any motion by hand."""

from __future__ import annotations

from collections.abc import Iterator

from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.recording.reference.band import coherence

ABOVE = 10.0
"""Hz; people, wheels and rotors' frames move below it, motors above."""

TOGETHER = 0.5
"""Share of the gyro's power that the accelerometer must explain at a frequency: by chance three
inputs explain a tenth in the fewest frames that are taken, and half of it never."""


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
