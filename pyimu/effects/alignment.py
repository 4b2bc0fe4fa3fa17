"""Input axes that do not lie along the body axes."""

from pyimu.effect import Parameter, effect


@effect(stage="gain", term="misalignment, nonorthogonality", equation=r"y = x + M x,\; \mathrm{diag}\, M = 0",
        source="Hidalgo 2012, eq. of the compensated rate (matrix M); IEEE Std 528-2019, input axis misalignment")
def misalignment(x, m: Parameter("rad", (3, 3), diagonal=False, description="small angle: part of axis j seen by axis i")):
    return x + m @ x
