#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Summarises the results that GoogleTest programs left in a folder: how many tests passed, failed and were skipped, why
they were skipped, and which suites took longest.

    summarise_tests.py FOLDER [--longest N] [--names]

FOLDER has one XML file per suite, as cmake/TestsBySuite.cmake asks for. --names prints the name of every test that ran
instead. Exit code 1 if a test failed or no test ran.
"""

import argparse
import collections
import pathlib
import sys
import xml.etree.ElementTree as ET


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--longest", type=int, default=0, metavar="N", help="list the N suites that took longest")
    parser.add_argument("--names", action="store_true", help="list the tests instead")
    options = parser.parse_args()

    seconds: collections.Counter[str] = collections.Counter()
    skipped: collections.defaultdict[str, list[str]] = collections.defaultdict(list)
    names = []
    failed = 0
    for file in sorted(options.folder.rglob("*.xml")):
        for case in ET.parse(file).getroot().iter("testcase"):
            if case.get("status") == "notrun":
                continue
            name = f"{case.get('classname')}.{case.get('name')}"
            names.append(name)
            seconds[file.stem] += float(case.get("time", 0))
            if case.find("failure") is not None:
                failed += 1
            elif (skip := case.find("skipped")) is not None:
                skipped[skip.get("message", "").split("\n", 1)[-1].strip()].append(name)
    if options.names:
        print("\n".join(sorted(names)))
        return 0 if names else 1
    for reason, tests in sorted(skipped.items()):
        print(f"skipped, {reason}: {', '.join(tests)}")
    for name, took in seconds.most_common(options.longest):
        print(f"{took:8.1f} s  {name}")
    count = sum(map(len, skipped.values()))
    print(f"{len(names) - failed - count} passed, {failed} failed, {count} skipped")
    return 1 if failed or not names else 0


if __name__ == "__main__":
    sys.exit(main())
