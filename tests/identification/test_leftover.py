"""What a residual is tried against once no effect of the catalogue helps."""

import numpy as np
import pytest
from loop_cases import inputs, trial

from pyimu.identification.fit.sample_noise import white_noise
from pyimu.identification.formula.terms import usable
from pyimu.model.kinds import OWN

TIME = np.arange(6000) * 0.01


@pytest.mark.parametrize("share", [0.0, 3.0])
def test_an_input_counts_where_it_is_more_than_its_own_noise(share):
    """An accelerometer on a level rate table shows nothing but its noise: of 1500 rows and more the
    noise is known to 4 %, and its spread is 1.41 times it by chance never.
    """
    rng, u = np.random.default_rng(1), inputs(np.random.default_rng(2), TIME)
    own = 0.02 * rng.standard_normal((len(TIME), 3))
    slow = share * 0.02 * np.sqrt(2) * np.sin(2 * np.pi * 0.3 * TIME)[:, None]
    u[:, OWN["accel"]] = [0.0, 0.0, 9.8] + own + slow
    moving = usable((trial(TIME, np.zeros((len(TIME), 3)), u),))
    assert moving.get("specific_force", ()) == ((0, 1, 2) if share else ())


def test_white_noise_is_told_from_motion():
    """Of the quietest quarter of a minute, 1500 rows whose third differences are correlated: known
    to some 4 %, and the quietest seconds lie lower by about two of a second's own 12 %.
    """
    u = inputs(np.random.default_rng(3), TIME)
    one = trial(TIME, np.zeros((len(TIME), 3)), u)
    values = np.sin(2 * np.pi * TIME)[:, None]
    values = values + 0.02 * np.random.default_rng(4).standard_normal(values.shape)
    assert white_noise(one, values)[0] == pytest.approx(0.02, rel=0.3)
