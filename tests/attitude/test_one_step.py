"""The numbers of a part are parameters of its filters, whose equations are made once."""

import casadi as ca
import pytest
from catalogue_cases import CASES, as_part, excited

from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter import layout as attitude
from pyimu.attitude.filter import ukf
from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.variables import OWN_PARAMETERS
from pyimu.block.structured import Structured
from pyimu.ins.filter import ins_block, layout
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS

SHARES = 0.05, 0.03


def with_effect(name, kind, share):
    other = "accel" if kind == "gyro" else "gyro"
    return as_part(excited(name, kind, share), Sensor(other))


def equations(part):
    """What a filter makes of the effects of a part: compensation, noise, Earth rate."""
    compensation, own = Compensation(part), len(OWN_PARAMETERS)
    memory = ca.SX.sym("m", len(compensation.start))
    p = ca.SX.sym("p", own + len(part.gyro.slots) + len(part.accel.slots))
    settings, h = Settings.of(compensation, p), ca.SX.sym("h")
    signals = {name: ca.SX.sym(name, s.size) for name, s in SIGNALS.items()}
    undone = compensation.apply(memory, dict(signals), settings.gyro_p, settings.accel_p, h)
    noise = (*vars(settings.gyro).values(), *vars(settings.accel).values(), settings.earth)
    outputs = [ca.densify(ca.SX(v)) for v in (*undone, *noise)]
    return ca.Function("f", [memory, p, h, *signals.values()], outputs).serialize()


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_equations_of_an_effect_hold_for_all_its_coefficients(name, kind):
    one, other = (with_effect(name, kind, share) for share in SHARES)
    assert Compensation(one).structure == Compensation(other).structure
    assert Compensation(one).start == Compensation(other).start
    assert equations(one) == equations(other)


def white(share):
    noise = {"angle_random_walk": {"N": share}}
    return as_part(Sensor("gyro", noise), Sensor("accel", noise))


def test_the_attitude_filter_of_other_numbers_has_the_same_step():
    one, other = map(attitude_ukf, map(white, SHARES))
    assert other.step is one.step and other.parameters != one.parameters
    anew = Structured((), attitude.Layout(Compensation(white(SHARES[1]))))
    assert ukf._step(anew, False).whole.serialize() == one.step.serialize()


def test_the_navigation_filter_of_other_numbers_has_the_same_step():
    layouts = [layout.Layout(white(share), nhc=True) for share in SHARES]
    one, other = map(ins_block.ins_of_log, layouts)
    assert other.step is one.step and other.parameters != one.parameters
    anew = ins_block._step(Structured((), layouts[1]), False)
    assert anew.serialize() == one.step.serialize()


def test_another_effect_or_layout_has_a_step_of_its_own():
    part = white(0.05)
    lagged = as_part(part.gyro.with_values("lag", wn=100.0), part.accel)
    made = [(part, {}), (lagged, {}), (part, {"nhc": True}), (part, {"wheels": True})]
    assert len({layout.Layout(p, **more).structure for p, more in made}) == len(made)
    assert Compensation(part).structure != Compensation(part, now=False).structure
