"""Bias that supply and magnetic field cause."""

from pyimu.model.effect import Confound, Environment, Parameter, effect


@effect(
    stage="bias",
    term="supply sensitivity",
    equation=r"y = x + k_V (V - V_0)",
    source=(
        "no source for the equation; data sheets state its coefficient per volt (ADIS16460 rev. B, "
        "table 1)"
    ),
)
def supply_sensitivity(
    x,
    kV: Parameter("{y}/V", description="bias per volt"),
    V0: Parameter("V", (), 3.3, "supply at which the error is zero", reference=True),
    V: Environment("supply"),
):
    return x + kV * (V - V0)


@effect(
    stage="bias",
    term="magnetic sensitivity",
    equation=r"y = x + C B",
    source=(
        "IEEE Std 528-2019, acceleration-insensitive drift rate, note on magnetic influences; no "
        "source for the linear form"
    ),
    confound=Confound(
        "another influence that keeps its direction in the world, as the field does",
        "a field that changes while the body rests, by a coil or a magnet,",
    ),
)
def magnetic_sensitivity(
    x,
    C: Parameter("{y}/T", (3, 3), description="bias of axis i per flux density along axis j"),
    B: Environment("mag"),
):
    return x + C @ B
