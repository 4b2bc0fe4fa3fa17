"""The magnetic field of a place: right by the model's own coefficients, and what the filter makes
of it.
"""

import json
from importlib.resources import files

import numpy as np
import pytest
from attitude_cases import output, part
from scipy.spatial.transform import Rotation
from scipy.special import gammaln, lpmv
from test_attitude_magnetometer import DISTURBED, FIELD, World, recording

from pyimu import UserError
from pyimu.attitude import attitude_ukf, run
from pyimu.attitude.alignment import MagneticNorth
from pyimu.attitude.world_field import WorldField, world_field

PLACE = (np.radians(52.5), np.radians(13.3), 40.0)
DATE = "2026-05-01"


# The model


def potential(point, coefficients):
    """Of the field in T m at an Earth-fixed ``point`` (3,) m: a sum of Schmidt's harmonics."""
    a, r = 6371200.0, np.linalg.norm(point)
    sine, longitude = point[2] / r, np.arctan2(point[1], point[0])
    total = 0.0
    for n, m, g, h in coefficients:
        norm = np.sqrt((2 if m else 1) * np.exp(gammaln(n - m + 1) - gammaln(n + m + 1)))
        schmidt = (-1) ** m * norm * lpmv(m, n, sine)
        wave = g * np.cos(m * longitude) + h * np.sin(m * longitude)
        total += a * (a / r) ** (n + 1) * schmidt * wave
    return 1e-9 * total


def by_the_coefficients(latitude, longitude, height, year):
    """East, north, up (3,) in T: minus the slope of the potential, by differences."""
    lines = files("pygeomag").joinpath("wmm/WMM_2025.COF").read_text().splitlines()
    table = np.array([line.split() for line in lines[1:] if len(line.split()) == 6], dtype=float)
    later = year - 2025.0
    coefficients = [
        (int(n), int(m), g + later * gd, h + later * hd) for n, m, g, h, gd, hd in table
    ]
    to_world = Rotation.from_euler("ZX", [np.pi / 2 + longitude, np.pi / 2 - latitude])
    axes = to_world.as_matrix()
    major, flat = 6378137.0, 1 / 298.257223563
    squared = flat * (2 - flat)
    across = major / np.sqrt(1 - squared * np.sin(latitude) ** 2)
    up = axes[:, 2]
    point = across * up * [1, 1, 1 - squared] + height * up
    step = 100.0
    return np.array(
        [
            potential(point - step * axis, coefficients)
            - potential(point + step * axis, coefficients)
            for axis in axes.T
        ]
    ) / (2 * step)


@pytest.mark.parametrize(
    "place", [PLACE, (-0.6, 2.6, 0.0), (1.2, -2.5, 3e3)], ids=["Berlin", "south", "Arctic"]
)
def test_wmm2025_is_the_slope_of_its_potential(place):
    """A difference over 200 m is off by (step / r)^2 n^2 / 6 of each term: below 1e-8."""
    found = world_field(place, "2026-05-02")
    east, north, up = by_the_coefficients(*place, 2026 + 121 / 365)
    level, upward = found.parts
    seen = [level * np.sin(found.declination), level * np.cos(found.declination), upward]
    np.testing.assert_allclose(seen, [east, north, up], rtol=0, atol=1e-10)


def test_wmm2025_error_model():
    """Figures of the WMM2025 technical report: F 138 nT, I 0.20 deg, H 133 nT, Z 141 nT, and of D
    the root of 0.26^2 + (5417 nT / H)^2 deg.
    """
    found = world_field(PLACE, DATE)
    level = 1e9 * found.parts[0]
    stds = (found.strength_std, found.level_std, found.upward_std)
    np.testing.assert_allclose(stds, [138e-9, 133e-9, 141e-9])
    np.testing.assert_allclose(np.degrees(found.dip_std), 0.20)
    np.testing.assert_allclose(
        np.degrees(found.declination_std), np.hypot(0.26, 5417 / level), rtol=1e-6
    )


@pytest.mark.parametrize(
    ("place", "date", "said"),
    [
        ((52.5, 13.3), DATE, "latitude 52.5, expected -pi/2 to pi/2 rad"),
        ((2.3, 0.9), DATE, "is it the longitude"),
        ((0.9, 7.0), DATE, "longitude 7, expected"),
        ((0.9,), DATE, "expected latitude and longitude in rad"),
        ((0.9, np.nan), DATE, "expected latitude and longitude in rad"),
        ((0.9, 0.2, 1e6), DATE, "height 1e+06 m"),
        (PLACE, "2014-12-31", "2015-01-01 to 2029-12-31"),
        (PLACE, "2030-01-01", "2015-01-01 to 2029-12-31"),
        (PLACE, "1.5.2026", "expected one such as 2026-05-01"),
    ],
)
def test_what_is_no_place_or_date_is_said(place, date, said):
    with pytest.raises(UserError, match=".*") as error:
        world_field(place, date)
    assert said in str(error.value)


# The filter


def settings_of(field, std=1.4e-7):
    """The filter's, of a field (3,) east, north, up."""
    level, size = np.hypot(*field[:2]), np.linalg.norm(field)
    return {
        "field_strength": size,
        "field_dip": np.arctan2(-field[2], level),
        "field_strength_std": std,
    }


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


def test_a_disturbed_start_is_said_where_the_field_is_known(block):
    """Iron by the start bends the field for ten seconds: who does not know the place takes it for
    the place's own, and the heading is wrong by what the filter thinks impossible.
    """
    world = World(201)
    field, off = np.tile(FIELD, (world.rows, 1)), slice(0, 1000)
    field[off] += [20e-6, 0, -15e-6]
    mag = world.mag(field)
    told, alone = world.run(block, mag, **settings_of(FIELD)), world.run(block, mag)
    said = output(block, told, "status").astype(int) & DISTURBED > 0
    assert said[off].all() and not said[1000:].any()
    assert not (output(block, alone, "status").astype(int)[off] & DISTURBED).any()
    error, std = world.heading_error(block, told), output(block, told, "heading_std")
    assert np.abs(error / std).max() < 4 and abs(error[-1]) < 4 * std[-1] < 0.2
    wrong = world.heading_error(block, alone) / output(block, alone, "heading_std")
    assert np.abs(wrong[off]).max() > 8


def test_another_field_that_lasts_is_taken(block):
    """In a room of another strength the run learns that, as without a place."""
    world = World(202)
    room = 0.7 * FIELD
    y = world.run(block, world.mag(room), **settings_of(FIELD))
    said = output(block, y, "status").astype(int) & DISTURBED > 0
    assert said[:1900].all() and not said[2500:].any()
    error, std = world.heading_error(block, y), output(block, y, "heading_std")
    assert np.abs(error / std).max() < 4 and std[-1] < std[1900]


def test_an_unknown_strength_gives_the_bits_of_no_place(block):
    world = World(203)
    mag = world.mag()
    nothing = world.run(block, mag, **(settings_of(FIELD) | {"field_strength": 0.0}))
    np.testing.assert_array_equal(nothing, world.run(block, mag))


def test_declination_strength_and_dip_of_a_place_are_the_filters():
    world, field = World(204, still=300), world_field(PLACE, DATE)
    level, up = field.parts
    north = Rotation.from_euler("z", -field.declination).apply([0, level, up])
    mag = world.mag(north)
    log = recording(world, mag)
    found = run(log, part(), place=PLACE, date=DATE)
    for name, value in field.settings().items():
        assert found.parameters[name] == value
    assert found.parameters["latitude"] == PLACE[0] and found.magnetometer.world == field
    plain = run(log, part(), latitude=PLACE[0], settings=field.settings())
    turned = Rotation.from_quat(found.q[-1], scalar_first=True) * world.attitude[-1].inv()
    assert abs(turned.as_rotvec()[2]) < 4 * found.heading_std[-1] < 0.2
    np.testing.assert_array_equal(found.q, plain.q)
    assert "declination 5.09 ± 0.39 deg" in found.report() and "note" not in found.report()


def test_a_room_of_another_strength_is_said_and_starts_less_sure():
    world = World(205, still=300)
    log = recording(world, world.mag(0.85 * FIELD))
    size, dip = np.linalg.norm(FIELD), np.arctan2(-FIELD[2], FIELD[1])
    known = WorldField("WMM", 0.0, 0.006, size, 1.4e-7, dip, 0.003, 1.3e-7, 1.4e-7)
    level, up = 0.85 * FIELD[1:]
    off = 0.15 * size / np.sqrt(2)
    north = MagneticNorth(0.0, 1e-6, known.parts)
    np.testing.assert_allclose(north.across(level, up), np.hypot(1e-6, off))
    found = run(log, part(), place=PLACE, date=DATE)
    assert "World Magnetic Model has 50.1 uT" in found.report()


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"place": PLACE}, "place without date"),
        ({"date": DATE}, "date without place"),
        ({"place": PLACE, "date": DATE, "latitude": 0.9}, "latitude beside place"),
        (
            {"place": PLACE, "date": DATE, "settings": {"declination": 0.1}},
            "declination beside place",
        ),
    ],
)
def test_what_is_given_twice_or_by_half_is_said(more, said):
    log = recording(World(206, rows=500, still=300), FIELD)
    with pytest.raises(UserError, match=said):
        run(log, part(), **more)


# The command


@pytest.fixture
def log(tmp_path):
    world = World(207, rows=1000, still=300)
    return recording(world, world.mag()).write(tmp_path / "log.csv")


def test_place_on_the_command_line(pyimu, log, tmp_path):
    code, out, err = pyimu(
        "attitude", log, "--place", "52.5,13.3,40", "--date", DATE, "--out", "out"
    )
    assert code == 0 and err == "" and "true north by WMM-2025 (declination 5.09" in out
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    np.testing.assert_allclose(data["parameters"]["latitude"], PLACE[0])
    assert data["magnetometer"]["world"]["model"] == "WMM-2025"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--place", "52.5,13.3"), "place without date"),
        (("--date", DATE), "date without place"),
        (("--place", "52.5;13.3", "--date", DATE), "expected LAT,LON or LAT,LON,HEIGHT"),
        (("--place", "151.2,-33.8", "--date", DATE), "is it -33.8,151.2?"),
        (("--place", "91,200", "--date", DATE), "latitude 91, must lie between -90 and 90 deg"),
        (("--place", "52.5,13.3", "--date", "2035-01-01"), "2029-12-31"),
        (("--place", "52.5,13.3", "--date", DATE, "--declination", "5"), "--declination beside"),
        (("--place", "52.5,13.3", "--date", DATE, "--latitude", "52"), "--latitude beside"),
    ],
)
def test_bad_places_end_in_one_line(pyimu, log, tmp_path, words, said):
    code, _, err = pyimu("attitude", log, "--out", "out", *words)
    assert code == 2 and said in err and err.count("\n") == 1
    assert not (tmp_path / "out").exists()
