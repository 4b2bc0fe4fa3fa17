"""Random walks.  Coefficients are roots of two-sided densities."""

import casadi as ca

from pyimu.effect import Noise, Parameter, SamplePeriod, State, effect


@effect(stage="noise", term="angle (velocity) random walk", equation=r"y = x + N w / \sqrt{h}",
        source="IEEE Std 952-2020, angle random walk; Hidalgo 2012, table 3")
def angle_random_walk(x, N: Parameter("{Y}/sqrt(s)", minimum=0.0, description="root of the two-sided white noise density"),
                      w: Noise(), h: SamplePeriod()):
    return x + N * w / ca.sqrt(h)


@effect(stage="noise", term="rate (acceleration) random walk", equation=r"y = x + b,\; \dot b = K w",
        source="Hidalgo 2012, eq. 5 and table 3; IEEE Std 952-2020, rate random walk")
def rate_random_walk(x, K: Parameter("{y}/sqrt(s)", minimum=0.0, description="root of the two-sided density of the bias's derivative"),
                     b: State("{y}"), w: Noise(), h: SamplePeriod()):
    return x + b, {"b": b + K * ca.sqrt(h) * w}
