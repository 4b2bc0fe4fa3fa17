"""The course of a vehicle that comes to a stand: its rate is known the worse the slower it is."""

import numpy as np

from pyimu.recording.recording import Recording
from pyimu.recording.reference.course import UNEVEN, course_of

NOISE = 0.02
"""m/s of a velocity."""


def test_a_course_has_noise_of_about_one_size():
    """At 0.3 m/s its rate was known thirty times worse than at 10 m/s, beside which a floor for
    both means nothing; its direction was still a course there.
    """
    rng, time = np.random.default_rng(2), np.arange(3000) / 10
    speed = 5.1 - 4.9 * np.cos(2 * np.pi * time / 60)
    heading = 0.8 * np.sin(2 * np.pi * time / 25)
    velocity = speed[:, None] * np.column_stack([np.cos(heading), np.sin(heading)])
    velocity = np.column_stack([velocity, 0 * time]) + NOISE * rng.standard_normal((len(time), 3))
    found = course_of(Recording.from_arrays("car", time=time, ref_velocity=velocity))
    known = np.isfinite(found.rate)
    assert np.all(known[speed > 3.0]) and not np.any(known[speed < 0.5])
    # The median is that of all rows, before some are left out.
    assert found.std[known].max() <= 1.5 * UNEVEN * np.median(found.std[known])
    off = (found.rate - 0.8 * 2 * np.pi / 25 * np.cos(2 * np.pi * time / 25))[known]
    # The smoother allows for a rougher motion than this one.
    assert 0.5 < np.sqrt(np.mean((off / found.std[known]) ** 2)) < 1.1
