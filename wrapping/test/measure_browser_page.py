# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the page in a browser (examples/browser): its sizes, and its speed and memory beside the native tool.

    python wrapping/test/measure_browser_page.py --bin build/bin [--rounds 3] [--bursts 512x512x100,2048x2048x50]

Both read the same stack on one thread, and the page runs in Chromium without a window. Each number of seconds is the
median of the rounds, followed by the shortest and the longest. The time of the page is from the click to the report.
The memory of its program does not shrink.
"""

import argparse
import functools
import gzip
import http.server
import statistics
import subprocess
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from browser import Browser, chromium, started

SITE = Path(__file__).resolve().parents[2] / "build" / "browser" / "site"
SECONDS = 600.0  # that a measurement may take


def print_sizes() -> None:
    for names in (
        ("sensor-noise.wasm",),
        ("sensor-noise.js",),
        ("sensor-noise.wasm", "sensor-noise.js"),
        ("sensor-noise.html",),
    ):
        contents = [(SITE / name).read_bytes() for name in names]
        size = sum(map(len, contents)) / 1e6
        compressed = sum(len(gzip.compress(content, 9)) for content in contents) / 1e6
        print(f"{' + '.join(names):<36} {size:6.2f} MB, {compressed:.2f} MB compressed by gzip")


@contextmanager
def server() -> Iterator[str]:
    """Yields the address of the page on a server of this computer."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_) -> None:
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=SITE)) as serving:
        threading.Thread(target=serving.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{serving.server_port}/index.html"
        serving.shutdown()


def wait(browser: Browser, condition: str) -> None:
    end = time.monotonic() + SECONDS
    while not browser.run(f"Boolean({condition})"):
        if time.monotonic() > end:
            raise SystemExit(f"{condition}: not within {SECONDS} s; expected a page that works")
        time.sleep(0.01)


def memory_of_worker(browser: Browser) -> float:
    """Returns the size of the memory of the page's program [bytes]."""
    attached = [event for method, event in browser.events if method == "Target.attachedToTarget"]
    workers = [event["sessionId"] for event in attached if event["targetInfo"]["type"] == "worker"]
    page, browser._session = browser._session, workers[-1]
    try:
        return float(browser.run("library.then((module) => module.HEAPU8.length)"))
    finally:
        browser._session = page


def seconds_of_example(browser: Browser, address: str) -> float:
    """Returns the seconds from the opening of the page to the report of its simulated burst."""
    begin = time.monotonic()
    browser.open(address, 1280, "light")
    wait(browser, "document.getElementById('version').textContent !== ''")
    browser.run("document.getElementById('example').click()")
    wait(browser, "!document.getElementById('result').hidden")
    return time.monotonic() - begin


def measure_page(browser: Browser, address: str, stack: Path) -> tuple[float, float]:
    """Returns the seconds of a measurement, and the memory of the program [bytes]."""
    browser.open(address, 1280, "light")
    browser.send("Target.setAutoAttach", autoAttach=True, waitForDebuggerOnStart=False, flatten=True)
    wait(browser, "document.getElementById('version').textContent !== ''")
    root = browser.send("DOM.getDocument")["root"]["nodeId"]
    node = browser.send("DOM.querySelector", nodeId=root, selector="#files")["nodeId"]
    browser.send("DOM.setFileInputFiles", nodeId=node, files=[str(stack)])
    wait(browser, "!part('measure').disabled")
    begin = time.monotonic()
    browser.run("part('measure').click()")
    wait(browser, "part('stop').hidden")
    seconds = time.monotonic() - begin
    error = browser.run("part('error').textContent")
    if error:
        raise SystemExit(f"the page says: {error} Expected a report")
    return seconds, memory_of_worker(browser)


def measure_tool(tools: Path, stack: Path) -> float:
    command = [
        tools / "estimate-sensor-noise",
        stack,
        "--threads",
        "1",
        "--quiet",
        "--plot",
        stack.with_suffix(".html"),
    ]
    begin = time.monotonic()
    subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - begin


def text(seconds: list[float]) -> str:
    return f"{statistics.median(seconds):7.2f} s [{min(seconds):.2f}, {max(seconds):.2f}]"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True, help="folder of the native tools")
    parser.add_argument("--bursts", default="512x512x100,2048x2048x50", help="width x height x frames, with commas")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    program = chromium()
    if program is None or not (SITE / "index.html").exists():
        raise SystemExit(f"expected Chromium, and the page in {SITE}: bash examples/browser/build.sh")
    print_sizes()
    with tempfile.TemporaryDirectory() as folder, server() as address:
        with started(program, Path(folder) / "profile") as browser:
            examples = [seconds_of_example(browser, address) for _ in range(options.rounds)]
        print(f"simulated burst, from the opening of the page: {text(examples)}", flush=True)
        for burst in options.bursts.split(","):
            width, height, frames = burst.split("x")
            stack = Path(folder) / "burst.mha"
            simulate = [options.bin / "simulate-sensor-noise", "--output", stack, "--size", f"{width}x{height}"]
            subprocess.run([*map(str, simulate), "--frames", frames], check=True, stdout=subprocess.DEVNULL)
            pages, tools, memory = [], [], 0.0
            with started(program, Path(folder) / f"profile-{burst}") as browser:
                for _ in range(options.rounds):
                    seconds, memory = measure_page(browser, address, stack)
                    pages.append(seconds)
                    tools.append(measure_tool(options.bin, stack))
            ratio = statistics.median(pages) / statistics.median(tools)
            print(
                f"{burst}: page {text(pages)}, {memory / 1e9:.2f} GB; tool {text(tools)}; ratio {ratio:.1f}", flush=True
            )


if __name__ == "__main__":
    main()
