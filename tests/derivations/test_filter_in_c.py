"""The C of the filter's FMU computes what was derived."""

import subprocess
from xml.etree import ElementTree

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu.block.compiled import compiler_command
from pyimu.derivations.independent import scalar_first
from pyimu.derivations.kinematics.quaternions import CLOSED_STEP
from pyimu.derivations.kinematics.rates import EARTH
from pyimu.derivations.model import call
from pyimu.derivations.process_noise.random_walk import STILL
from pyimu.derivations.process_noise.transition import TRANSITION
from pyimu.fmu import source_folder, write_generated
from pyimu.fmu.generate import reference_blocks
from pyimu.symbolic.earth import EARTH_RATE

H, STEPS = 0.5, 4
"""A long period and a fast turn, so that every term of a transition counts."""

FLAGS = ("-std=c11", "-O1", "-fPIC", "-shared", "-w", "-DCASADI_SYMBOL_EXPORT=")
"""casadi loads its functions by their own names, which an FMU hides."""

STD = 1e-5
"""rad, rad/s; so small that what an unscented filter adds to the linear covariance, of order STD^2,
stays below 1e-8."""


class FilterInC:
    """The C of AttitudeUkf, compiled; inputs, parameters and outputs by the names of its model
    description.
    """

    def __init__(self, source):
        write_generated(reference_blocks()[1], source)
        library = source / "libukf.so"
        include = [f"-I{source_folder()}", f"-I{source}"]
        subprocess.run(
            [*compiler_command(), *FLAGS, *include, str(source / "step.c"), "-o", library, "-lm"],
            check=True,
        )
        self.step, self.constants, self.initial = (
            ca.external(name, str(library)) for name in ("step", "constants", "initial")
        )
        variables = ElementTree.parse(source / "modelDescription.fmi3.xml").find("ModelVariables")
        self.names = {
            c: [v.get("name") for v in variables if v.get("causality") == c]
            for c in ("input", "parameter", "output")
        }
        start = {v.get("name"): v.get("start") for v in variables}
        self.p = {n: float(start[n]) for n in self.names["parameter"][: self.step.numel_in(2)]}

    def run(self, u, p):
        """Outputs after each row of inputs, given by name (others zero, and a force that is not
        quasi-static), by name.
        """
        parameters = list({**self.p, **p}.values())
        state, out = self.initial(np.zeros(len(self.names["input"])), parameters)[0], []
        constants = self.constants(parameters, H)
        for row in u:
            inputs = {
                "accel[1]": 50.0,
                "temperature": self.p.get("gyro_error.thermal_bias.T0", 25.0),
                **row,
            }
            state, y = self.step(
                state,
                [inputs.get(n, 0.0) for n in self.names["input"]],
                parameters,
                [],
                H,
                constants,
            )
            out.append(dict(zip(self.names["output"], np.array(y).ravel(), strict=True)))
        return out


@pytest.fixture(scope="module")
def in_c(tmp_path_factory):
    if not compiler_command():
        pytest.skip("needs a C compiler")
    return FilterInC(tmp_path_factory.mktemp("ukf"))


def named(name, values):
    return {f"{name}[{i + 1}]": float(v) for i, v in enumerate(values)}


def array(y, name, n):
    return np.array([y[f"{name}[{i + 1}]"] for i in range(n)])


def test_c_of_the_fmu_turns_as_the_derived_step_less_bias_and_earth_rate(in_c):
    omega = CLOSED_STEP.function(("Omega",), ("omega", "h"))
    rng = np.random.default_rng(1)
    for _ in range(20):
        attitude, rate, bias = (
            Rotation.from_quat(rng.standard_normal(4)),
            rng.normal(size=3),
            rng.normal(size=3) / 10,
        )
        latitude, q = rng.uniform(-1.5, 1.5), scalar_first(attitude)
        y = in_c.run(
            [named("gyro", rate)],
            {
                "latitude": latitude,
                **named("q0", q),
                **named("bias0", bias),
                **named("std0", np.zeros(6)),
            },
        )[0]
        earth = call(EARTH.function(("omega_enu",), ("lat", "omega_ie")), latitude, EARTH_RATE)[0]
        expected = call(omega, rate - bias - attitude.apply(earth, inverse=True), H)[0] @ q
        got = array(y, "q", 4)
        np.testing.assert_allclose(got * np.sign(got @ expected), expected, atol=1e-14)
        # It is known at the start, and wanders by 1e-6 rad/s in a step at most from there.
        np.testing.assert_allclose(array(y, "gyro_bias", 3), bias, atol=1e-9)


def covariances(rates, std0, n, k, sign=1.0):
    """Standard deviations (steps, 6) by the derived transition matrix and process noise."""
    transition = TRANSITION.function(("Phi",), ("omega", "h", "s"))
    q = call(
        STILL.function(("Q",), ("S_N", "S_K", "h", "s")), np.diag(n**2), np.diag(k**2), H, 1.0
    )[0]
    q[:3, 3:], q[3:, :3] = sign * q[:3, 3:], sign * q[3:, :3]
    p, out = np.diag(std0**2), []
    for rate in rates:
        phi = call(transition, rate, H, 1.0)[0]
        p = phi @ p @ phi.T + q
        out.append(np.sqrt(np.diag(p)))
    return np.array(out)


def test_c_of_the_fmu_has_the_derived_transition_matrix_and_process_noise(in_c):
    """The other sign off the diagonal would differ by more than a hundredth."""
    rng = np.random.default_rng(2)
    for _ in range(5):
        rates, std0, (n, k) = (
            rng.normal(size=(STEPS, 3)),
            STD * rng.uniform(0.5, 2, 6),
            STD * rng.uniform(0.5, 2, (2, 3)),
        )
        settings = {
            "latitude": 10.0,
            **named("std0", std0),
            **named("gyro_error.angle_random_walk.N", n),
            **named("gyro_error.rate_random_walk.K", k),
        }
        got = np.array(
            [
                array(y, "std", 6)
                for y in in_c.run([named("gyro", rate) for rate in rates], settings)
            ]
        )
        np.testing.assert_allclose(got, covariances(rates, std0, n, k), rtol=1e-8)
        assert np.abs(got / covariances(rates, std0, n, k, sign=-1.0) - 1).max() > 0.01
