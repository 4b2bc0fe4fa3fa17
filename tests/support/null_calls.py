"""Each function of a unit called with NULL for each of its pointers: ``python null_calls.py FMU``.

What the functions are, the standard's own header says. Each call is made of an instance of its own,
in the phase in which the function is allowed, first with good arguments throughout. Prints a line
for each call, before it is made and with what it answered, so that the last line names a crash.
"""

import math
import re
import sys
import tempfile
from ctypes import (
    CDLL,
    POINTER,
    addressof,
    c_bool,
    c_double,
    c_int,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
    cast,
    create_string_buffer,
)
from pathlib import Path

from fmpy import extract, platform_tuple, read_model_description, sharedLibraryExtension
from fmpy import platform as fmi2_platform

from pyimu.fmu.build import header_folder

ROOM = 1 << 16
"""Bytes behind each pointer: more than any call here writes."""

OPAQUE = (
    *("Instance", "Component", "FMUState", "FMUstate", "String", "Environment", "Callback"),
    *("Binary", "IntermediateUpdateCallback"),
)
"""How names of types end that are pointers by themselves."""

IN_PHASE = {
    "SetupExperiment": "instantiated",
    "EnterInitializationMode": "instantiated",
    "EnterConfigurationMode": "instantiated",
    "ExitConfigurationMode": "configuration",
    "ExitInitializationMode": "initialization",
}
"""All others are called after a step can be made."""


NAMES = {
    ("Instantiate", 1): "fmuType",
    ("Instantiate", 2): "fmuGUID",
    ("DoStep", 2): "communicationStepSize",
}
"""Names of arguments that FMI 2's header leaves out, where their value matters."""


class Argument:
    """An argument of a function: ``type``, ``name``, and whether it is a pointer."""

    def __init__(self, function, at, text):
        words = text.replace("*", " * ").replace("[]", " * ").split()
        self.type, *names = (word for word in words if word not in ("const", "*"))
        self.name = names[0] if names else NAMES.get((function, at), f"{self.type}-{at}")
        self.stars = words.count("*")
        self.is_pointer = bool(self.stars) or self.type.endswith(OPAQUE)


def functions(version):
    """The arguments of each function of the header, by its name without prefix."""
    header = (header_folder() / f"fmi{version}FunctionTypes.h").read_text(encoding="latin-1")
    header = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    pattern = rf"typedef\s+([\w\s*]+?)\s*\bfmi{version}(\w+)TYPE\s*\(([^)]*)\)\s*;"
    for result, name, inside in re.findall(pattern, header):
        texts = [" ".join(text.split()) for text in inside.split(",")]
        texts = [text for text in texts if text not in ("", "void")]
        yield name, result, [Argument(name, at, text) for at, text in enumerate(texts)]


class Unit:
    """The library of a unit, and an instance of it that can step, with a state of it."""

    def __init__(self, path):
        self.description = read_model_description(path)
        self.version = int(self.description.fmiVersion[0])
        system = fmi2_platform if self.version == 2 else platform_tuple
        name = self.description.coSimulation.modelIdentifier + sharedLibraryExtension
        self.library = CDLL(str(Path(extract(path, tempfile.mkdtemp()), "binaries", system, name)))
        self.functions = {name: (result, each) for name, result, each in functions(self.version)}
        self.kept = []  # memory that the library may still look at
        self.instance = self.state = self.size = None

    def call(self, name, values):
        result, arguments = self.functions[name]
        function = self.library[f"fmi{self.version}{name}"]
        function.restype = c_int if result.endswith("Status") else c_void_p
        function.argtypes = [self.kind(argument) for argument in arguments]
        return function(*values)

    def kind(self, argument):
        """The type of ctypes."""
        if argument.is_pointer:
            return c_void_p
        endings = {"Boolean": c_int if self.version == 2 else c_bool, "Real": c_double}
        endings |= {"Float64": c_double, "size_t": c_size_t, "ValueReference": c_uint32}
        return next((kind for end, kind in endings.items() if argument.type.endswith(end)), c_int)

    def run(self, name):
        """A call with good arguments."""
        return self.call(name, self.good(name))

    def good(self, name):
        return [self.value(name, argument) for argument in self.functions[name][1]]

    def room(self, content=b""):
        """The address of memory that begins with ``content``."""
        buffer = create_string_buffer(bytes(content), ROOM)
        self.kept.append(buffer)
        return addressof(buffer)

    def value(self, name, a):
        """A value for an argument that the function takes."""
        if a.type.endswith(("Environment", "Callback")):
            return None
        if a.type.endswith(("Instance", "Component")):
            return self.instance
        if a.type.endswith(("FMUState", "FMUstate")):
            new = name.startswith(("Get", "De"))
            return self.state if not a.stars else self.room(b"" if new else c_uint64(self.state))
        if a.type.endswith("String"):
            token = self.description.guid if "oken" in a.name or "GUID" in a.name else "logEvents"
            text = self.room(token.encode())
            return self.room(c_uint64(text)) if a.stars else text
        if a.type.endswith("ValueReference") and a.stars:
            return self.room(c_uint32(self.variable(name)[0]))
        if a.type.endswith("Byte") and name.startswith("De"):
            return self.bytes_of_state()
        return self.room() if a.is_pointer else self.number(name, a)

    def number(self, name, a):
        if a.type.endswith(("Boolean", "Status", "StatusKind")) or "olerance" in a.name:
            return 0
        if a.type == "size_t" and "erialize" in name:
            return self.size
        if a.name == "nValues":
            return self.variable(name)[1]
        return {"fmuType": 1, "communicationStepSize": 1.0, "stopTime": 9.0}.get(
            a.name, 0.0 if self.kind(a) is c_double else 1
        )

    def variable(self, name):
        """Reference and number of values of a variable of the function's type that can be set."""
        for variable in self.description.modelVariables:
            if variable.type == name[3:] and variable.causality == "input":
                return variable.valueReference, self.count(variable)
        seeds = [v for v in self.description.modelVariables if v.name == "seed"]
        return (seeds[0].valueReference if name[3:] == "UInt64" else 0), 1

    def count(self, variable):
        """How many values it has as it starts."""
        sizes = {v.valueReference: v.start for v in self.description.modelVariables}
        each = [d.start or sizes[d.valueReference] for d in getattr(variable, "dimensions", ())]
        return math.prod(map(int, each))

    def bytes_of_state(self):
        where = self.room()
        name = "SerializeFMUstate" if self.version == 2 else "SerializeFMUState"
        self.call(name, [self.instance, self.state, where, self.size])
        return where

    def begin(self, until):
        """A new instance, in the phase ``until``."""
        self.instance = self.state = self.size = None
        instantiate = "Instantiate" if self.version == 2 else "InstantiateCoSimulation"
        self.instance = self.run(instantiate)
        steps = ["SetupExperiment"] * (self.version == 2)
        steps += ["EnterInitializationMode", "ExitInitializationMode"]
        if until == "configuration":
            self.run("EnterConfigurationMode")
        stop = {"instantiated": 0, "configuration": 0, "initialization": len(steps) - 1}
        for step in steps[: stop.get(until, len(steps))]:
            assert self.run(step) == 0, step
        if until == "stepping":
            self.keep_state()

    def keep_state(self):
        where = self.room()
        state, size = ("FMUstate", "Size") if self.version == 2 else ("FMUState", "Size")
        assert self.call(f"Get{state}", [self.instance, where]) == 0
        self.state = cast(where, POINTER(c_uint64))[0]
        assert self.call(f"Serialized{state}{size}", [self.instance, self.state, where]) == 0
        self.size = cast(where, POINTER(c_uint64))[0]


def told(what, answer):
    print(what, end=" ", flush=True)
    print(answer(), flush=True)


def main():
    unit = Unit(sys.argv[1])
    for name, (_, arguments) in unit.functions.items():
        phase = IN_PHASE.get(name, "stepping")
        unit.begin(phase)
        told(f"{name} -", lambda name=name: unit.run(name))
        for at, argument in enumerate(arguments):
            if argument.is_pointer:
                unit.begin(phase)
                values = unit.good(name)
                values[at] = None
                told(f"{name} {argument.name}", lambda n=name, v=values: unit.call(n, v))


if __name__ == "__main__":
    main()
