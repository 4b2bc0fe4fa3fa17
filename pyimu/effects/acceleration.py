"""Gyro drift that specific force causes."""

from pyimu.effect import Environment, Parameter, effect


@effect(stage="bias", term="acceleration-sensitive drift (g-sensitivity)", equation=r"y = x + G f",
        source="IEEE Std 528-2019, acceleration-sensitive drift rate", sensors=("gyro",))
def g_sensitivity(x, G: Parameter("{y}/(m/s^2)", (3, 3), description="drift of axis i per specific force along axis j"),
                  f: Environment("specific_force")):
    return x + G @ f
