#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes a report with camera settings, as a report of raw files has them.

python3 -m reports_of_settings REPORT.json NAME.json MEMBER=VALUE...

The members are members of `camera` in the record: iso_speed, black_level, white_level, name and others.
"""

import json
import pathlib
import sys


def main() -> None:
    source, target, *members = sys.argv[1:]
    report = json.loads(pathlib.Path(source).read_text(encoding="utf-8"))
    settings = dict(member.split("=", 1) for member in members)
    report["camera"] = {
        name: float(value) if value.replace(".", "", 1).isdigit() else value for name, value in settings.items()
    }
    pathlib.Path(target).write_text(json.dumps(report), encoding="utf-8")


if __name__ == "__main__":
    main()
