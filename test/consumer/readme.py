#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the project that README.md shows under "In C++" into a folder, as it stands: readme.py README.md FOLDER.

Its CMakeLists.txt is the cmake block, measure.cxx the cpp block with a main function. The other cpp blocks, of which
the README shows no project, are added to that target.
"""

import pathlib
import re
import sys


def main():
    readme, folder = map(pathlib.Path, sys.argv[1:])
    blocks = re.findall(r"^```(cpp|cmake)\n(.*?)^```$", readme.read_text(), re.DOTALL | re.MULTILINE)
    programs = [text for kind, text in blocks if kind == "cpp" and "main(" in text]
    others = [text for kind, text in blocks if kind == "cpp" and "main(" not in text]
    projects = [text for kind, text in blocks if kind == "cmake"]
    if len(programs) != 1 or len(projects) != 1:
        sys.exit(f"{readme}: {len(programs)} programs and {len(projects)} CMakeLists.txt; expected one of each")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "measure.cxx").write_text(programs[0])
    added = [f"target_sources(measure PRIVATE block{number}.cxx)\n" for number in range(len(others))]
    (folder / "CMakeLists.txt").write_text(projects[0] + "".join(added))
    for number, text in enumerate(others):
        (folder / f"block{number}.cxx").write_text(text)


if __name__ == "__main__":
    main()
