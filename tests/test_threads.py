"""Numerics on one thread, whatever the program around has."""

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from pyimu import Recording, ins
from pyimu.numerics.threads import on_one_thread


def threads():
    """Threads of each library of linear algebra that is loaded."""
    np.linalg.eigvalsh(np.eye(3))
    found = [one["num_threads"] for one in threadpool_info() if one["user_api"] == "blas"]
    if not found:
        pytest.skip("no BLAS here whose threads can be told")
    return set(found)


def test_a_function_has_one_thread_and_its_caller_keeps_its_own():
    with threadpool_limits(limits=2, user_api="blas"):
        before = threads()
        assert on_one_thread(threads)() == {1}
        assert threads() == before


def test_a_function_that_raises_gives_the_threads_back():
    def fails():
        raise ValueError("as asked")

    with threadpool_limits(limits=2, user_api="blas"):
        before = threads()
        with pytest.raises(ValueError, match="as asked"):
            on_one_thread(fails)()
        assert threads() == before


def test_a_path_is_smoothed_on_one_thread():
    """The matrices of a smoother are 15 by 15 or 27 by 27: with two threads it took four times the
    time of the processor.
    """
    rng = np.random.default_rng(1)
    gyro, accel = 1e-3 * rng.standard_normal((300, 3)), 0.02 * rng.standard_normal((300, 3))
    time, seen = 0.01 * np.arange(300), set()
    log = Recording.from_arrays("rest", time=time, gyro=gyro, accel=accel + [0, 0, 9.80665])
    with threadpool_limits(limits=2, user_api="blas"):
        ins.run(log, method="strapdown", say=lambda *_: seen.update(threads()))
    assert seen == {1}
