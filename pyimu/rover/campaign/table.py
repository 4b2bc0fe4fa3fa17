"""A campaign's files: parts as they come, and the table in the order of the runs.

The folder has ``campaign.json``, what the campaign is; ``parts``, one file for each batch of runs,
each written whole or not at all; and ``runs.parquet``, made of the parts in order, so that it does
not depend on who computed them, and when.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa
from pyarrow import parquet

from pyimu.errors import UserError
from pyimu.files import check_folder, plain, whole, write_json
from pyimu.rover.campaign.made_by import made_by
from pyimu.rover.campaign.score import Row
from pyimu.rover.campaign.settings import Settings

BATCH = 20
"""Runs of a part file, and of what a worker takes at a time."""

GROUP = 10_000
"""Rows of a row group of the table, whatever the parts are."""

KEY = b"pyimu.campaign"
"""Under this a file's metadata have the campaign's key."""


@dataclass(frozen=True)
class Folder:
    """The folder ``path`` of a campaign."""

    path: Path
    settings: Settings

    @property
    def runs(self) -> Path:
        return self.path / "runs.parquet"

    @property
    def page(self) -> Path:
        return self.path / "report.html"

    @property
    def data(self) -> Path:
        return self.path / "report.json"

    def check(self) -> None:
        """Raise UserError where the folder holds another campaign, or cannot be written to."""
        check_folder(self.path)
        about, mine = self.path / "campaign.json", described(self.settings)
        if about.exists():
            try:
                there = json.loads(about.read_text(encoding="utf-8"))
            except (OSError, ValueError):
                there = {}
            if there.get("key") != mine["key"]:
                raise UserError(
                    f"{self.path}: holds another campaign ({_difference(there, mine)}); give "
                    "another folder with --out"
                )
            return
        if self.path.is_dir() and (self.runs.exists() or (self.path / "parts").exists()):
            raise UserError(
                f"{self.path}: has runs and no campaign.json that says of which campaign; give "
                "another folder with --out"
            )

    def claim(self) -> None:
        """Say in the folder which campaign it holds."""
        write_json(self.path / "campaign.json", described(self.settings))

    def part(self, batch: range) -> Path:
        return self.path / "parts" / f"{batch.start:09d}-{batch[-1]:09d}.parquet"

    def missing(self, runs: int) -> list[range]:
        """The batches whose part is not there or cannot be read."""
        return [batch for batch in batches(runs) if not self._is_there(batch)]

    def _is_there(self, batch: range) -> bool:
        path = self.part(batch)
        if not path.is_file():
            return False
        try:
            with parquet.ParquetFile(path) as file:
                metadata = file.schema_arrow.metadata or {}
                return file.metadata.num_rows == len(batch) and metadata.get(KEY) == self._key()
        except (OSError, pa.ArrowException):
            return False

    def keep(self, batch: range, rows: Sequence[Row]) -> None:
        """Write the part of a batch."""
        table = pa.Table.from_pylist(list(rows)).replace_schema_metadata({KEY: self._key()})
        with whole(self.part(batch)) as unfinished:
            parquet.write_table(table, unfinished)

    def finish(self, runs: int) -> Path:
        """Write the table of the runs from 0 on; all parts must be there."""
        with whole(self.runs) as unfinished:
            writer = None
            try:
                for table in _groups(parquet.read_table(self.part(b)) for b in batches(runs)):
                    writer = writer or parquet.ParquetWriter(unfinished, table.schema)
                    writer.write_table(table, row_group_size=GROUP)
            finally:
                if writer is not None:
                    writer.close()
        return self.runs

    def _key(self) -> bytes:
        return described(self.settings)["key"].encode()


def batches(runs: int) -> list[range]:
    """The runs from 0 to ``runs`` - 1 in batches."""
    return [range(first, min(first + BATCH, runs)) for first in range(0, runs, BATCH)]


def described(settings: Settings) -> dict:
    """What ``campaign.json`` says: the settings, the code that makes the runs, a key of both."""
    code = made_by()
    return plain({"key": f"{settings.key()}-{code}", "version": code, **settings.contents()})


def _difference(there: dict, mine: dict) -> str:
    """The first setting in which two campaigns differ, in words."""
    for name, value in mine.items():
        if name != "key" and there.get(name) != value:
            if name == "part":
                return "of another part"
            return f"its {name} is {there.get(name)}, not {value}"
    return "of another key"


def _groups(tables: Iterator[pa.Table]) -> Iterator[pa.Table]:
    """The rows of ``tables`` in order, ``GROUP`` of them in each table but the last."""
    waiting = None
    for table in tables:
        waiting = table if waiting is None else pa.concat_tables([waiting, table])
        while len(waiting) >= GROUP:
            yield waiting[:GROUP].combine_chunks()
            waiting = waiting[GROUP:]
    if waiting is not None and len(waiting):
        yield waiting.combine_chunks()
