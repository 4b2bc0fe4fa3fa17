"""The script that asks OpenModelica: its classes, and how it reads the answers.

The answers are of the form that OpenModelica 1.2x gives them; the tool itself is not at hand.
"""

import importlib.util

from modelica_cases import LIBRARY

SPEC = importlib.util.spec_from_file_location("check_modelica", LIBRARY / "check.py")
check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check)

ANSWERS = """true
true

=== A
Check of A completed successfully.
Class A has 7 equation(s) and 7 variable(s).
4 of these are trivial equation(s).
=== B
Check of B completed successfully.
Class B has 7 equation(s) and 8 variable(s).

=== C
[/C.mo:3:1-3:2:writable] Error: Variable x not found in scope C.

=== f
Check of f completed successfully.

=== A simulated
record SimulationResult
    messages = "LOG_SUCCESS       | info    | The simulation finished successfully."
end SimulationResult;

=== B simulated
record SimulationResult
    messages = "Failed to build model: B"
end SimulationResult;
"""


def test_every_class_is_asked_for():
    names = check.classes()
    assert len(names) == len(set(names)) > 300
    for name in (
        "Sensors.Imu",
        "Sensors.Parts.Imt30.Imu",
        "Effects.GSensitivity.Gyro",
        "Effects.Quantization.Accel",
        "Effects.GSensitivity.gSensitivityOutput",
        "Attitude.AttitudeUkf",
        "Attitude.attitudeUkfSample",
        "Examples.Benches.Lag",
        "Noise.normalByC",
    ):
        assert f"PyImu.{name}" in names
    assert not [n for n in names if n.endswith((".Triad", ".ImportedUnits", ".Drive"))]
    simulated = check.examples(names)
    assert "PyImu.Examples.TurnOnTheSpot" in simulated and len(simulated) == 4
    script = check.script(names, simulated)
    assert "print(checkModel(PyImu.Sensors.Imu));" in script


def test_answers_are_read():
    wanted = ["A", "B", "C", "f", "g", "A simulated", "B simulated"]
    failed = check.failures(ANSWERS, wanted)
    assert list(failed) == ["B", "C", "g", "B simulated"]
    assert "Variable x not found" in failed["C"] and failed["g"] == "nothing was said"
