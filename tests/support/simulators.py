"""One body for every simulator: a system in an SSP file, so many steps, the outputs that it shows.

Each gives the rows (steps + 1,) of real outputs by their names in the system (``Filter.roll``):
row 0 before the first step, NaN where the simulator does not show it, row k after step k.
"""

import importlib
import zipfile
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

INSTALL = "pip install 'pyimu[simulators]'"


def installed(name: str) -> ModuleType:
    """A simulator's package; skips the test where it or a library of the system is missing."""
    try:
        return importlib.import_module(name)
    except ImportError:
        pytest.skip(f"needs the package {name.partition('.')[0]}: {INSTALL}")
    except OSError as error:
        pytest.skip(f"{name} needs a library, Debian's libtbb12 for ecospy: {error}")


def in_fmpy(ssp: Path, steps: int, step: float, names: Sequence[str]) -> dict[str, np.ndarray]:
    """fmpy's own reader of SSP, which takes units of FMI 2 and shows nothing before a step."""
    from fmpy.ssp.simulation import simulate_ssp
    from fmpy.ssp.ssd import read_ssv

    found = simulate_ssp(
        str(ssp),
        stop_time=(steps - 0.5) * step,
        step_size=step,
        parameter_set=read_ssv(str(ssp), resource="resources/parameters.ssv"),
    )
    assert len(found) == steps
    return {name: np.concatenate([[np.nan], found[name]]) for name in names}


def in_ecos(ssp: Path, steps: int, step: float, names: Sequence[str]) -> dict[str, np.ndarray]:
    ecos = installed("ecospy")
    rows = {name: np.empty(steps + 1) for name in names}
    installed("ecospy.lib").EcosLib.set_log_level("warn")
    with ecos.EcosSimulation(step_size=step, ssp_path=str(ssp)) as run:
        assert run.init(parameter_set="parameters")
        for k in range(steps + 1):
            if k:
                run.step()
            for name, values in rows.items():
                values[k] = run.get_real(name.replace(".", "::", 1))
        run.terminate()
    return rows


def in_libcosim(ssp: Path, steps: int, step: float, names: Sequence[str]) -> dict[str, np.ndarray]:
    """It reads an unpacked SSP with units of FMI 2, and shows nothing before the first step."""
    installed("libcosimpy")
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.FATAL)
    folder = ssp.with_suffix(".unpacked")
    with zipfile.ZipFile(ssp) as archive:
        archive.extractall(folder)
    run = CosimExecution.from_ssp_file(str(folder), round(step * 1e9))
    observer = CosimObserver.create_last_value()
    run.add_observer(observer)
    places = {
        f"{unit.name.decode()}.{v.name.decode()}": (unit.index, v.reference)
        for unit in run.slave_infos()
        for v in run.slave_variables(unit.index)
    }
    rows = {name: np.full(steps + 1, np.nan) for name in names}
    for k in range(1, steps + 1):
        assert run.step(), f"step {k} fails"
        for name, values in rows.items():
            unit, reference = places[name]
            (values[k],) = observer.last_real_values(unit, [reference])
    return rows
