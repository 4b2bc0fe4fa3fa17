"""The typical magnitudes against the catalogue that they are for: complete, of the right dimension,
with honest sources.
"""

import math
import re

import numpy as np
import pytest

from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.kinds import KINDS
from pyimu.model.part_file import part, part_names
from pyimu.model.sensor import Sensor
from pyimu.model.typical import CLASSES, NO_SOURCE, _table, documents, largest, magnitudes
from pyimu.units import convert, same_dimension

PAIRS = sorted((e.name, kind) for e in CATALOGUE.values() for kind in e.sensors)

MORE_IS_BETTER = {"lag": "a higher natural frequency is less lag"}

UNORDERED = {
    "saturation": "a range is chosen for the task",
    "size_effect": "one chip is smaller than a unit of many",
}
"""Where a consumer part may have the smaller figure, and why."""


def every():
    """All magnitudes as (effect, kind, class, magnitude)."""
    return [(name, kind, c, m) for name, kind in PAIRS for c, m in magnitudes(name, kind).items()]


def template(name, parameter, kind):
    return Sensor(kind).unit(CATALOGUE[name].parameters[parameter].unit)


def test_every_effect_of_the_catalogue_has_a_magnitude_and_no_other():
    assert sorted(_table()) == PAIRS


@pytest.mark.parametrize("name, kind", PAIRS)
def test_both_classes_of_one_coefficient_that_identification_may_estimate(name, kind):
    found = magnitudes(name, kind)
    assert tuple(found) == CLASSES
    (parameter,) = {m.parameter for m in found.values()}
    assert not CATALOGUE[name].parameters[parameter].reference


@pytest.mark.parametrize("name, kind", PAIRS)
def test_units_have_the_dimension_of_their_parameters(name, kind):
    for m in magnitudes(name, kind).values():
        for parameter, unit in {
            m.parameter: m.unit,
            **{n: u for n, (_, u) in m.beside.items()},
        }.items():
            assert same_dimension(unit, template(name, parameter, kind)), (parameter, unit)


@pytest.mark.parametrize("name, kind", PAIRS)
def test_values_are_finite_and_positive_and_inside_the_limits_of_their_parameters(name, kind):
    for m in magnitudes(name, kind).values():
        for parameter, value in {m.parameter: m.si, **m.beside_si}.items():
            q = CATALOGUE[name].parameters[parameter]
            assert math.isfinite(value) and value > 0
            assert (q.minimum is None or value >= q.minimum) and (
                q.maximum is None or value <= q.maximum
            )


@pytest.mark.parametrize("name, kind", PAIRS)
def test_si_is_the_conversion_to_the_unit_of_the_parameter(name, kind):
    for m in magnitudes(name, kind).values():
        assert m.si == pytest.approx(
            convert(m.value, m.unit, template(name, m.parameter, kind)), rel=1e-14
        )


@pytest.mark.parametrize("name, kind", PAIRS)
def test_a_sensor_can_be_built_of_each_magnitude(name, kind):
    for m in magnitudes(name, kind).values():
        start = CATALOGUE[name].start()
        for parameter, value in {m.parameter: m.si, **m.beside_si}.items():
            for index in CATALOGUE[name].parameters[parameter].indices:
                start[parameter][index] = value
        assert (Sensor(kind, {name: start}).p == value).any()


@pytest.mark.parametrize("name, kind", [p for p in PAIRS if p[0] not in UNORDERED])
def test_a_consumer_part_is_not_better(name, kind):
    tactical, consumer = (magnitudes(name, kind)[c].si for c in CLASSES)
    assert tactical >= consumer if name in MORE_IS_BETTER else tactical <= consumer


def test_every_source_names_a_document_or_says_that_there_is_none():
    for name, kind, c, m in every():
        key, text = m.source.split(": ", 1)
        assert key == NO_SOURCE or key in documents(), (name, kind, c, key)
        assert text.strip(), (name, kind, c)


def test_every_document_is_used():
    mentioned = {word for *_, m in every() for word in re.findall(r"\w+", m.source)}
    assert set(documents()) <= mentioned


def test_most_magnitudes_are_sourced():
    sourced = sum(m.sourced for *_, m in every())
    guessed = sum(m.source.startswith(NO_SOURCE) for *_, m in every())
    assert sourced + guessed == len(CLASSES) * len(PAIRS)
    assert sourced > guessed


def test_each_kind_is_that_of_a_sensor():
    assert {kind for _, kind in _table()} == set(KINDS)


def test_what_data_sheets_allow_is_within_ten_times_the_typical_or_is_said():
    """The coefficients that the tolerances of all built-in parts allow, with a hundredth for
    rounding: those of bias over temperature of an MPU-9250 are the widest."""
    farthest = {}
    for name in part_names():
        for t in part(name).tolerances:
            kind, effect, parameter = t.key
            typical = magnitudes(effect, kind)["consumer"]
            if typical.parameter == parameter:
                most = max(10 * typical.si, largest(effect, kind))
                farthest[name, t.key] = np.sqrt(3) * np.max(np.abs(t.std)) / most
    assert max(farthest.values()) < 1.01, max(farthest, key=farthest.get)
    assert farthest["mpu9250", ("gyro", "thermal_bias", "kT")] == pytest.approx(1.0, abs=0.01)


def test_unknown_effect_is_refused_with_the_nearest_name():
    with pytest.raises(
        UserError, match="no effect g_sensitvity of a sensor gyro, did you mean g_sensitivity?"
    ):
        magnitudes("g_sensitvity", "gyro")


def test_effect_of_the_other_kind_is_refused():
    with pytest.raises(UserError, match="no effect g_sensitivity of a sensor accel"):
        magnitudes("g_sensitivity", "accel")
