"""The summary of a campaign as files beside its table."""

from __future__ import annotations

from pyarrow import parquet

from pyimu.files import write_json, write_text
from pyimu.rover.campaign.report.as_json import contents
from pyimu.rover.campaign.report.page import page
from pyimu.rover.campaign.summary import Summary
from pyimu.rover.campaign.table import Folder


def deliver(folder: Folder) -> Summary:
    """Write ``report.json`` and ``report.html`` of the table in a folder."""
    summary = Summary(parquet.read_table(folder.runs))
    write_json(folder.data, contents(folder.settings, summary))
    write_text(folder.page, page(folder.settings, summary))
    return summary
