"""MEMS inertial sensors, from a measured log to a system simulator and back.

Conventions, everywhere in the package:

* SI and radians; degrees, hours, g only where a file is read or a person is shown something.  Temperature is in degC.
* World frame east-north-up, body frame forward-left-up (REP 103).  Quaternions are Hamilton, scalar first, body to world:
  ``q_nb`` = Rz(yaw) Ry(pitch) Rx(roll).  Yaw and heading run counter-clockwise from east; nose up is negative pitch.
* ``f_b`` is a vector in body axes, ``R_nb`` a matrix from body to world.  A gyro measures rate against inertial space, an
  accelerometer specific force: +g on z at rest.
* White noise is given by the root of its two-sided density, N in rad/sqrt(s).  A function that returns a density says
  one-sided or two-sided.
* Arrays are (n, 3), a sample a row, time first.

The names below are the package for most uses; ``help(pyimu.close)`` is where to start.
"""

from importlib import import_module

__version__ = "0.1.0"

_HOME = {
    "Effect": "effect", "Environment": "effect", "Noise": "effect", "Parameter": "effect", "SamplePeriod": "effect",
    "Sensor": "sensor", "State": "effect",
    "Part": "imu", "simulate": "simulation",
    "Recording": "recording", "read_recording": "recording", "open_log": "recording",
    "part": "partfile", "part_names": "partfile", "load_part": "partfile", "save_part": "partfile",
    "close": "loop.close", "write_report": "loop.report",
    "write_characterization": "characterize.report",
    "build": "fmu.package", "UserError": "errors",
}
_MODULES = ("attitude", "characterize", "effect", "fmu", "symbolic", "shaping")

__all__ = [*_HOME, *_MODULES, "__version__"]  # noqa: PLE0604  (names from the tables above)


def __getattr__(name: str):
    """Load what is asked for only then: casadi, scipy and pandas together take seconds."""
    if name in _HOME:
        value = getattr(import_module(f"pyimu.{_HOME[name]}"), name)
    elif name in _MODULES:
        value = import_module(f"pyimu.{name}")
    else:
        raise AttributeError(f"module 'pyimu' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
