# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that the Python blocks of README.md and documentation/ run, and print the output that is shown there."""

import os
import re
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "test"))

from check_documents import all_documents, check  # noqa: E402 - it is in test/

PAGES = [path for path in all_documents() if re.search("^```python$", path.read_text(encoding="utf-8"), re.MULTILINE)]
PROGRAMS = Path(os.environ.get("SENSORNOISE_BIN", SOURCE / "build" / "bin"))


def test_documents_have_python_blocks():
    assert len(PAGES) >= 10


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_python_blocks(path):
    if not (PROGRAMS / "estimate-sensor-noise").exists():
        pytest.skip(f"no estimate-sensor-noise in {PROGRAMS}; set SENSORNOISE_BIN")
    document, _ = check(path, PROGRAMS, sys.executable)
    assert not document.failures, "\n".join(document.failures)
    assert document.blocks > 0
