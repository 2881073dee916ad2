#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs step_by_step.ipynb from top to bottom, as continuous integration does.

    run_notebook.py executed.ipynb

Writes the notebook with its pictures. The exit code is 1 if a cell raises an exception, or if a cell tagged "figure"
shows no picture. Needs nbclient, nbformat, ipykernel and matplotlib.
"""

import argparse
import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError


def cells_without_figure(notebook: nbformat.NotebookNode) -> list[int]:
    """Returns the numbers of the cells that are tagged "figure" but show no picture."""
    return [
        number
        for number, cell in enumerate(notebook.cells)
        if "figure" in cell.metadata.get("tags", [])
        and not any("image/png" in output.get("data", {}) for output in cell.outputs)
    ]


def main() -> int:
    """Returns the exit code: 0 all ran, 1 an error or a missing figure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path, help="the executed notebook (.ipynb)")
    parser.add_argument(
        "--notebook", type=Path, default=Path(__file__).with_name("step_by_step.ipynb"), help="another notebook"
    )
    arguments = parser.parse_args()

    notebook = nbformat.read(arguments.notebook, as_version=4)
    start = time.perf_counter()
    client = NotebookClient(notebook, timeout=300, kernel_name="python3")
    try:
        client.execute(cwd=str(arguments.notebook.parent))
    except CellExecutionError as error:
        print(f"{arguments.notebook.name}: {error}", file=sys.stderr)
        return 1
    finally:
        nbformat.write(notebook, arguments.output)

    figures = sum("figure" in cell.metadata.get("tags", []) for cell in notebook.cells)
    missing = cells_without_figure(notebook)
    if missing or figures == 0:
        what = f"no picture from cell {', '.join(map(str, missing))}" if missing else 'no cell is tagged "figure"'
        print(f"{arguments.notebook.name}: {what}", file=sys.stderr)
        return 1
    print(f"{arguments.notebook.name}: {figures} figures in {time.perf_counter() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
