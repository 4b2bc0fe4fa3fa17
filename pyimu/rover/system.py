"""The rover as a system of units: RoverDrive -> ImuSensor -> LowPass -> AttitudeUkf.

A true motion moves the sensor; what it measures goes through a low-pass of 10 Hz into the attitude
filter, as on the rover of Hidalgo 2012, section 6.1. The temperature of the sensor goes to the
filter beside the low-pass.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pyimu.block.parameters import with_values
from pyimu.block.variables import Variable
from pyimu.errors import UserError
from pyimu.files import check_folder
from pyimu.files.held import work_folder
from pyimu.fmu.build import build_fmu
from pyimu.fmu.package import BLOCKS
from pyimu.fmu.sources import Form
from pyimu.fmu.ssp import whole_nanoseconds, write_ssp
from pyimu.fmu.system import Component, System
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.plant.rover_drive import end_of_drive
from pyimu.plant.rover_variables import DRIVES
from pyimu.rover.drives import REST
from pyimu.units import did_you_mean

FREE_TIME = 60.0
"""s of a free drive, which has no end of its own."""

UNITS = {"Drive": "rover", "Sensor": "sensor", "LowPass": "low-pass", "Filter": "ukf"}
"""Names of the units in the system, and of their blocks."""

MOTION = {"attitude": "q"}
"""What a sensor's inputs are called among the outputs of the drive, where they differ."""


def rover_system(
    part: Part | str | Path,
    folder: Path | str,
    drive: str = "turn_on_spot",
    *,
    seed: int = 1,
    form: Form = 2,
    platform: str = "host",
    specimen: int | None = None,
    parameters: Mapping[str, Mapping[str, float]] | None = None,
) -> System:
    """Build the four units of ``part`` into ``folder``, and wire them: a system of one ``drive``.

    The units are Drive, Sensor, LowPass and Filter. Their sample period and the step of the system
    are the part's sample period in whole nanoseconds. ``specimen`` is the seed of a specimen of the
    part, whose coefficients are then parameters of the sensor; the filter knows the part alone.
    ``parameters`` are further ones by the name of the unit, ``{"Drive": {"terrain": 3}}``.

    Raises UserError for a drive, a part, a parameter or a form that is none, and where a unit
    cannot be built.
    """
    check_drive(drive, form)
    found = find_part(part)
    h = whole_nanoseconds(found.sample_period)
    blocks = {name: BLOCKS[unit](found) for name, unit in UNITS.items()}
    rover, sensor = blocks["Drive"], blocks["Sensor"]
    bound: dict[str, dict[str, float]] = {name: {"sample_period": h} for name in blocks}
    bound["Drive"]["drive"] = DRIVES[drive]
    bound["Sensor"] |= {"seed": seed} if sensor.noise else {}
    if specimen is not None:
        bound["Sensor"] |= deviations(found, specimen)
    for name, more in (parameters or {}).items():
        if name not in bound:
            raise UserError(f"the rover's system has no unit {name}{did_you_mean(name, bound)}")
        bound[name] |= more
    own = {name: x for name, x in bound["Drive"].items() if name != "sample_period"}
    p = with_values(rover, own)
    place = dict(zip((v.name for v in rover.parameters), p.tolist(), strict=True))
    bound["Filter"] = {n: place[n] for n in ("latitude", "gravity")} | bound["Filter"]
    return System(
        "Rover",
        tuple(
            Component(name, build_fmu(block, folder, form, platform), bound[name])
            for name, block in blocks.items()
        ),
        connections(rover.outputs, sensor.inputs),
        h,
        float(round(end_of_drive(rover, p) + REST)) if drive != "free" else FREE_TIME,
    )


def deviations(part: Part, seed: int) -> dict[str, float]:
    """The coefficients of a specimen that differ from those of the part's unit.

    Raises UserError for a part without tolerances.
    """
    nominal = part.nominal.start_values
    drawn = part.specimen(seed).start_values
    return {name: value for name, value in drawn.items() if value != nominal[name]}


def check_drive(drive: str, form: Form) -> None:
    """Raise UserError for a drive that is unknown, and a form that cannot be wired."""
    if drive not in DRIVES:
        raise UserError(
            f"drive '{drive}': unknown{did_you_mean(drive, DRIVES)}; known are {', '.join(DRIVES)}"
        )
    if form not in (2, 3):
        raise UserError(f"a system is wired of units of FMI 2 or 3, not of form {form}")


def connections(
    motion: tuple[Variable, ...], sensed: tuple[Variable, ...]
) -> tuple[tuple[str, str], ...]:
    """How the units are wired: of the ``motion`` whatever the sensor senses."""
    shown = {v.name.partition("[")[0] for v in motion}
    wanted = dict.fromkeys(v.name.partition("[")[0] for v in sensed)
    return (
        *(
            (f"Drive.{MOTION.get(n, n)}", f"Sensor.{n}")
            for n in wanted
            if MOTION.get(n, n) in shown
        ),
        ("Sensor.gyro", "LowPass.gyro"),
        ("Sensor.accel", "LowPass.accel"),
        ("LowPass.filtered_gyro", "Filter.gyro"),
        ("LowPass.filtered_accel", "Filter.accel"),
        ("Sensor.measured_temperature", "Filter.temperature"),
    )


def write_rover(
    part: Part | str | Path,
    out: Path | str,
    drive: str = "turn_on_spot",
    *,
    seed: int = 1,
    form: Form = 2,
    platform: str = "host",
    specimen: int | None = None,
) -> Path:
    """Write the system with its units to ``out`` as ``Rover.ssp``; see ``rover_system``."""
    check_folder(out)
    with work_folder() as folder:
        system = rover_system(
            part, folder, drive, seed=seed, form=form, platform=platform, specimen=specimen
        )
        return write_ssp(system, Path(out) / "Rover.ssp")
