# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads the results of estimate_many(): its table, and the file of measured bursts."""

import json

NAMES = ["a", "b", "c"]


def rows_of(table):
    """Returns the rows of the table as dicts, for any type of table."""
    if isinstance(table, list):
        return table
    rows = table.astype(object).where(table.notna(), None).to_dict("records")
    return [{str(name): value for name, value in row.items()} for row in rows]


def lines_of(name):
    return [json.loads(line) for line in name.read_text().splitlines()]
