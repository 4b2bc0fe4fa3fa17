"""The read-out: range and resolution.  Both lose information."""

import casadi as ca

from pyimu.effect import Parameter, Scan, effect


def _at_limit(y, limit):
    return ca.if_else(limit > 0, ca.fabs(y) >= limit, 0)


@effect(stage="output", term="input range, saturation", equation=r"y = \max(-L, \min(L, x))", smooth=False, invertible=False,
        lost=_at_limit, source="IEEE Std 528-2019, input limits")
def saturation(x, limit: Parameter("{y}", minimum=0.0, scan=Scan("range", 0.3, 0.98, 12),
                                   description="largest output; 0 switches the limit off")):
    return ca.if_else(limit > 0, ca.fmax(-limit, ca.fmin(limit, x)), x)


@effect(stage="output", term="resolution, quantization", equation=r"y = q \lfloor x / q + 1/2 \rfloor", smooth=False,
        invertible=False, source="IEEE Std 952-2020, quantization noise; rounding of the rate to steps q")
def quantization(x, q: Parameter("{y}", minimum=0.0, description="step of the output; 0 switches rounding off")):
    return ca.if_else(q > 0, q * ca.floor(x / q + 0.5), x)
