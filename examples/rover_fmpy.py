"""A rover turns on the spot and back, and a filter estimates its attitude: four units, wired.

``python examples/rover_fmpy.py`` makes the whole drive, 388 s, in about half a minute; a number
behind it is how many seconds to make instead. The units are those of ``pyimu build``.
"""

import sys
import tempfile
from math import degrees, radians, remainder, tau

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

import pyimu

H = pyimu.part("imt30").sample_period  # s, also the step of the simulation


class Unit:
    """An FMU; values by name, of a vector all at once."""

    def __init__(self, path, **parameters):
        about = read_model_description(path)
        model, self.references = about.coSimulation.modelIdentifier, {}
        for v in about.modelVariables:
            self.references.setdefault(v.name.partition("[")[0], []).append(v.valueReference)
        given = {"modelIdentifier": model, "guid": about.guid, "unzipDirectory": extract(path)}
        self.fmu = FMU2Slave(model, **given)
        self.fmu.instantiate()
        self.fmu.setupExperiment()
        for name, value in parameters.items():
            put = self.fmu.setInteger if isinstance(value, int) else self.fmu.setReal
            put(self.references[name], [value])
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def __getitem__(self, name):
        return self.fmu.getReal(self.references[name])

    def step(self, k, **inputs):
        for name, values in inputs.items():
            self.fmu.setReal(self.references[name], values)
        self.fmu.doStep(k * H, H)


paths = pyimu.build("imt30", tempfile.mkdtemp(), ["rover", "sensor", "low-pass", "ukf"], [2])
drive, sensor = Unit(paths[0], drive=4, start_time=60.0), Unit(paths[1], seed=1)
low_pass, ukf = Unit(paths[2], cutoff=10.0), Unit(paths[3], latitude=radians(52.22))
print("time s    heading deg    error of heading, pitch, roll in deg")
for k in range(steps := round(float((*sys.argv, 388)[1]) / H)):
    drive.step(k)
    sensor.step(k, **{name: drive[name] for name in ("rate", "specific_force", "temperature")})
    low_pass.step(k, gyro=sensor["gyro"], accel=sensor["accel"])
    clean = {"gyro": low_pass["filtered_gyro"], "accel": low_pass["filtered_accel"]}
    ukf.step(k, temperature=sensor["measured_temperature"], **clean)
    if (k + 1) % round(30 / H) == 0 or k + 1 == steps:
        errors = [remainder(ukf[n][0] - drive[n][0], tau) for n in ("yaw", "pitch", "roll")]
        heading, off = degrees(drive["yaw"][0]), "  ".join(f"{degrees(e):+.3f}" for e in errors)
        print(f"{(k + 1) * H:6.1f}    {heading:11.2f}    {off}")
