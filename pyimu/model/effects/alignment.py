"""Input axes that do not lie along the body axes."""

from pyimu.model.effect import Confound, Parameter, effect


@effect(
    stage="gain",
    magnetic=True,
    term="misalignment, nonorthogonality",
    equation=r"y = x + M x,\; \mathrm{diag}\, M = 0",
    source="Hidalgo 2012, section 3.2, matrix M; Groves 2013, eqs. 4.16 and 4.17, M_a and M_g",
    mounting=True,
    symptom="is not square to its axes",
    confound=Confound(
        "a turn of the reference's mounting",
        "a reference whose axes are known to be the sensor's",
    ),
)
def misalignment(
    x,
    m: Parameter(
        "rad", (3, 3), diagonal=False, description="small angle: part of axis j seen by axis i"
    ),
):
    return x + m @ x
