"""A table without times: what is asked for, and that the rate in the map is enough."""

import numpy as np
import pytest

from pyimu import read_recording
from pyimu.errors import UserError
from pyimu.inspection.run import inspect

H, N = 0.01, 1500


@pytest.fixture
def table(tmp_path):
    """Rates in rad/s and gravity in m/s^2 without a time and without units."""
    rng, path = np.random.default_rng(3), tmp_path / "log.csv"
    values = rng.normal(0, 0.02, (N, 6)) + [0, 0, 0, 0, 0, 9.81]
    np.savetxt(path, values, delimiter=",", header="gx,gy,gz,ax,ay,az", comments="")
    return path


def test_the_rate_is_asked_for_and_why_the_gyro_s_unit_is_not_known(table):
    said = inspect([table]).report()
    assert "no column is a time: say the sample rate in the map" in said
    assert (
        "there is no time of a known unit beside it to tell" in said and "does not turn" not in said
    )


def test_with_the_rate_and_a_unit_in_the_map_it_is_read(table, tmp_path):
    written = inspect([table]).column_map
    lines = written.replace("# sample_rate", "sample_rate").splitlines()
    lines = [w[2:] if w.startswith('# "g') and "[rad/s]" in w else w for w in lines]
    (tmp_path / "map.toml").write_text("\n".join(lines))
    found = read_recording(table, tmp_path / "map.toml")
    assert len(found) == N and found.sample_period == pytest.approx(H)


def test_a_log_with_times_is_not_asked(table):
    text = table.read_text().splitlines()
    rows = [f"{k * H:.2f},{row}" for k, row in enumerate(text[1:])]
    table.write_text("\n".join([f"time,{text[0]}", *rows]))
    assert "no column is a time" not in inspect([table]).report()


def test_the_rate_in_a_map_tells_the_gyro_s_unit(tmp_path):
    """A map that has nothing but the rate; the axes that it declares are kept, too."""
    t = H * np.arange(N)
    angle, rate, zero = np.sin(0.8 * t), 0.8 * np.cos(0.8 * t), 0 * t
    force = 9.81 * np.array([-np.sin(angle), zero, np.cos(angle)])
    values = np.column_stack([zero, np.degrees(rate), zero, *force])
    path, given = tmp_path / "log.csv", tmp_path / "rate.toml"
    np.savetxt(path, values, delimiter=",", header="gx,gy,gz,ax,ay,az", comments="")
    given.write_text('sample_rate = {value = 100, unit = "Hz"}\n[frame]\nbody = "frd"\n')
    found = inspect(path, given)
    assert found.proposals[0].units == {"gyro": "deg/s", "accel": "m/s^2"}
    np.testing.assert_allclose(found.recording.gyro[:, 1], -rate, atol=1e-12)
    assert 'sample_rate = {value = 100, unit = "Hz"}' in found.column_map
    assert not found.readable


def test_inspect_does_not_advise_itself(tmp_path):
    rows = "".join(f"{k * H:.2f},1,2,{k}\n" for k in range(100))
    (tmp_path / "log.csv").write_text(f"time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z\n{rows}")
    with pytest.raises(UserError, match="pyimu inspect .* looks which one the numbers fit"):
        read_recording(tmp_path / "log.csv")
    said = inspect(tmp_path / "log.csv")
    assert "gyro_z has no unit" in said.problem and "looks which" not in said.report()
    assert said.proposals[0].open_questions == ["gyro"]  # to be chosen in the map that it writes
