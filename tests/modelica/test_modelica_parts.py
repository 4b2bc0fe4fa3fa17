"""Built-in parts in Modelica give what their FMI 2.0 units give."""

import numpy as np
import pytest
from catalogue_cases import one_of_each_kind
from modelica_cases import LAST_PLACES, measured, simulated, ulps

from pyimu.block.normals import normals
from pyimu.fmu import build_fmus, simulate
from pyimu.model.chain import chain_of
from pyimu.modelica.bench import excite
from pyimu.modelica.names import camel, pascal
from pyimu.modelica.sensors import parts, sensor_texts

SAMPLES, FEWER = 1000, 250
"""Of a part of each set of effects, and of the others, which differ in their figures alone."""
SEEDS = (0, 1, 2**31 - 1)
PARTS = parts()
COMPILED = [*map(pascal, one_of_each_kind())]
SHORT = COMPILED[:3]
CASES = [
    pytest.param(name, SEEDS[i % len(SEEDS)], marks=() if name in SHORT else pytest.mark.long)
    for i, name in enumerate(PARTS)
]

INPUTS = {
    "rate": (0, [0.1, 0.0, 0.0], [0.5, 0.6, 0.7]),
    "specificForce": (1, [0.0, 0.0, 9.80665], [1.0, 2.0, 3.0]),
    "temperature": (2, [25.0], [10.0]),
}
"""Shift, middle and amplitude of each input."""


def matrix(rows):
    """A table as Modelica writes it."""
    return "{" + ", ".join("{" + ", ".join(map(repr, row)) + "}" for row in rows.tolist()) + "}"


def tables(part, seed, n):
    """Modifications that feed the generator's normals, of which rumoca draws some ten a second."""
    triads = []
    for sensor, triad in ((part.gyro, "gyroscope"), (part.accel, "accelerometer")):
        fed = []
        for e in sensor.effects:
            channels = [c.number for c in chain_of(sensor.kind, (e,)).noise]
            if channels:
                drawn = matrix(normals(seed, channels, 1, n))
                fed.append(f"{camel(e.name)}Normals(useTable=true, table={drawn})")
        if fed:
            triads.append(f"{triad}({', '.join(fed)})")
    return ", ".join(triads)


def declared(name, seed, n, block="imu"):
    """The declaration of a ``PyImu.Sensors.Imu`` that is a built-in part, at its own rate."""
    fed = tables(PARTS[name], seed, n)
    chosen = f", {camel(name)}({fed})" if fed else ""
    return f"PyImu.Sensors.Imu {block}(part=PyImu.Sensors.Part.{name}, seed={seed}{chosen});"


def vehicle(declarations, period, blocks=("imu",)):
    """A model that moves the sensors."""
    lines = [*declarations]
    connections = []
    for name, (shift, offset, amplitude) in INPUTS.items():
        values = [f"{{{', '.join(map(repr, v))}}}" for v in (offset, amplitude)]
        lines.append(
            f"PyImu.Examples.Excitation {name}(samplePeriod={period!r}, n={len(offset)}, "
            f"shift={shift}, offset={values[0]}, amplitude={values[1]});"
        )
        element = "[1]" if len(offset) == 1 else ""
        connections += [f"connect({name}.y{element}, {b}.{name});" for b in blocks]
    return "\n".join(["model Vehicle", *lines, "equation", *connections, "end Vehicle;"])


def motion(n):
    """The inputs (n, 7) of the units for the same motion."""
    k = np.arange(1, n + 1)
    return np.hstack([excite(k, np.array(o), np.array(a), s) for s, o, a in INPUTS.values()])


def largest_noise(part):
    """Three standard deviations (7,) of the larger noise, white or flicker, in a sample.

    Both are summands of each output, as large as this more than once in the samples of its axes,
    and their rounding stays where the input is zero and little is left of the sum.
    """
    found = [np.zeros(1)]
    for sensor in (part.gyro, part.accel):
        white = sensor.values.get("angle_random_walk", {"N": np.zeros(3)})["N"]
        flicker = sensor.values.get("bias_instability", {"B": np.zeros(3)})["B"]
        found.insert(-1, 3 * np.maximum(white / part.sample_period**0.5, flicker))
    return np.concatenate(found)


@pytest.mark.parametrize(("name", "seed"), CASES)
def test_part_gives_the_samples_of_its_unit(name, seed, tmp_path):
    """From the first sample on, and the same before it: the ideal measurement of a part at rest.

    The unit is compiled for one part of each set of effects; the others differ from it in their
    figures alone, and are compared with their block, whose bits the units have.
    """
    part, n = PARTS[name], SAMPLES if name in COMPILED else FEWER
    text = vehicle([declared(name, seed, n)], part.sample_period)
    rows = simulated("Vehicle", n * part.sample_period, part.sample_period, text)
    u = motion(n)
    if name in COMPILED:
        (unit,) = build_fmus(part.block, tmp_path, (2,))
        found = simulate(unit, u, sample_period=part.sample_period, start_values={"seed": seed})
        want = found[1:]
    else:
        want = part.block.run(u, seed=seed)[0]
    assert np.std(want - u, axis=0)[:6].any()
    assert ulps(measured(rows)[1:], want, u, largest_noise(part)) <= LAST_PLACES
    np.testing.assert_array_equal(measured(rows)[0], [0, 0, 0, 0, 0, 9.80665, 25])


def test_imt30_is_its_block_to_the_bit():
    """No exponential is in it. One of each seed, side by side."""
    part, n = PARTS["Imt30"], 200
    blocks = [f"imu{i}" for i in range(len(SEEDS))]
    together = [declared("Imt30", seed, n, b) for seed, b in zip(SEEDS, blocks, strict=True)]
    text = vehicle(together, part.sample_period, blocks)
    rows = simulated("Vehicle", n * part.sample_period, part.sample_period, text)
    for seed, block in zip(SEEDS, blocks, strict=True):
        want = part.block.run(motion(n), seed=seed)[0]
        np.testing.assert_array_equal(measured(rows, block)[1:], want)


def test_a_second_instance_changes_nothing():
    """Nor does its seed, and a seed of its own gives noise of its own."""
    part, n = PARTS["Imt30"], 50
    pair = [declared("Imt30", 1, n), declared("Imt30", 2, n, "other")]
    rows = simulated(
        "Vehicle",
        n * part.sample_period,
        part.sample_period,
        vehicle(pair, part.sample_period, ("imu", "other")),
    )
    for block, seed in (("imu", 1), ("other", 2)):
        want = part.block.run(motion(n), seed=seed)[0]
        np.testing.assert_array_equal(measured(rows, block)[1:], want)


def test_part_draws_its_noise_itself():
    """Without a table: six normals a sample, from the channels of the unit's variables."""
    part, n, period = PARTS["Imt30"], 8, PARTS["Imt30"].sample_period
    text = f"PyImu.Sensors.Parts.Imt30.Imu imu(seed=5, samplePeriod={period!r});"
    rows = simulated("Vehicle", n * period, period, vehicle([text], period))
    np.testing.assert_array_equal(measured(rows)[1:], part.block.run(motion(n), seed=5)[0])


def test_an_input_that_some_parts_need_is_there_where_they_are_chosen():
    """Of the built-in parts none needs one but those of every part."""
    coupled = PARTS["Bmi088"].accel.with_values("magnetic_sensitivity", C=np.eye(3))
    found = sensor_texts({**PARTS, "Bmi088": PARTS["Bmi088"].with_sensor(coupled)})
    for name in ("Imu", "Accelerometer"):
        text = found[name]
        assert "RealInput mag[3]" in text and "if part == PyImu.Sensors.Part.Bmi088" in text
        assert text.count("connect(mag, bmi088.mag);") == text.count("connect(mag,") == 1
    assert "mag" not in found["Gyroscope"]
