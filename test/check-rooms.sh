#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Checks that a room of the module includes only rooms that stand above it in the table of module/README.md. Prints the
# arrows between the rooms, with the number of includes, and how many of the module's headers the headers pull in.
set -euo pipefail
cd "$(dirname "$0")/../module/sensornoise"
python3 - <<'PY'
import collections, pathlib, re, statistics, sys

files = sorted(p for p in pathlib.Path(".").glob("*/*") if p.suffix in (".h", ".cxx"))
includes = {str(p): re.findall(r'#include "sensornoise/([^"]+)"', p.read_text()) for p in files}
arrows = collections.Counter(
    (name.split("/")[0], other.split("/")[0]) for name, others in includes.items() for other in others)
rooms = {}
for (a, b), count in sorted(arrows.items()):
    if a != b:
        rooms.setdefault(a, {})[b] = count
order = re.findall(r"^\| `(\w+)` \|", pathlib.Path("../README.md").read_text(), re.M)
for room in sorted({p.parts[0] for p in files}, key=order.index):
    used = ", ".join(f"{other} {count}" for other, count in rooms.get(room, {}).items())
    print(f"{room:11} -> {used or 'nothing'}")


def pulled(name, seen):
    for other in includes.get(name, []):
        if other not in seen:
            seen.add(other)
            pulled(other, seen)
    return seen


depths = {name: len(pulled(name, set()) - {name}) for name in includes if name.endswith(".h")}
deepest = max(depths, key=depths.get)
print(f"{len(depths)} headers; a header pulls in {statistics.median(depths.values()):g} others (median), "
      f"at most {depths[deepest]} ({deepest})")
back = [f"{a} -> {b}" for a, others in rooms.items() for b in others if order.index(b) >= order.index(a)]
if back:
    sys.exit("arrows run back: " + ", ".join(back))
PY
