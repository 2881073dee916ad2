# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""What estimate_many() made of many bursts: its table, and the file of what was measured."""

import json

NAMES = ["a", "b", "c"]


def rows_of(table):
    """The rows as dicts, whatever holds them."""
    if isinstance(table, list):
        return table
    rows = table.astype(object).where(table.notna(), None).to_dict("records")
    return [{str(name): value for name, value in row.items()} for row in rows]


def lines_of(name):
    return [json.loads(line) for line in name.read_text().splitlines()]
