"""The unit ``StrapdownIns``: the bits of Python in every form, and what it can be told."""

from dataclasses import replace

import numpy as np
import pytest
from built import built
from navigation_cases import SHORT, calibrated, declared, noisy, perfect, white

from pyimu.fmu import FORMS, build_fmus, simulate, simulate_blocks
from pyimu.ins import run, strapdown_ins
from pyimu.ins.filter.layout import Layout
from pyimu.ins.filter.variables import INPUTS


@pytest.fixture(scope="module")
def unit():
    return strapdown_ins(white(calibrated()), nhc=False)


@pytest.fixture(scope="module")
def fmus(unit, tmp_path_factory):
    return built(unit, tmp_path_factory)


@pytest.fixture(scope="module")
def log():
    """Two stops, 18 s."""
    return noisy(declared(perfect(SHORT, 100.0), SHORT), white(calibrated()), 1).slice(0, 1800)


def rows(recording):
    """The recording as the unit's inputs, as a user would write them."""
    u = np.tile([v.start for v in INPUTS], (len(recording.time), 1))
    u[:, :3], u[:, 3:6], u[:, 7] = recording.gyro, recording.accel, recording.stationary
    return u


@pytest.mark.parametrize("zupt", ("declared", "live"))
@pytest.mark.parametrize("form", FORMS)
def test_the_unit_gives_the_bits_of_a_run(fmus, unit, log, form, zupt):
    """Told of the rests, and where it finds them by itself."""
    found = run(log, white(calibrated()), method="filter", zupt=zupt)
    given = {"start_values": dict(found.settings), "sample_period": log.sample_period}
    u = rows(log)
    u[:, 7] *= zupt == "declared"
    y = (
        simulate_blocks(fmus[form], u, block_size=500, **given)
        if form == "block"
        else simulate(fmus[form], u, **given)
    )
    assert found.still.any()
    np.testing.assert_array_equal(y[1:], found.filter.y)


def test_the_unit_knows_of_wheels_what_a_run_does(log, tmp_path):
    """Their scale, delay and arm, and how the vehicle crabs: as it is built, in C and in Python."""
    unit, driven = strapdown_ins(white(calibrated())), log.time > 5.0
    seen = (np.arange(len(log)) % 10 == 0) & driven
    speed = np.where(seen, 1.02 * np.linalg.norm(log.ref_velocity, axis=1), np.nan)
    log = replace(log, stationary=None, speed=speed, speed_std=np.full(len(log), 0.01))
    found = run(log, white(calibrated()), method="filter", zupt="live", nhc=True)
    u, at = (
        rows(replace(log, stationary=np.zeros(len(log)))),
        {v.name: i for i, v in enumerate(INPUTS)},
    )
    u[:, at["speed_valid"]], u[seen, at["speed"]] = seen, speed[seen]
    u[:, at["speed_variance"]] = 0.01**2
    given = {"start_values": dict(found.settings), "sample_period": log.sample_period}
    assert given["start_values"]["speed_late_std"] > 0
    (fmu,) = build_fmus(unit, tmp_path, (2,))
    y = simulate(fmu, u, **given)
    np.testing.assert_array_equal(y[1:], found.filter.y)
    assert found.filter.scalar("speed_nis").any() and found.filter.scalar("nhc_nis").any()


def test_a_measured_position_and_speed_pull_the_estimate(unit, log):
    names = [v.name for v in unit.outputs]
    u, at = rows(log), {v.name: i for i, v in enumerate(unit.inputs)}
    east = names.index("position[1]")
    for name, value in (
        ("position_valid", 1.0),
        ("position_measured[1]", 2.2),
        ("position_variance", 1e-6),
    ):
        u[-1, at[name]] = value
    free, held = (unit.run(x)[0][-1, east] for x in (rows(log), u))
    assert abs(free - 2.2) > 0.1
    assert held == pytest.approx(2.2, abs=1e-4)
    u = rows(log)[:800]
    u[-1, at["velocity_valid"]], u[-1, at["velocity_variance"]] = 1.0, 1e-10
    u[-1, at["velocity_measured[1]"] :][:3] = [0.25, 0.05, np.nan]
    north = names.index("velocity[2]")
    y = unit.run(u)[0][-1]
    assert y[[north - 1, north]] == pytest.approx([0.25, 0.05], abs=1e-4)
    assert y[names.index("velocity_std[3]")] > 1e-4
    u = rows(log)
    moving = (log.time > 5.8) & (log.time < 11.0)
    u[moving, at["speed_valid"]] = 1.0
    u[moving, at["speed"]] = 0.3
    u[moving, at["speed_variance"]] = 1e-4
    row = int(np.searchsorted(log.time, 11.0))
    std = names.index("position_std[1]")
    assert unit.run(u)[0][row, std] < 0.3 * unit.run(rows(log))[0][row, std]


def test_a_variance_below_zero_is_said(unit, log):
    """The state holds the upper triangle of the covariance, row by row, behind the nominal one."""
    layout = Layout(white(calibrated()), nhc=False, detects=True)
    n, names = layout.errors, [v.name for v in unit.outputs]
    east = layout.nominal + sum(n - i for i in range(6))
    status, std = names.index("status"), names.index("position_std[1]")
    p = [v.start for v in unit.parameters]
    u = rows(log)
    s, _ = unit.initial(u[0], p)
    for row in u[:3]:
        s, y = unit.step(s, row, p, 0, log.sample_period)
    assert not int(y[status]) & 128 and y[std] > 0.0
    s[east] = -1.0
    _, y = unit.step(s, u[3], p, 0, log.sample_period)
    assert int(y[status]) & 128 and y[std] == 0.0
