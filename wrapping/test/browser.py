# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Shows a page in a real browser: Debian's Chromium without a window, controlled through a pair of pipes.

The protocol is Chromium's DevTools protocol 1.3 (https://chromedevtools.github.io/devtools-protocol/1-3/): records of
JSON, each followed by a zero byte. It needs no driver program, no open port and no download of a browser.
"""

import base64
import contextlib
import fcntl
import json
import os
import select
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome")
FLAGS = (
    "--headless=new",
    "--remote-debugging-pipe",
    "--no-sandbox",  # containers have no user namespaces, and the pages come from the test
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",  # telephones show no scroll bars
    "--disable-lcd-text",  # no coloured edges of letters: smaller pictures, equal on every screen
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--no-default-browser-check",
    "--no-proxy-server",
    "--force-color-profile=srgb",
)
# The browser reads from descriptor 3 and writes to 4. The pipes have other numbers here.
AS_3_AND_4 = """
import os, sys
os.dup2(int(sys.argv[1]), 3)
os.dup2(int(sys.argv[2]), 4)
os.execvp(sys.argv[3], sys.argv[3:])
"""


class BrowserError(Exception):
    """Error of a browser that did not start, did not answer in time, or rejected a command."""


def chromium() -> str | None:
    """Returns the path of the browser: SENSORNOISE_CHROMIUM, else the system's; None: there is none."""
    given = os.environ.get("SENSORNOISE_CHROMIUM")
    return shutil.which(given) if given else next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One page of one browser. `events` has every event since the last `open`, as (method, parameters)."""

    def __init__(self, program: str, profile: Path, seconds: float = 60.0):
        self.seconds = seconds
        self.events: list[tuple[str, dict[str, Any]]] = []
        self._number = 0
        self._rest = b""
        self._session: str | None = None
        reads, self._write = os.pipe()
        self._read, writes = os.pipe()
        theirs = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (reads, writes)]
        command = [sys.executable, "-c", AS_3_AND_4, *map(str, theirs), program, f"--user-data-dir={profile}", *FLAGS]
        self._log = (profile.parent / "chromium.log").open("w+")
        self._process = subprocess.Popen(
            command, pass_fds=theirs, stdin=subprocess.DEVNULL, stdout=self._log, stderr=self._log
        )
        for end in (reads, writes, *theirs):
            os.close(end)
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(f"{domain}.enable")

    def send(self, method: str, **parameters: object) -> dict[str, Any]:
        """Sends a command. Returns the answer of the browser."""
        self._number += 1
        record: dict[str, object] = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            record["sessionId"] = self._session
        try:
            os.write(self._write, json.dumps(record).encode() + b"\0")
        except BrokenPipeError:
            raise BrowserError(f"the browser ended: {self._words()}") from None
        while True:
            answer = self._next(method)
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']}")
                return answer["result"]

    def _next(self, what: str) -> dict[str, Any]:
        """Returns the next record. Events are added to `events`."""
        end = time.monotonic() + self.seconds
        while b"\0" not in self._rest:
            if not select.select([self._read], [], [], max(end - time.monotonic(), 0.0))[0]:
                raise BrowserError(f"{what}: no answer within {self.seconds} s: {self._words()}")
            part = os.read(self._read, 1 << 20)
            if not part:
                raise BrowserError(f"the browser ended: {self._words()}")
            self._rest += part
        text, self._rest = self._rest.split(b"\0", 1)
        record = json.loads(text)
        if "method" in record:
            self.events.append((record["method"], record["params"]))
        return record

    def _words(self) -> str:
        self._log.flush()
        self._log.seek(0)
        return self._log.read()[-500:]

    def open(self, file: Path | str, width: int, scheme: str, height: int = 800) -> float:
        """Shows a file or an address in a window `width` CSS pixels wide, "light" or "dark". Returns the seconds."""
        self.events.clear()
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        begin = time.monotonic()
        self.send("Page.navigate", url=file if isinstance(file, str) else file.resolve().as_uri())
        while not any(method == "Page.loadEventFired" for method, _ in self.events):
            self._next("load")
        return time.monotonic() - begin

    def run(self, expression: str) -> Any:
        """Returns the value of a JavaScript expression in the page."""
        answer = self.send("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise BrowserError(f"{expression[:80]}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def picture(self, file: Path, top: float = 0, height: float | None = None) -> None:
        """Writes a PNG of the page as shown: the whole page, or `height` CSS pixels from `top` on."""
        size = self.run("({w: document.documentElement.scrollWidth, h: document.documentElement.scrollHeight})")
        clip = {"x": 0, "y": top, "width": size["w"], "height": height or size["h"] - top, "scale": 1}
        answer = self.send("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip=clip)
        file.write_bytes(base64.b64decode(answer["data"]))

    def close(self) -> None:
        with contextlib.suppress(BrowserError):
            self._session = None
            self.send("Browser.close")
        os.close(self._write)
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._read)
        self._log.close()


@contextlib.contextmanager
def started(program: str, profile: Path) -> Iterator[Browser]:
    """Yields a browser, and closes it afterwards."""
    browser = Browser(program, profile)
    try:
        yield browser
    finally:
        browser.close()
