# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that every stored or new report, and every passport, agrees with its schema in documentation/."""

import copy
import json
import subprocess
import sys
from pathlib import Path

import itk
import jsonschema
import pytest

SOURCE = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((SOURCE / "documentation" / "report.schema.json").read_text(encoding="utf-8"))
PASSPORT = json.loads((SOURCE / "documentation" / "passport.schema.json").read_text(encoding="utf-8"))
STORED = sorted((SOURCE / "test" / "reports").glob("*.json"))
SMALL = ("--size", "96x64", "--frames", "20")

# Options of the simulator, and options of the estimator.
WRITTEN = {
    "refined": ((), ()),
    "published": ((), ("--method", "published")),
    "mosaic": (("--bayer", "RGGB"), ("--bayer", "RGGB")),
    "mosaic and check": (("--bayer", "RGGB"), ("--bayer", "RGGB", "--check")),
    "smoothed": (("--smoothing", "0.6"), ()),
    "known offset": ((), ("--offset", "100,0.5", "--level-range", "50,3000", "--clip", "0,4000", "--step", "1")),
    "part": ((), ("--roi", "8,8,64,48", "--frames", "2:18", "--excess-noise-factor", "2")),
    "hash and check": ((), ("--hash", "--check")),
    "failed": (("--clip", "0,300"), ()),
    "rolling shutter": (("--rolling-shutter", "20", "--reference", "bars"), ("--method", "published")),
    "different frames": (("--repeat", "2"), ("--bit-depth", "12")),
}


@pytest.fixture(scope="module")
def validator():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    return jsonschema.Draft202012Validator(SCHEMA)


def require_valid(validator, record) -> None:
    """Requires that a record agrees with the schema. The message has the places where it does not."""
    definition = "mosaic" if "channels" in record else "report"
    narrow = validator.evolve(schema={"$ref": f"#/$defs/{definition}", "$defs": SCHEMA["$defs"]})
    errors = [f"{error.json_path}: {error.message[:200]}" for error in narrow.iter_errors(record)]
    assert not errors and validator.is_valid(record), "\n".join(errors)


@pytest.mark.parametrize("path", STORED, ids=lambda path: path.stem)
def test_stored_reports(validator, path):
    require_valid(validator, json.loads(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", WRITTEN)
def test_reports_that_the_tool_writes(validator, tool, tmp_path, name):
    simulated, options = WRITTEN[name]
    tool("simulate-sensor-noise", *SMALL, *simulated, "--output", str(tmp_path / "burst.mha"))
    written = tmp_path / "report.json"
    try:
        tool("estimate-sensor-noise", str(tmp_path / "burst.mha"), *options, "--json", str(written), "--quiet")
    except subprocess.CalledProcessError as error:
        assert error.returncode == 3
    require_valid(validator, json.loads(written.read_text(encoding="utf-8")))


def test_reports_with_what_a_file_says_of_its_camera(validator, tool, tmp_path):
    tool("simulate-sensor-noise", *SMALL, "--output", str(tmp_path / "burst.mha"))
    maker = SOURCE / "test" / "documents" / "reader_files.py"
    recording = str(tmp_path / "recording.ser")
    subprocess.run([sys.executable, str(maker), str(tmp_path / "burst.mha"), "ser", recording], check=True)
    tool("estimate-sensor-noise", recording, "--json", str(tmp_path / "report.json"), "--quiet")
    record = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert record["camera"]["name"] == "camera"
    require_valid(validator, record)


def test_reports_with_dark_frames_and_exposures(validator):
    frames, _ = itk.simulate_sensor_noise(size=(96, 64), frames=20)
    dark, _ = itk.simulate_sensor_noise(size=(96, 64), frames=20, dark=True, seed=2)
    series = [0, 100, 200, 300] * 5
    for options in ({"dark": dark}, {"dark": dark, "hash": True}, {"exposures": series}, {"mask": frames[0] > 300}):
        require_valid(validator, itk.estimate_sensor_noise(frames, bayer="none", **options).to_dict())


def test_what_is_no_report_is_not_valid(validator):
    record = json.loads(STORED[0].read_text(encoding="utf-8"))
    for change in ({"gain": 1.0}, {"another": 1}, {"method": "other"}, {"warnings": [{"code": "x"}]}):
        assert not validator.is_valid({**copy.deepcopy(record), **change})
    del record["gain"]
    assert not validator.is_valid(record)


def simulate_camera(tool, folder, settings: dict[str, float], *options: str) -> None:
    """Writes a burst and dark frames for each setting. The values are the read noises [e-]."""
    for seed, (name, noise) in enumerate(settings.items(), 1):
        (folder / name / "dark").mkdir(parents=True)
        gain = 0.005 * float(name.removeprefix("iso"))
        camera = ("--size", "64x64", "--frames", "24", "--gain", str(gain), "--read-noise", str(noise * gain), *options)
        arguments = ("--electrons", str(3000 / gain), "--seed", str(seed), "--output", str(folder / name / "light.mha"))
        dark = ("--dark", "--seed", str(seed + 90), "--output", str(folder / name / "dark" / "dark.mha"))
        tool("simulate-sensor-noise", *camera, *arguments)
        tool("simulate-sensor-noise", *camera, *dark)


@pytest.mark.parametrize("mosaic", [(), ("--bayer", "RGGB")], ids=["mono", "mosaic"])
def test_passports_that_the_tool_writes(validator, tool, tmp_path, mosaic):
    noises = {"iso100": 9.0, "iso200": 9.0, "iso400": 9.0, "iso800": 2.0, "iso1600": 2.0}
    simulate_camera(tool, tmp_path / "camera", noises if not mosaic else {"iso100": 3.0, "iso400": 3.0}, *mosaic)
    (tmp_path / "camera" / "iso50").mkdir()  # a setting without a file: a row with the reason
    passport = tmp_path / "passport.json"
    options = ("--sweep", str(tmp_path / "camera"), *mosaic, "--json", str(passport), "--quiet")
    with pytest.raises(subprocess.CalledProcessError) as error:
        tool("estimate-sensor-noise", *options)
    assert error.value.returncode == 4
    record = json.loads(passport.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(PASSPORT)
    passports = jsonschema.Draft202012Validator(PASSPORT)
    assert [f"{found.json_path}: {found.message[:200]}" for found in passports.iter_errors(record)] == []
    assert (record["conversion_gain_switch"] is None) == bool(mosaic)
    measured = [entry for entry in record["settings"] if entry["status"] == "measured"]
    assert len(measured) == len(record["settings"]) - 1
    for entry in measured:
        require_valid(validator, entry["report"])
    for change in ({"setting": "shutter"}, {"another": 1}, {"settings": [{**measured[0], "report": None}]}):
        assert not passports.is_valid({**record, **change})
