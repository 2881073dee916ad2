# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The programs that read the damaged files: the command-line tools, or Python."""

import json
import os
import queue
import resource
import select
import subprocess
from dataclasses import dataclass

from frame_parts import Case

SECONDS = 5.0  # longest time of an answer [s]
MEMORY = 4 << 30  # largest memory of a tool [bytes]: sizes that a damaged header gives must be refused


@dataclass
class Answer:
    """An exit code, the JSON of the report, and the messages. `samples` is the number of samples of the report."""

    code: int = 0
    text: str = ""
    error: str = ""
    hung: bool = False

    @property
    def crashed(self) -> bool:
        return self.code not in (0, 2, 3)

    @property
    def samples(self) -> int:
        report = json.loads(self.text) if self.text else {}
        return report.get("frames", 0) * report.get("width", 0) * report.get("height", 0)


def _no_core() -> None:
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _limit() -> None:
    _no_core()
    if "ASAN_OPTIONS" not in os.environ:  # AddressSanitizer reserves terabytes of addresses
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


class ToolTarget:
    def __init__(self, tools: str) -> None:
        self.tools = tools

    def ask(self, folder: str, case: Case, role: str, good: str) -> Answer:
        files = [os.path.join(folder, name) for name in case.frames]
        tool = os.path.join(self.tools, "estimate-sensor-noise")
        # the test is about the reading, not about channels: the file of a mosaic gives one report, too
        command = [tool, "--quiet", "--threads", "1", "--json", "-", "--bayer", "none"]
        stack = os.path.join(good, "s.mha")
        if role == "frames":
            command += files + (["--raw", case.raw] if case.raw else [])
        elif role == "mask":
            command += ["--mask", files[0], stack]
        elif role == "dark":
            command += [word for file in files for word in ("--dark", file)] + [stack]
        else:
            tool = os.path.join(self.tools, "simulate-sensor-noise")
            command = [
                tool,
                "--reference",
                files[0],
                "--frames",
                "2",
                "--output",
                os.path.join(folder, "simulated.mha"),
            ]
        try:
            done = subprocess.run(
                command,
                capture_output=True,
                timeout=SECONDS,
                preexec_fn=_limit,
                stdin=subprocess.DEVNULL,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return Answer(hung=True)
        text = done.stdout.decode(errors="replace") if role != "reference" else ""
        return Answer(done.returncode, text, done.stderr.decode(errors="replace"))


class PythonTarget:
    """A few interpreters, each for many files. An interpreter that crashes or hangs is replaced."""

    def __init__(self, python: str, jobs: int) -> None:
        self.command = [python, os.path.join(os.path.dirname(os.path.abspath(__file__)), "python_worker.py")]
        self.idle: queue.Queue[subprocess.Popen[bytes] | None] = queue.Queue()
        for _ in range(jobs):
            self.idle.put(None)

    def ask(self, folder: str, case: Case, role: str, good: str) -> Answer:
        worker = self.idle.get()
        fresh = worker is None or worker.poll() is not None
        if fresh:
            worker = subprocess.Popen(
                self.command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                preexec_fn=_no_core,  # noqa: PLW1509 - it takes no lock
            )
        files = [os.path.join(folder, name) for name in case.frames]
        request = {"role": role, "files": files, "stack": os.path.join(good, "s.mha"), "raw": case.raw}
        worker.stdin.write(json.dumps(request).encode() + b"\n")
        worker.stdin.flush()
        ready, _, _ = select.select([worker.stdout], [], [], SECONDS + (60 if fresh else 0))
        line = worker.stdout.readline() if ready else b""
        if line:
            self.idle.put(worker)
            answer = json.loads(line)
            return Answer(answer["code"], answer["text"], answer["error"])
        worker.kill()
        code = worker.wait()
        self.idle.put(None)
        return Answer(code if ready else 0, "", worker.stderr.read().decode(errors="replace"), hung=not ready)
