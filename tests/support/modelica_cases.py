"""Compiling and simulating classes of the Modelica library with rumoca."""

import atexit
import shutil
import tempfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from places import CHECKOUT

LIBRARY = CHECKOUT / "modelica"
NAMES = CHECKOUT / "tests" / "support" / "modelica_names"
"""The few names of the Modelica Standard Library that the library uses."""

LAST_PLACES = 4
"""Units in the last place by which two libraries' exp, log, sin and cos may make values differ."""


@cache
def compiler():
    """rumoca, and its session with the library loaded."""
    rumoca = pytest.importorskip("rumoca", reason="rumoca has no wheel for this Python")
    # One root for both: of several it reads only those that a model names itself.
    root = Path(tempfile.mkdtemp(prefix="pyimu-modelica-"))
    atexit.register(shutil.rmtree, root, ignore_errors=True)
    for folder in (NAMES / "Modelica", LIBRARY / "PyImu"):
        shutil.copytree(folder, root / folder.name)
    return rumoca, rumoca.Session(roots=[str(root)])


def simulated(model, stop, period, text=None, tolerance=1e-6):
    """Rows 0 to stop / period of every variable: name to array; a row is what holds after its
    sample.

    ``text`` is the source of ``model`` where it is not in the library, ``tolerance`` that of
    integration.
    """
    rumoca, session = compiler()
    if text is None:
        model, text = "Test", f"model Test extends {model}; end Test;"
    compiled = session.loads(text, model=model, filename="test.mo")
    settings = rumoca.SimConfig(solver="rk-like", rtol=tolerance, atol=tolerance)
    result = compiled.simulate(t=stop, dt=period, config=settings)
    at = (np.arange(round(stop / period) + 1) + 1e-6) * period
    rows = np.searchsorted(np.array(result.time), at, side="right") - 1
    return {name: np.array(result[name])[rows] for name in result.names}


def vector(rows, name, size=3):
    """The columns of an array (n, size)."""
    return np.column_stack([rows[f"{name}[{i + 1}]"] for i in range(size)])


def measured(rows, block="imu"):
    """The columns (n, 7) of a measurement unit, in the order of its co-simulation unit's."""
    gyro, accel = vector(rows, f"{block}.gyro"), vector(rows, f"{block}.accel")
    return np.column_stack([gyro, accel, rows[f"{block}.measuredTemperature"]])


def ulps(a, b, *summands):
    """The largest distance of two arrays in units in the last place.

    The unit is that of the larger number, or of a summand of which both were made, whose rounding
    they have.
    """
    a, b = np.asarray(a), np.asarray(b)
    largest = np.max(np.abs(np.stack(np.broadcast_arrays(a, b, *summands))), axis=0)
    return float(np.max(np.abs(a - b) / np.spacing(largest), initial=0.0))
