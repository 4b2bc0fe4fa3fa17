"""The draws of a campaign: each a function of seed, run and name alone, and spread as said."""

import subprocess

import numpy as np
import pytest
from scipy.stats import chi2, kstest

import pyimu
from pyimu.attitude.filter.tolerances import gravity_std
from pyimu.errors import UserError
from pyimu.rover.campaign.draws import draws_of
from pyimu.rover.campaign.faults import FAULTS, NONE
from pyimu.rover.campaign.seeds import among, drawn, normal, uniform
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.system import system_of

CHANCE = 1e-4
"""With this probability a right generator fails one of these tests."""


def settings(**more):
    return Settings(pyimu.part("imt30"), **{"rate": 25.0, **more})


def test_a_draw_is_the_digest_of_its_name_and_stays_so():
    # By another program; its first 63 bits.
    found = subprocess.run(
        ["b2sum", "-l", "64"], input=b"7/123/noise", capture_output=True, check=True
    ).stdout.split()[0]
    assert drawn(7, 123, "noise") == int(found, 16) >> 1


def test_uniforms_are_uniform_and_those_of_neighbours_independent():
    x = np.array([uniform(0, i, "a", -1.0, 3.0) for i in range(4000)])
    assert kstest((x + 1) / 4, "uniform").pvalue > CHANCE
    y = np.array([uniform(0, i, "b") for i in range(4000)])
    z = np.array([uniform(1, i, "a") for i in range(4000)])
    for other in (y, z, np.roll(x, 1)):
        # A correlation of independent numbers has the variance 1/n.
        assert abs(np.corrcoef(x, other)[0, 1]) < 4 / np.sqrt(4000)


def test_normals_are_normal():
    assert (
        kstest(np.concatenate([normal(3, i, "n", 10) for i in range(300)]), "norm").pvalue > CHANCE
    )
    assert normal(3, 5, "n", 10)[:4].tolist() == normal(3, 5, "n", 4).tolist()


def test_each_choice_is_as_likely_as_another():
    counts = np.bincount([among(0, i, "terrain", 7) for i in range(7000)], minlength=7)
    assert np.sum((counts - 1000) ** 2 / 1000) < chi2.isf(CHANCE, 6)


def test_a_run_has_one_fault_or_none_within_its_drive():
    campaign = settings(faults=tuple(FAULTS), heading_every=10.0)
    faults = [draws_of(campaign, i).fault(60.0, 390.0) for i in range(1200)]
    counts = [sum(f.name == name for f in faults) for name in (NONE, *FAULTS)]
    assert np.sum((np.array(counts) - 200) ** 2 / 200) < chi2.isf(CHANCE, len(FAULTS))
    assert all(60 < f.time < 390 for f in faults if f.name not in (NONE, "saturating"))


def test_what_is_drawn_beside_does_not_change_a_draw():
    """A campaign with faults has the noise, the temperatures and the grounds of one without."""
    plain, faulty = (draws_of(settings(faults=f), 17) for f in ((), ("stuck",)))
    assert (plain.noise_seed, plain.terrain, plain.profile) == (
        faulty.noise_seed,
        faulty.terrain,
        faulty.profile,
    )


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"drive": "turn-on-sport"}, "turn-on-spot"),
        ({"faults": ("stuk",)}, "stuck"),
        ({"faults": ("heading-lost",)}, "heading_every"),
        ({"terrains": 0}, "terrains 0"),
        ({"rate": 0.0}, "rate 0.0"),
        ({"seed": -1}, "seed -1"),
        ({"body": "mars"}, "Mars"),
        ({"specimens": True}, "has no tolerances"),
        ({"heading_every": float("nan")}, "heading_every nan"),
        ({"heading_every": 5.0, "heading_std": 0.0}, "heading_std 0"),
    ],
)
def test_settings_that_are_none_are_refused(values, words):
    with pytest.raises(UserError, match=words):
        settings(**values)


def test_what_decides_on_the_runs_is_in_the_key():
    keys = {
        settings(**v).key()
        for v in ({}, {"seed": 1}, {"rate": 26.0}, {"faults": ("stuck",)}, {"heading_every": 9.0})
    }
    assert len(keys) == 5
    assert settings().key() == settings().key()
    other = pyimu.part("imt30")
    other = other.with_sensor(other.gyro.with_values("scale_factor", s=1e-3))
    assert Settings(other, rate=25.0).key() not in keys


def test_the_filter_believes_the_gravity_that_specimens_measure():
    """Standard deviation over 400 specimens, to 4 standard errors of 1/sqrt(2 n): uniform sums
    scatter less than normal ones.
    """
    part, g, n = pyimu.part("mpu6050"), 9.80665, 400
    accels = [part.specimen(k).accel.values for k in range(n)]
    off = [a["turn_on_bias"]["b0"][2] + g * a["scale_factor"]["s"][2] for a in accels]
    assert gravity_std(part) == pytest.approx(np.std(off), rel=4 / np.sqrt(2 * n))
    system = system_of(Settings(part))
    at = [v.name for v in system.filter.parameters].index("gravity_tolerance")
    allowed = system.parameters(np.array([1.0, 0.0, 0.0, 0.0]), None)[at]
    assert np.abs(off).max() < allowed < g / 2
