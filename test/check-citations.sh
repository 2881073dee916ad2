#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Checks that comments which cite the derivation, as "Estimator.md, 3.5", name a section that documentation/method/estimator.md has,
# and that the files which it names exist. Prints how often each section is cited.
set -euo pipefail
cd "$(dirname "$0")/.."
python3 - <<'PY'
import collections, pathlib, re, sys

text = pathlib.Path("documentation/method/estimator.md").read_text(encoding="utf-8")
sections = dict(re.findall(r"^#+ (\d+(?:\.\d+)*) (.*)$", text, re.M))
number = r"\d+(?:\.\d+)*"
cited = re.compile(rf"[Ee]stimator\.md(?:,? (?P<sections>{number}(?:(?:, | and | to ){number})*))?")
citations = collections.Counter()
wrong = []
for folder in ("module", "filters", "examples", "wrapping", "test"):
    for path in sorted(p for p in pathlib.Path(folder).rglob("*") if p.suffix in (".h", ".hxx", ".cxx", ".py", ".wrap")):
        # A citation may be parted at the end of a line of a comment.
        source = re.sub(r"\s*\n[ \t]*(?://+|\*(?!/)|#)?[ \t]*", " ", path.read_text(encoding="utf-8"))
        for match in cited.finditer(source):
            found = re.findall(number, match["sections"] or "")
            citations.update(found)
            wrong += [f"{path} cites section {s}, which documentation/method/estimator.md has not" for s in found if s not in sections]
            if not found:
                wrong.append(f"{path} cites estimator.md without a section; expected one, as \"Estimator.md, 3.5\"")
for name in sorted(set(re.findall(r"`(\w+/\w+\.(?:h|cxx))`", text))):
    if not any(pathlib.Path(folder, name).is_file() for folder in ("module/src", "module/include")):
        wrong.append(f"documentation/method/estimator.md names {name}, which module/src and module/include do not have")
if not citations:
    wrong.append("no comment cites estimator.md; expected some")
for section, title in sections.items():
    print(f"{section:5} {citations[section]:3}  {title}")
if wrong:
    sys.exit("\n".join(wrong))
PY
