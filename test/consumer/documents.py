#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the C++ project that the documents show into a folder, as it stands: documents.py FOLDER DOCUMENT...

Its CMakeLists.txt is the cmake block, measure.cxx the cpp block with a main function. The other cpp blocks, for which
the documents show no project, are added to that target.
"""

import pathlib
import re
import sys


def main() -> None:
    folder, *documents = map(pathlib.Path, sys.argv[1:])
    blocks = [
        block
        for document in documents
        for block in re.findall(r"^```(cpp|cmake)\n(.*?)^```$", document.read_text(), re.DOTALL | re.MULTILINE)
    ]
    programs = [text for kind, text in blocks if kind == "cpp" and "main(" in text]
    others = [text for kind, text in blocks if kind == "cpp" and "main(" not in text]
    projects = [text for kind, text in blocks if kind == "cmake"]
    if len(programs) != 1 or len(projects) != 1:
        sys.exit(f"{len(programs)} programs and {len(projects)} CMakeLists.txt in the documents; expected one of each")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "measure.cxx").write_text(programs[0])
    added = [f"target_sources(measure PRIVATE block{number}.cxx)\n" for number in range(len(others))]
    (folder / "CMakeLists.txt").write_text(projects[0] + "".join(added))
    for number, text in enumerate(others):
        (folder / f"block{number}.cxx").write_text(text)


if __name__ == "__main__":
    main()
