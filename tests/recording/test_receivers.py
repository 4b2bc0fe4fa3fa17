"""Latitude and longitude as receivers of satellites write them: metres, and how inspect finds them.

Places come from the ellipsoid's own equations, in Cartesian axes of the Earth.
"""

import re

import numpy as np
import pytest

from pyimu.errors import UserError
from pyimu.inspection.run import inspect
from pyimu.recording.fixes import north_east
from pyimu.recording.log import open_log, read_recording, read_reference
from pyimu.symbolic.earth import ECCENTRICITY_SQUARED, EQUATORIAL_RADIUS

HOME = np.radians(48.1), np.radians(11.5)
TIME = np.arange(400) * 0.2
EAST, NORTH = 300 * np.sin(0.05 * TIME), 4.0 * TIME


def cartesian(latitude, longitude):
    """m (..., 3) in axes fixed to the Earth, of places on the ellipsoid x^2 + y^2 + z^2 / (1 - e^2)
    = a^2, at which the normal has this latitude.
    """
    normal = np.stack(
        [np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)]
        + [np.sin(latitude)],
        axis=-1,
    )
    squashed = normal * np.array([1.0, 1.0, 1 - ECCENTRICITY_SQUARED])
    return EQUATORIAL_RADIUS * squashed / np.sqrt(np.sum(squashed * normal, axis=-1))[..., None]


def fixes():
    """Latitude and longitude (n,) rad that are EAST and NORTH of HOME, by Newton's steps."""
    latitude, longitude = np.full((2, len(TIME)), HOME[0])
    longitude = np.full(len(TIME), HOME[1])
    for _ in range(12):
        north, east = seen_from_home(latitude, longitude)
        latitude = latitude + (NORTH - north) / EQUATORIAL_RADIUS
        longitude = longitude + (EAST - east) / EQUATORIAL_RADIUS / np.cos(latitude)
    return latitude, longitude


def seen_from_home(latitude, longitude):
    away = cartesian(latitude, longitude) - cartesian(*map(np.asarray, HOME))
    (sin, cos), (sin_l, cos_l) = ((np.sin(v), np.cos(v)) for v in HOME)
    north = away @ [-sin * cos_l, -sin * sin_l, cos]
    return north, away @ [-sin_l, cos_l, 0.0]


def table(path, header, *columns, form="%.12g"):
    lines = (",".join(form % v for v in row) for row in zip(*columns, strict=True))
    path.write_text("\n".join([header, *lines]) + "\n")
    return path


def test_groves_eq_2_112_and_2_150_north_and_east_are_those_of_cartesian_axes():
    """All round the Earth; half a dozen roundings of its radius are 1e-8 m."""
    rng = np.random.default_rng(4)
    latitude, longitude = rng.uniform(-1.5, 1.5, 200), rng.uniform(-3.1, 3.1, 200)
    found = north_east(latitude, longitude, *HOME)
    np.testing.assert_allclose(found, seen_from_home(latitude, longitude), atol=1e-8)


def test_a_map_takes_latitude_and_longitude(tmp_path):
    latitude, longitude = fixes()
    blank = np.zeros((2, 3))
    columns = np.column_stack([blank, np.degrees([latitude, longitude])[:, :-3]])
    log = table(tmp_path / "gnss.csv", "time [s],ref_latitude [deg],ref_longitude [deg]")
    table(log, log.read_text().strip(), TIME, *columns, form="%.15g")
    found = read_reference(log)
    assert np.isnan(found.ref_north[:3]).all()  # no fix yet
    (said,) = (f for f in found.findings if f.kind == "place_origin")
    origin = [said.detail[k] for k in ("latitude", "longitude")]
    np.testing.assert_allclose(origin, HOME, atol=1e-12)
    # Fifteen digits of degrees are 1e-8 m.
    np.testing.assert_allclose(found.ref_north[3:], NORTH[:-3], atol=1e-7)
    np.testing.assert_allclose(found.ref_east[3:], EAST[:-3], atol=1e-7)
    np.testing.assert_allclose(found.latitude[3:], latitude[:-3], rtol=1e-12)


def test_pieces_of_a_log_count_from_one_place(tmp_path):
    rates = np.random.default_rng(1).standard_normal((3, len(TIME)))
    header = "time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]"
    header += ",position_latitude [deg],position_longitude [deg]"
    log = table(tmp_path / "log.csv", header, TIME, *rates, *np.degrees(fixes()), form="%.15g")
    whole = read_recording(log)
    np.testing.assert_allclose(whole.position_north, NORTH, atol=1e-7)
    pieces = [piece.position_east for piece, _ in open_log(log).pieces(64)]
    np.testing.assert_array_equal(np.concatenate(pieces), whole.position_east)


def test_what_are_no_degrees_is_refused(tmp_path):
    names = "time [s],ref_latitude [deg],ref_longitude [deg]"
    log = table(tmp_path / "gnss.csv", names, TIME, 4807.038 + 1e-3 * TIME, 1131.0 + 0 * TIME)
    with pytest.raises(UserError, match="ref_latitude goes to 4807.12 deg, beyond 90.*NMEA"):
        read_reference(log)
    table(log, names.rpartition(",")[0], TIME, 48 + 0 * TIME)
    with pytest.raises(UserError, match="ref_longitude is missing"):
        read_reference(log)


@pytest.mark.parametrize(
    "names", ["lat,lon,alt", "latitude_deg,longitude_deg,altitude (m)", "gps.lat,gps.lng,gps.alt"]
)
def test_inspect_proposes_the_places_of_a_receiver(names, tmp_path):
    latitude, longitude = np.degrees(fixes())
    log = table(tmp_path / "gnss.csv", f"time,{names}", TIME, latitude, longitude, 500 + TIME)
    found = inspect(log)
    assert not found.problem and "time [s]" in found.column_map  # 5 Hz in s, not 5 kHz in ms
    read = read_reference(log, found.write_map(tmp_path / "map.toml"))
    np.testing.assert_allclose(read.ref_north, NORTH, atol=1e-4)
    np.testing.assert_array_equal(read.ref_up, 500 + TIME)


def test_inspect_proposes_whole_numbers_and_velocities_and_asks_for_radians(tmp_path):
    latitude, longitude = fixes()
    counts = np.rint(np.degrees([latitude, longitude]) * 1e7)
    moving = np.gradient([NORTH, EAST, 0 * TIME], 0.2, axis=1)
    header = "timestamp_ms,lat,lon,alt,vel_n_m_s,vel_e_m_s,vel_d_m_s"
    log = table(tmp_path / "g.csv", header, 1000 * TIME, *counts, 450_000 + 0 * TIME, *moving)
    found = inspect(log)
    assert "alt are left out: whole numbers" in found.column_map
    read = read_reference(log, found.write_map(tmp_path / "map.toml"))
    np.testing.assert_allclose(read.ref_east, EAST, atol=0.01)  # half a count is 6 mm
    np.testing.assert_allclose(read.ref_velocity[:, :2], moving[[1, 0]].T, atol=1e-9)
    table(log, "time_s,lat,lon", TIME, latitude, longitude)
    assert inspect(log).proposals[0].open_questions == ["ref_north", "ref_east"]


@pytest.mark.parametrize("step", [1.0, 0.2])
def test_inspect_tells_the_unit_of_a_receivers_times(step, tmp_path):
    log = table(tmp_path / "g.csv", "time,east,north", np.arange(400) * step, EAST, NORTH)
    assert '"time" = "time [s]"' in inspect(log).column_map
    table(log, "time,east,north", np.arange(400) * step * 1000, EAST, NORTH)
    assert '"time" = "time [ms]"' in inspect(log).column_map


def test_a_file_in_which_nothing_is_known_is_not_said_to_be_zero(tmp_path):
    log = table(tmp_path / "g.csv", "time,pressure,humidity", TIME, EAST, NORTH)
    said = inspect(log).report()
    assert "zero" not in said and not re.search(r": :", said)


def test_beside_a_sensor_the_places_are_noted(tmp_path):
    rng, n = np.random.default_rng(7), len(TIME)
    samples = [*rng.standard_normal((3, n)), *(rng.standard_normal((3, n)) + [[0], [0], [9.8]])]
    header = "t,gx,gy,gz,ax,ay,az,lat,lon"
    log = table(tmp_path / "g.csv", header, TIME * 0.05, *samples, *np.degrees(fixes()))
    assert "lat, lon are left out: a reference's ref_latitude, " in inspect(log).column_map
