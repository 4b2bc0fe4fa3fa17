"""Numerics on one thread."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from threadpoolctl import threadpool_limits

P, R = ParamSpec("P"), TypeVar("R")


def on_one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """A function whose linear algebra has one thread, whatever its caller's has.

    The matrices here are small, and threads wait for each other longer than they compute; the bits
    of a sum would follow their number.
    """

    @wraps(function)
    def run(*args: P.args, **kwargs: P.kwargs) -> R:
        with threadpool_limits(limits=1, user_api="blas"):
            return function(*args, **kwargs)

    return run
