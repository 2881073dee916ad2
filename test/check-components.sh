#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Checks that a component of the module includes only components that stand above it in the table of module/README.md. A
# public header belongs to the component that has the source of the same name; every component may include one without such a
# source. Public headers, and the headers of the filters, include no private ones; module/README.md lists all public headers.
# Prints the includes from component to component, and how many of the module's headers a header pulls in. No two headers
# define types of one name: the linker would keep the inline functions of one of them, such as the destructor, for both.
set -euo pipefail
cd "$(dirname "$0")/../module/src"
python3 - <<'PY'
import collections, pathlib, re, statistics, sys

private = sorted(p for p in pathlib.Path(".").glob("*/*") if p.suffix in (".h", ".cxx"))
public = sorted(pathlib.Path("../include/sensornoise").glob("*.h"))
room_of = {p.as_posix(): p.parts[0] for p in private}
for header in public:
    room_of[f"sensornoise/{header.name}"] = next((p.parts[0] for p in private if p.name == f"{header.stem}.cxx"), None)
pattern = r'#include "(\w+/\w+\.h)"'
includes = {p.as_posix(): re.findall(pattern, p.read_text()) for p in private}
includes |= {f"sensornoise/{p.name}": re.findall(pattern, p.read_text()) for p in public}
arrows = collections.Counter(
    (room_of[name], room_of[other]) for name, others in includes.items() for other in others
    if room_of[name] and room_of[other])
components = {}
for (a, b), count in sorted(arrows.items()):
    if a != b:
        components.setdefault(a, {})[b] = count
order = re.findall(r"^\| `(\w+)` \|", pathlib.Path("../README.md").read_text(), re.M)
for component in sorted({p.parts[0] for p in private}, key=order.index):
    used = ", ".join(f"{other} {count}" for other, count in components.get(component, {}).items())
    print(f"{component:11} -> {used or 'nothing'}")


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
readme = pathlib.Path("../README.md").read_text()
wrong = [f"{name} includes {other}, which is private" for name, others in includes.items() for other in others
         if name.startswith("sensornoise/") and not other.startswith("sensornoise/")]
for p in sorted(pathlib.Path("../../filters").glob("*.h*")):
    wrong += [f"filters/{p.name} includes {other}, which is private" for other in re.findall(r'#include "([^"]+)"', p.read_text())
              if (pathlib.Path("../../filters/src") / other).exists() or pathlib.Path(other).exists()]
listed = set(re.findall(r"^\| `(\w+\.h)` \|", readme, re.M))
wrong += [f"module/README.md and module/include/sensornoise differ in {name}" for name in listed ^ {p.name for p in public}]
types = collections.defaultdict(set)
definition = re.compile(r"^(?:struct|class|enum class) (?:SensorNoise_EXPORT )?(\w+)(?!\w|::)[^;{()]*\{", re.M)
for p in [p for p in private if p.suffix == ".h"] + public:
    for name in definition.findall(re.sub(r"/\*.*?\*/|//[^\n]*", "", p.read_text(), flags=re.S)):
        types[name].add(p.as_posix())
wrong += [f"{' and '.join(sorted(headers))} define {name}" for name, headers in types.items() if len(headers) > 1]
if wrong:
    sys.exit("\n".join(wrong))
back = [f"{a} -> {b}" for a, others in components.items() for b in others if order.index(b) >= order.index(a)]
if back:
    sys.exit("arrows run back: " + ", ".join(back))
PY
