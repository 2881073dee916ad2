# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the page of a folder as one file, which browsers open from the disk: its worker is text in the page."""

import base64
import sys
from pathlib import Path


def joined(site: Path) -> str:
    """Returns the page with its style, its scripts, its worker and the library in base 64."""
    page = (site / "index.html").read_text()
    wasm = base64.b64encode((site / "sensor-noise.wasm").read_bytes()).decode()
    worker = "\n".join((site / name).read_text() for name in ("sensor-noise.js", "worker.js"))
    worker = f'const SENSOR_NOISE_WASM = "{wasm}";\n{worker}'
    script = (site / "page.js").read_text()
    for text in (worker, script):
        if "</script" in text.lower():
            sys.exit("join.py: a script has the text </script; expected none, as it would end the script of the page")
    for old, new in (
        ('<link rel="stylesheet" href="page.css">', f"<style>\n{(site / 'page.css').read_text()}</style>"),
        (
            '<script src="page.js"></script>',
            f'<script id="worker-source" type="text/plain">{worker}</script>\n<script>\n{script}</script>',
        ),
    ):
        if page.count(old) != 1:
            sys.exit(f"join.py: index.html has {old} {page.count(old)} times; expected once")
        page = page.replace(old, new)
    return page


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    (folder / "sensor-noise.html").write_text(joined(folder))
