"""A log looked into: its columns and their units, rates, gaps, rests, and the map to read it by."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path

from pyimu.display.silent import silent
from pyimu.errors import Finding, UserError
from pyimu.files import parse_toml, read_toml
from pyimu.inspection.result import Inspection
from pyimu.recording.column_map import ForeignMap, map_of
from pyimu.recording.columns import own_name
from pyimu.recording.folders import log_in
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.suffix import READERS, open_reader, stem
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.guess.proposal import ZEROS, forces, proposed
from pyimu.recording.guess.writing import MapGiven, text_of
from pyimu.recording.known import STATED, Known, is_own, recognised
from pyimu.recording.log import Log
from pyimu.recording.made import with_made_columns
from pyimu.recording.naming.name import named
from pyimu.recording.naming.words import DERIVED, LINEAR
from pyimu.recording.optical import question
from pyimu.recording.quality.false_force import false_force
from pyimu.recording.quality.gyro_axes import gyro_findings
from pyimu.recording.quality.in_pieces import quality
from pyimu.recording.recording import Recording
from pyimu.recording.rest import is_at_rest, rests
from pyimu.recording.rows import Source

Given = str | os.PathLike


def inspect(
    paths: Given | Sequence[Given],
    columns: Given | None = None,
    say: Callable[..., None] = silent,
    sensor: str = "",
) -> Inspection:
    """What is in a log, or in the files of one log, the first of which holds its gyro.

    ``columns`` is a column map that is there already, ``sensor`` the name of that sensor of a table
    with several whose vectors are looked for, as its columns have it. Raises UserError for files
    that are no table of numbers at all; what else keeps a log from being read is in the result,
    with a map by the numbers where it is the header's units.
    """
    given = [Path(paths)] if isinstance(paths, (str, os.PathLike)) else [Path(p) for p in paths]
    data = {} if columns is None else read_toml(Path(columns))
    foreign = None if columns is None else map_of(data, Path(columns))
    asked, by = tuple(given), None if columns is None else Path(columns)
    whole = log_in(given[0]) if len(given) == 1 else None
    if whole is not None:
        given = [whole.path, *(whole.path.parent / name for name, _ in whole.foreign.files)]
        if foreign is None and whole.foreign.columns:
            foreign = whole.foreign
    say("looking at the columns")
    own = foreign or ForeignMap()
    packed = {name: its.binary for name, its in own.files} | {given[0].name: own.binary}
    readers = [open_reader(path, own.topics, packed.get(path.name)) for path in given]
    readers, foreign = _with_made_columns(readers, foreign)
    known = None if foreign is not None or sensor else _recognised(readers[0])
    if foreign is None and known is None and len(readers) == 1:
        readers += [open_reader(given[0], {"imu": topic}) for topic in readers[0].words]
    maps = [
        None if sensor else _own_map(reader, foreign, index) for index, reader in enumerate(readers)
    ]
    kind = "guessed" if sensor else _kind(readers[0], known is not None, foreign is not None)
    guessed = None in maps and (foreign is None or not foreign.columns)
    if guessed:
        kind = "guessed"
    proposals = _proposals(readers, maps, foreign, sensor)
    with_units = kind == "own" or (known is not None and known[0] == STATED)
    if foreign is None and with_units:
        _with_offers(proposals[0], readers[0])
    if known is not None:
        kinds = [_entry(name, own) for name, own in known[1].files]
        data = {"frame": known[1].frame, **({"file": kinds} if kinds else {})}
    map_given = MapGiven(data, given[0].name)
    text = text_of(_ordered(proposals), map_given)
    found = Inspection(given[0], kind, known[0] if known else "", proposals, text)
    found = replace(found, given=asked, given_map=by)
    say("reading")
    if foreign is None and known is not None and len(given) == 1:
        foreign = known[1]
    try:
        recording = (
            _by_guess(readers, proposals, text)
            if guessed or (foreign is None and len(readers) > 1)
            else Log(Source.of(readers[0], foreign or ForeignMap(), proposals[0].holds)).read()
        )
    except UserError as error:
        if with_units:
            found = _by_numbers(found, readers)
        return replace(found, problem=error.bare)
    say("looking for rests")
    return _looked_into(found, recording, map_given)


def _looked_into(found: Inspection, recording: Recording, given: MapGiven) -> Inspection:
    """What is found in the samples of a log; its map with forces in the unit of their gravity."""
    findings = (*gyro_findings(recording), *quality(recording))
    false, text = false_force(findings), found.column_map
    if false is not None:
        right = [_in_right_unit(p, false) for p in found.proposals]
        text = text_of(_ordered(right), given)
    return replace(
        found,
        recording=recording,
        column_map=text,
        findings=findings,
        rests=rests(recording),
        still=is_at_rest(recording),
    )


def _in_right_unit(proposal: Proposal, false: Finding) -> Proposal:
    """What is proposed, the forces in the unit that their gravity shows."""
    right, stated = false.detail["as"], false.detail["stated"]
    why = f"by its gravity; the header says {stated}"
    guesses = [
        replace(g, unit=right, why=why) if g.group == "accel" and g.value is None else g
        for g in proposal.guesses
    ]
    return replace(proposal, guesses=guesses)


def _entry(name: str, own: ForeignMap) -> dict[str, object]:
    """What a column map says of a further file, or of further rows of the same one."""
    return {"name": name, "topic": own.topics["imu"], "columns": dict(own.columns)}


def _with_made_columns(
    readers: Sequence[Reader], foreign: ForeignMap | None
) -> tuple[list[Reader], ForeignMap | None]:
    """The readers, with the columns that are made of two, and the map with the time of them."""
    first, own = with_made_columns(readers[0], foreign or ForeignMap())
    files, others = dict(own.files), []
    for reader in readers[1:]:
        name = reader.path.name
        other, its = with_made_columns(reader, files.get(name, ForeignMap()))
        others.append(other)
        if name in files:
            files[name] = its
    return [first, *others], foreign and replace(own, files=tuple(files.items()))


def _ordered(proposals: Sequence[Proposal]) -> list[Proposal]:
    """That with the gyro first: the log's times are those of its gyro."""
    return sorted(proposals, key=lambda p: "gyro" not in p.groups)


def _kind(reader: Reader, known: bool, mapped: bool) -> str:
    """How it is known what the columns are."""
    if mapped:
        return "map"
    if known:
        return "known"
    return "own" if is_own(reader.header) else "guessed"


def _recognised(
    reader: Reader, rate: float | None = None, given: ForeignMap | None = None
) -> Known | None:
    """What is known of a log, None also of counts whose size neither it nor a ``given`` map says:
    their numbers may.
    """
    known = recognised(reader, rate=rate)
    counts = known is not None and any("[count]" in c for c in known[1].columns.values())
    sized = known is not None and bool(known[1].scale or (given and given.scale))
    return None if counts and not sized else known


def _own_map(reader: Reader, foreign: ForeignMap | None, index: int) -> ForeignMap | None:
    """The columns that are declared for the file of number ``index``, None where none are."""
    if foreign is not None and foreign.columns:
        return foreign if index == 0 else (dict(foreign.files).get(reader.path.name))
    known = _recognised(reader, None if foreign is None else foreign.rate, foreign)
    if known is not None:
        return known[1]
    if is_own(reader.header):
        return ForeignMap(columns={cell: cell for cell in reader.header if own_name(cell)})
    return None


def _declared(reader: Reader, foreign: ForeignMap) -> Proposal:
    """What a map, a format's definition or the header itself says of the columns."""
    found = Proposal(reader.path, tuple(reader.header))
    for cell, target in foreign.named(reader.header).items():
        name = own_name(target)
        if name is not None and cell in reader.header:
            unit = target.partition("[")[2].rstrip("] ")
            size = foreign.scale.get(name) if unit == "count" else None
            value = None if size is None else size.value
            said = unit if size is None else size.unit.text
            found.add([Guess(cell, name, said, "declared", value)])
    if "time" not in found.groups:
        found.rate = foreign.rate or reader.rate
    return found


def _proposals(
    readers: Sequence[Reader],
    maps: Sequence[ForeignMap | None],
    foreign: ForeignMap | None,
    sensor: str,
) -> list[Proposal]:
    """What is declared, or else guessed, of each file's columns.

    Of a gyro whose unit its own file does not tell the accelerometer of another one may.
    """
    rate = None if foreign is None else foreign.rate
    found = [
        proposed(reader, rate, sensor=sensor)
        if own is None
        else _declared(reader, replace(own, rate=own.rate or rate))
        for reader, own in zip(readers, maps, strict=True)
    ]
    asked = [
        k
        for k, own in enumerate(maps)
        if own is None and "accel" not in found[k].groups and "gyro" in found[k].open_questions
    ]
    if asked:
        forces_of = (forces(r, p) for r, p in zip(readers, found, strict=True))
        beside = next((force for force in forces_of if force is not None), None)
        for k in asked if beside is not None else ():
            found[k] = proposed(readers[k], rate, beside, sensor)
    if foreign is None:
        _once(_ordered(found))
    else:
        for proposal in found:
            proposal.guesses = [_sized(guess, foreign) for guess in proposal.guesses]
    return found


def _with_offers(found: Proposal, reader: Reader) -> None:
    """Add what the columns may be that a header with units says nothing of."""
    try:
        guessed = proposed(reader)
    except UserError:
        return
    taken = {g.cell for g in found.guesses}
    for offer in guessed.offers:
        if not taken & {g.cell for g in offer.guesses}:
            found.offer(offer.note, offer.guesses)
    left = [g for g in guessed.guesses if g.cell not in taken and g.group not in found.groups]
    for group in dict.fromkeys(g.group for g in left):
        own = [g for g in left if g.group == group]
        cells = ", ".join(g.cell for g in own)
        verb = "is" if len(own) == 1 else "are"
        found.offer(f"{cells} {verb} left out: {', '.join(g.target for g in own)}?", own)


def _once(proposals: Sequence[Proposal]) -> None:
    """Leave out what an earlier file of the log holds, such as a temperature in each of them."""
    there: set[str] = set()
    for proposal in proposals:
        twice = there & set(proposal.groups) - {"gyro", "accel"}
        proposal.guesses = [g for g in proposal.guesses if g.group not in twice]
        there |= set(proposal.groups) - {"time"}


def _sized(guess: Guess, foreign: ForeignMap) -> Guess:
    """The guess with the size of a count that a map gives, where its unit is not known else."""
    size = foreign.scale.get(guess.target)
    if size is None or (guess.unit is not None and guess.value is None):
        return guess
    why = "the column map gives the size of a count"
    return replace(guess, unit=size.unit.text, value=size.value, sizes=(), why=why)


def _by_numbers(found: Inspection, readers: Sequence[Reader]) -> Inspection:
    """The same with what the numbers say of the columns, where they say something of all.

    It is a guess where they say another unit of the time than the header, or ask for one.
    """
    try:
        guesses = [proposed(reader) for reader in readers]
    except UserError:
        return found
    both = list(zip(found.proposals, guesses, strict=True))
    if any(set(p.groups) - set(g.groups) for p, g in both):
        return found
    if any(g.open_questions or p.units.get("time") != g.units.get("time") for p, g in both):
        found = replace(found, kind="guessed", format="")
    return replace(found, proposals=guesses, column_map=text_of(_ordered(guesses)))


def _no_times(reader: Reader) -> str:
    """Which columns are called times and are none."""
    numeric = reader.numeric()
    there = [c for k, c in enumerate(reader.header) if named(c).is_time and k not in numeric]
    if not there:
        return ""
    return f": {', '.join(there)} has no numbers, dates with times or times of day"


MOST_SEEN = 1000
"""Files of a folder that are looked at for an accelerometer's."""


def _accelerometer_beside(given: Sequence[Path]) -> str:
    """What to add of a gyro whose unit nothing tells: the accelerometer's file of the same log."""
    if len(given) > 1:
        return ""
    for path in sorted(islice(given[0].parent.iterdir(), MOST_SEEN)):
        name = named(stem(path))
        whole = name.of("accel") > 1 and not set(name.words) & (LINEAR | DERIVED)
        if whole and path != given[0] and path.name.lower().endswith(tuple(READERS)):
            files = shlex.join(map(str, (given[0], path)))
            return f", or let the accelerometer beside it tell: pyimu inspect {files}"
    return ""


def _by_guess(readers: Sequence[Reader], proposals: Sequence[Proposal], text: str) -> Recording:
    """The log by the map that was written."""
    order = sorted(range(len(readers)), key=lambda k: "gyro" not in proposals[k].groups)
    reader, first = readers[order[0]], proposals[order[0]]
    unknown = [group for p in proposals for group in p.open_questions]
    seen = {group for group in first.groups if group.startswith("ref_")}
    seen = seen if first.holds == "reference" else {"gyro", "accel"} & set(first.groups)
    if not seen and "time" not in unknown:
        if asked := question(reader):
            raise UserError(f"{reader.path}: {asked}")
        raise UserError(
            f"{reader.path}: no column is known for a gyro's, an accelerometer's or a reference's: "
            "name them in the map"
        )
    zeros = [g.group for p in proposals for g in p.guesses if g.why == ZEROS]
    if seen and seen <= set(zeros):
        empty = " and ".join(dict.fromkeys(zeros))
        raise UserError(f"{reader.path}: {empty}: every number is zero, there is nothing to read")
    if "time" in unknown or seen <= set(unknown):
        asked = " and ".join(dict.fromkeys(unknown))
        more = _accelerometer_beside([r.path for r in readers]) if "gyro" in unknown else ""
        raise UserError(
            f"{reader.path}: nothing tells the unit of {asked}: choose it in the map{more}"
        )
    if first.timeless:
        raise UserError(
            f"{reader.path}: nothing tells when its samples were taken{_no_times(reader)}"
        )
    foreign = map_of(parse_toml(text, "map"), Path("the map that was written"))
    return Log(Source.of(reader, foreign, first.holds)).read()
