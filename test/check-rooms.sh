#!/usr/bin/env bash
# Checks that arrows between the module's rooms go one way, and prints them with the number of includes, and how many of
# the module's headers the files pull in: the deepest and the median one.
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
for room in sorted({p.parts[0] for p in files}):
    used = ", ".join(f"{other} {count}" for other, count in rooms.get(room, {}).items())
    print(f"{room:11} -> {used or 'nothing'}")


def circle(room, path):
    if room in path:
        return path[path.index(room):] + [room]
    return next((found for other in rooms.get(room, {}) if (found := circle(other, path + [room]))), None)


found = next((c for room in rooms if (c := circle(room, []))), None)


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
if found:
    sys.exit("arrows run back: " + " -> ".join(found))
PY
