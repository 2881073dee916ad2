# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Answers requests of PythonTarget: a line of JSON in, a line of JSON out, and nothing else on standard output."""

import json
import os
import sys

import itk

answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)  # what a library prints must not be taken for an answer


def answer(request: dict) -> dict:
    files = request["files"] if len(request["files"]) > 1 else request["files"][0]
    first = request["files"][0]
    try:
        if request["role"] == "reference":
            itk.simulate_sensor_noise(reference=first, frames=2)
            return {"code": 0, "text": "", "error": ""}
        options = {"mask": first} if request["role"] == "mask" else {"dark": files} if request["role"] == "dark" else {}
        frames = files if request["role"] == "frames" else request["stack"]
        if request["role"] == "frames" and request["raw"]:
            options["raw"] = request["raw"]
        report = itk.estimate_sensor_noise(frames, bayer="none", **options)
    except (ValueError, RuntimeError) as error:
        return {"code": 2, "text": "", "error": str(error)}
    return {"code": 0, "text": json.dumps(dict(report)), "error": ""}


for line in sys.stdin:
    try:
        made = answer(json.loads(line))
    except Exception as error:  # noqa: BLE001 - another class than the two promised
        made = {"code": 1, "text": "", "error": f"{type(error).__name__}: {error}"}
    answers.write(json.dumps(made) + "\n")
    answers.flush()
