# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that records of `--method emva1288` agree with documentation/emva1288.schema.json."""

import copy
import json
from pathlib import Path

import jsonschema
import pytest

SOURCE = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((SOURCE / "documentation" / "emva1288.schema.json").read_text(encoding="utf-8"))
EXPOSURES = [0.0] * 4 + [0.1 * level for level in range(1, 12) for _ in range(2)]


@pytest.fixture(scope="module")
def validator():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    return jsonschema.Draft202012Validator(SCHEMA)


def measure(tool, folder, *simulated, options=()):
    """Simulates a series of flat fields and dark frames, and returns its record."""
    exposures = folder / "exposures.txt"
    exposures.write_text("\n".join(map(str, EXPOSURES)) + "\n", encoding="utf-8")
    stack, record = str(folder / "stack.mha"), folder / "record.json"
    static = ("--flicker-sd", "0", "--vibration-sd", "0,0", "--illumination", str(exposures))
    simulated = ("--reference", "flat", "--frames", str(len(EXPOSURES)), *static, *simulated)
    tool("simulate-sensor-noise", *simulated, "--output", stack)
    method = ("--method", "emva1288", "--exposures", str(exposures), "--bit-depth", "12")
    tool("estimate-sensor-noise", stack, *method, *options, "--json", str(record), "--quiet")
    return json.loads(record.read_text(encoding="utf-8"))


def require_valid(validator, record, definition):
    """Requires that a record agrees with a definition of the schema. The message has the places where it does not."""
    narrow = validator.evolve(schema={"$ref": f"#/$defs/{definition}", "$defs": SCHEMA["$defs"]})
    errors = [f"{error.json_path}: {error.message[:200]}" for error in narrow.iter_errors(record)]
    assert not errors and validator.is_valid(record), "\n".join(errors)


@pytest.mark.parametrize(
    "simulated",
    [
        ("--size", "64x48", "--electrons", "3800", "--prnu", "0.01", "--dsnu", "3"),
        ("--size", "64x48", "--electrons", "2000"),  # not saturated
        ("--size", "64x48", "--electrons", "3800", "--read-noise", "0.1"),  # quantization hides the dark noise
        ("--size", "16x12", "--electrons", "3800"),  # no room for the highpass filter
    ],
)
def test_records_agree_with_the_schema(validator, tool, tmp_path, simulated):
    require_valid(validator, measure(tool, tmp_path, *simulated), "evaluation")


@pytest.mark.parametrize(
    "simulated",
    [
        ("--size", "96x64", "--electrons", "3800", "--prnu", "0.01", "--dsnu", "3"),
        ("--size", "32x24", "--electrons", "2000"),  # planes without room for the highpass filter, not saturated
    ],
)
def test_records_of_mosaics_agree_with_the_schema(validator, tool, tmp_path, simulated):
    record = measure(tool, tmp_path, *simulated, options=("--bayer", "GRBG"))
    require_valid(validator, record, "mosaic")
    assert record["bayer"] == "GRBG" and list(record["planes"]) == ["R", "G1", "G2", "B"]
    plane = record["planes"]["R"]
    for change in ({"another": 1}, {"schema": plane["schema"]}, {"bayer": "RGB"}, {"planes": {"R": plane}}):
        assert not validator.is_valid({**record, **change})
    record["planes"]["B"] = {**plane, "linearity": {}}
    assert not validator.is_valid(record)


def test_what_is_no_record_is_not_valid(validator, tool, tmp_path):
    record = measure(tool, tmp_path, "--size", "32x24", "--electrons", "3800")
    assert validator.is_valid(record)
    for change in ({"another": 1}, {"schema": "other"}, {"points": []}, {"notes": [{"code": "x"}]}, {"linearity": {}}):
        assert not validator.is_valid({**copy.deepcopy(record), **change})
