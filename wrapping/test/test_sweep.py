# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests a camera over its settings: the passport, its exports, and the continuation of a sweep."""

import json
import pickle
import sys
from collections.abc import Mapping
from pathlib import Path

import itk
import itk_sensornoise as sn
import numpy as np
import pytest

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples" / "python"))
from frame_stacks import RATIONAL, SHORT, write_dng

ISO_SPEEDS = (100.0, 200.0, 400.0)
SCHEMA = Path(__file__).resolve().parents[2] / "documentation" / "passport.schema.json"


def simulated(gain, seed, dark=False):
    """Returns frames of a camera with a read noise of 3 electrons."""
    light = {"dark": True} if dark else {"electrons": 3000 / gain, "flicker_sd": 0.05}
    camera = {"size": (64, 64), "frames": 24, "offset": 100, "gain": gain, "read_noise": 3 * gain}
    return sn.simulate_sensor_noise(**camera, **light, seed=seed)[0]


@pytest.fixture(scope="module")
def bursts():
    return {iso: simulated(0.005 * iso, number) for number, iso in enumerate(ISO_SPEEDS)}


@pytest.fixture(scope="module")
def dark():
    return {iso: simulated(0.005 * iso, 90 + number, True) for number, iso in enumerate(ISO_SPEEDS)}


@pytest.fixture(scope="module")
def passport(bursts, dark):
    return sn.estimate_sweep(bursts, dark=dark, bayer="none")


@pytest.fixture
def camera(bursts, dark, tmp_path):
    """Writes the bursts into a folder for each setting."""
    for iso, frames in bursts.items():
        folder = tmp_path / "camera" / f"iso{iso:g}"
        (folder / "dark").mkdir(parents=True)
        itk.imwrite(itk.image_from_array(frames), str(folder / "light.mha"))
        itk.imwrite(itk.image_from_array(dark[iso]), str(folder / "dark" / "dark.mha"))
    return tmp_path / "camera"


def test_each_setting_is_measured_as_by_itself(passport, bursts, dark):
    assert [entry["setting"] for entry in passport["settings"]] == list(ISO_SPEEDS)
    for iso in ISO_SPEEDS:
        report = sn.estimate_sensor_noise(bursts[iso], dark=dark[iso], bayer="none", hash=True)
        assert passport.report(iso) == report
        gain = report["gain"]
        assert abs(gain["value"] - 0.005 * iso) < max(0.01 * 0.005 * iso, 3 * gain["standard_error"])
    (part,) = passport["gain_line"]["parts"]
    assert part["settings"] == 3 and passport["conversion_gain_switch"] is None
    assert "3 of 3 settings measured" in str(passport) and "The gain is (0.0050" in str(passport)
    assert "<figure>" in passport.to_html() and repr(passport) == "<Passport: a camera, 3 of 3 settings measured>"
    assert pickle.loads(pickle.dumps(passport)) == passport == sn.Passport.from_json(passport.to_json())
    with pytest.raises(KeyError, match="800 was not measured; expected one of 100, 200, 400"):
        passport.report(800)


def test_it_agrees_with_its_schema(passport):
    jsonschema = pytest.importorskip("jsonschema")
    validator = jsonschema.Draft202012Validator(json.loads(SCHEMA.read_text(encoding="utf-8")))
    bad = sn.estimate_sweep({100: "no such file", 200: simulated(1.0, 1)}, bayer="none")
    for record in (passport, bad):
        assert [f"{found.json_path}: {found.message[:200]}" for found in validator.iter_errors(dict(record))] == []


def test_every_export_is_made_of_it(passport, tmp_path):
    report = passport.report(200)
    for format in ("ndsafir", "pyme", "fits", "lsst"):
        expected = report.export(format, white=4095).files
        assert passport.export(format, setting=200, white=4095).files == expected
    between = passport.export("fits", tmp_path / "header.txt", setting=300)
    assert "interpolated between the measured settings 200 and 400" in between.note
    assert (tmp_path / "header.txt").read_text() == between.text
    android = json.loads(passport.export("android", black=100, white=4095).text)
    assert android["noise_model_A"] == pytest.approx([0.005 / 3995], rel=0.05)
    with pytest.raises(ValueError, match=r"fits takes one\. Choose a setting \(setting=\)"):
        passport.export("fits")
    with pytest.raises(ValueError, match="ISO 800 is outside of the measured settings"):
        passport.export("fits", setting=800)


def test_a_folder_gives_the_record_of_the_tool(camera, tool, tmp_path):
    found = sn.estimate_sweep(camera, bayer="none", output=tmp_path / "passport.json")
    assert sn.Passport.from_json(tmp_path / "passport.json") == found
    tool(
        "estimate-sensor-noise",
        "--sweep",
        str(camera),
        "--bayer",
        "none",
        "--json",
        str(tmp_path / "t.json"),
        "--quiet",
    )
    expected = sn.Passport.from_json(tmp_path / "t.json")
    for name in (
        "setting",
        "camera",
        "gain_line",
        "conversion_gain_switch",
        "common_gain",
        "android",
        "darktable",
        "findings",
    ):
        assert_alike(found[name], expected[name])
    for entry, other in zip(found["settings"], expected["settings"], strict=True):
        assert_alike(entry["channels"], other["channels"])
        assert (entry["name"], entry["setting"], entry["status"]) == (other["name"], other["setting"], other["status"])


@pytest.fixture
def measured(monkeypatch):
    """Counts the bursts that are measured, by their mean level."""
    from itk_sensornoise.distributed import _task

    levels = []

    def count(frames, **settings):
        report = sn.estimate_sensor_noise(frames, **settings)
        levels.append(round(report["gain"]["value"], 1))
        return report

    monkeypatch.setattr(_task, "estimate_sensor_noise", count)
    return levels


def test_it_goes_on_where_it_was_interrupted(bursts, measured, tmp_path):
    output = tmp_path / "passport.json"
    first = {iso: bursts[iso] for iso in ISO_SPEEDS[:2]}
    sn.estimate_sweep(first, output=output, bayer="none")
    whole = sn.estimate_sweep({**first, 400.0: lambda: bursts[400.0]}, output=output, bayer="none")
    assert measured == [0.5, 1.0, 2.0]
    assert whole == sn.estimate_sweep(bursts, bayer="none") == sn.Passport.from_json(output)
    measured.clear()
    sn.estimate_sweep(bursts, output=output, bayer="none", hash=True, threads=1)
    assert measured == []
    sn.estimate_sweep(first, output=output, bayer="none", bit_depth=16)
    assert measured == [0.5, 1.0]  # other options


@pytest.mark.parametrize("kind", ["array", "function", "file"])
def test_a_burst_that_has_changed_is_measured_again(bursts, measured, kind, tmp_path):
    output = tmp_path / "passport.json"

    def sweep(high, dark=None):
        def given(frames):
            if kind != "file":
                return frames if kind == "array" else lambda: frames
            np.save(tmp_path / "burst.npy", frames)
            return tmp_path / "burst.npy"

        return sn.estimate_sweep({100: bursts[100.0], 200: given(high)}, dark=dark, output=output, bayer="none")

    sweep(bursts[200.0])
    found = sweep(simulated(1.5, 7))
    assert measured == [0.5, 1.0, 1.5] and abs(found.report(200).gain.value - 1.5) < 0.1
    sweep(simulated(1.5, 7))
    sweep(simulated(1.5, 7).reshape(24, 32, 128))  # the same bytes
    assert measured == [0.5, 1.0, 1.5, 1.5]
    for seed in (91, 91, 92):
        sweep(simulated(1.5, 7).reshape(24, 32, 128), dark={100: simulated(0.5, seed, True)})
    assert measured[4:] == [0.5, 0.5]  # as the dark frames are new


def test_the_mask_of_a_file_may_change(bursts, measured, tmp_path):
    output = tmp_path / "passport.json"
    np.save(tmp_path / "mask.npy", np.ones((64, 64), np.uint8))
    for _ in range(2):
        sn.estimate_sweep({100: bursts[100.0]}, output=output, mask=tmp_path / "mask.npy", bayer="none")
    assert measured == [0.5, 0.5]


def test_python_goes_on_with_the_passport_of_the_tool(camera, tool, measured, tmp_path):
    passport = tmp_path / "passport.json"
    tool("estimate-sensor-noise", "--sweep", str(camera), "--json", str(passport), "--quiet")
    if "sha256" not in sn.Passport.from_json(passport)["settings"][0]["report"].get("input", {}):
        pytest.skip("the tool was built without OpenSSL, and its passports have no hashes")
    found = sn.estimate_sweep(camera, output=passport)
    assert measured == [] and [entry["status"] for entry in found["settings"]] == ["measured"] * 3
    record = json.loads(passport.read_text())
    for entry in record["settings"]:
        entry["report"]["gain"]["value"] = 9.0  # shows that the report is taken as it is
    passport.write_text(json.dumps(record))
    tool("estimate-sensor-noise", "--sweep", str(camera), "--json", str(passport), "--quiet")
    stored = sn.Passport.from_json(passport)["settings"]
    assert [entry["report"]["gain"]["value"] for entry in stored] == [9.0] * 3


def test_a_bad_burst_is_an_entry_with_its_reason(bursts):
    found = sn.estimate_sweep({**bursts, 800: np.zeros((24, 64, 64), np.uint16), 1600: "no such file"}, bayer="none")
    assert [entry["status"] for entry in found["settings"]] == ["measured"] * 3 + ["failed"] * 2
    assert found["settings"][3]["reason"] and "no such file" in found["settings"][4]["reason"]
    assert "3 of 5 settings measured" in str(found)


def test_the_gains_of_exposures_are_tested_and_pooled(bursts, dark):
    same = {0.01: bursts[100.0], 0.02: simulated(0.5, 7), 0.04: simulated(0.5, 8)}
    found = sn.estimate_sweep(same, kind="exposure", bayer="none")
    (common,) = found["common_gain"]
    assert common["is_same"] and abs(common["gain"]["value"] - 0.5) < 4 * common["gain"]["standard_error"]
    assert (
        found["findings"][0].startswith("The gain is the same at all 3 exposures") and not found["gain_line"]["parts"]
    )
    other = sn.estimate_sweep({**same, 0.08: bursts[200.0]}, kind="exposure", bayer="none")
    assert not other["common_gain"][0]["is_same"]
    assert other["findings"][0].startswith("Warning: the gain is not the same at all exposures: at exposure 0.08 s")


def test_names_hold_the_settings(bursts, tmp_path):
    for name in ("10ms", "exposure0.02s", "dark", ".hidden"):
        (tmp_path / name).mkdir()
    np.save(tmp_path / "10ms" / "a.npy", bursts[100.0])
    np.save(tmp_path / "exposure0.02s" / "a.npy", simulated(0.5, 9))
    found = sn.estimate_sweep(tmp_path, bayer="none")
    assert found["setting"] == "exposure"
    assert [entry["setting"] for entry in found["settings"]] == [0.01, 0.02]
    (tmp_path / "iso100").mkdir()
    with pytest.raises(ValueError, match=r"10ms \(exposure\), iso100 \(iso\); expected settings of one kind"):
        sn.estimate_sweep(tmp_path)


def test_a_client_measures_the_same(passport, bursts, dark):
    distributed = pytest.importorskip("distributed")
    with distributed.Client(processes=False, n_workers=1, threads_per_worker=2, dashboard_address=None) as client:
        assert sn.estimate_sweep(bursts, client, dark=dark, bayer="none") == passport


@pytest.mark.parametrize(
    ("sources", "options", "said"),
    [
        (3, {}, "sources is of type int; expected a mapping"),
        ("no such folder", {}, "is no folder; expected a mapping"),
        ({}, {}, "sources is an empty mapping; expected a mapping of settings"),
        ({0: "a.mha"}, {}, "a setting is 0; expected a number above 0"),
        ({"iso": "a.mha"}, {}, "a setting is 'iso'"),
        ({1: "a.mha"}, {"dark": {2: "b.mha"}}, "dark has the setting 2"),
        ({1: "a.mha"}, {"kind": "shutter"}, "kind is 'shutter'; expected 'iso' or 'gain' or 'exposure'"),
        ({1: "a.mha"}, {"maps": True}, "maps is no setting"),
        ({1: "a.mha"}, {"method": "published"}, "method is no setting"),
        ({1: "a.mha"}, {"client": 3}, "client is of type int"),
        ({1: "a.mha"}, {"output": 3}, "output is 3"),
    ],
)
def test_wrong_use_is_refused(sources, options, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises((TypeError, ValueError), match=said):
        sn.estimate_sweep(sources, **options)
    (tmp_path / "other.json").write_text("{}")
    with pytest.raises(
        ValueError, match=r"other\.json is no passport.*\. It is not overwritten: name another file as output"
    ):
        sn.estimate_sweep({1: "a.mha"}, output="other.json")


@pytest.fixture
def recorded(tmp_path):
    """Writes DNG files that record their ISO speed and exposure. The names of the files do not contain them."""
    pytest.importorskip("rawpy")

    def write(frames, iso, exposure, name="frames"):
        folder = tmp_path / name
        folder.mkdir(parents=True, exist_ok=True)
        exif = [(33434, RATIONAL, list(exposure)), (34855, SHORT, [iso])]
        for frame in frames:
            write_dng(folder / f"frame_{len(list(folder.iterdir()))}.dng", frame, 100, 4095, exif=exif)
        return folder

    return write


def assert_alike(found, expected):
    """Asserts that two records differ by rounding alone: tool and package may be compiled with other versions of Eigen,
    which sum in another order."""
    if isinstance(expected, Mapping):
        assert found.keys() == expected.keys()
        for name in expected:
            assert_alike(found[name], expected[name])
    elif isinstance(expected, list | tuple):
        for own, other in zip(found, expected, strict=True):
            assert_alike(own, other)
    elif isinstance(expected, float):
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)
    else:
        assert found == expected


def test_a_table_gives_the_record_of_the_tool(camera, tool, tmp_path):
    table = tmp_path / "camera" / "list.csv"
    rows = [f"{iso:g};iso{iso:g}/light.mha;iso{iso:g}/dark/*.mha" for iso in ISO_SPEEDS[:2]]
    table.write_text(
        "\n".join(["\ufeff# light and dark", "ISO;frames;dark", *rows, "", "400;iso400;"]), encoding="utf-8"
    )
    found = sn.estimate_sweep(table, bayer="none")
    tool(
        "estimate-sensor-noise", "--sweep", str(table), "--bayer", "none", "--json", str(tmp_path / "t.json"), "--quiet"
    )
    expected = sn.Passport.from_json(tmp_path / "t.json")
    for name in ("setting", "gain_line", "findings"):
        assert_alike(found[name], expected[name])
    for entry, other in zip(found["settings"], expected["settings"], strict=True):
        assert entry["setting"] == other["setting"]
        assert_alike(entry["channels"], other["channels"])


@pytest.mark.parametrize(
    ("header", "cell", "kind", "setting"),
    [("gain_db", "6", "gain", 10**0.3), ("exposure_ms", "20", "exposure", 0.02), ("gain", "2.5", "gain", 2.5)],
)
def test_a_table_has_settings_in_several_units(bursts, header, cell, kind, setting, tmp_path):
    np.save(tmp_path / "a.npy", bursts[100.0])
    (tmp_path / "a.csv").write_text(f"frames,{header}\na.npy,{cell}\na.npy,{cell}\n")
    found = sn.estimate_sweep(tmp_path / "a.csv", bayer="none")
    assert found["setting"] == kind and found["settings"][0]["setting"] == pytest.approx(setting, rel=1e-12)
    assert "a.npy has the same setting and is measured" in found["settings"][1]["reason"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("iso,dark\n1,a\n", r"line 1 of .*a\.csv has no column frames; expected a header"),
        ("speed,frames\n1,a\n", "has no column iso or gain or gain_db or exposure or exposure_ms"),
        ("iso,frames,Darks\n1,a,b\n", "line 1 of .* has the columns iso and 'darks'; expected iso, frames and"),
        (
            "exposure,iso,frames\n1,1,a\n",
            "has the columns iso and 'exposure'; .* There is no other column: leave it out",
        ),
        ("iso,frames,frames\n1,a,b\n", "has the column frames twice; expected each column once"),
        ("iso,frames\n1,a,b\n", "line 2 of .* has 3 columns; expected 2, as the header"),
        ("iso,frames\n0,a\n", "line 2 of .* has the setting '0'; expected a finite number above 0"),
        ("iso,frames\nx,a\n", "has the setting 'x'; expected a finite number"),
        ("iso,frames\n1,\n", "line 2 of .* has no frames"),
        ("iso,frames\n", "has no line with a setting"),
        (None, "the table .* cannot be read"),
    ],
)
def test_a_wrong_table_is_refused(text, said, tmp_path):
    if text is not None:
        (tmp_path / "a.csv").write_text(text)
    with pytest.raises(ValueError, match=said):
        sn.estimate_sweep(tmp_path / "a.csv")
    (tmp_path / "b.csv").write_text("iso,frames\n1,a\n")
    with pytest.raises(ValueError, match="has the settings iso; expected gain"):
        sn.estimate_sweep(tmp_path / "b.csv", kind="gain")


def test_frames_are_grouped_by_the_iso_speed_that_they_record(recorded, bursts):
    for iso in (200, 100):
        folder = recorded(bursts[float(iso)], iso, (1, 100))
    found = sn.estimate_sweep(folder, bayer="none")
    assert (found["setting"], [entry["name"] for entry in found["settings"]]) == ("iso", ["ISO 100", "ISO 200"])
    assert [entry["reason"] for entry in found["settings"]] == [None, None]
    assert found.report(100).gain.value == pytest.approx(0.5, rel=0.1)
    names = sorted(folder.iterdir(), key=lambda name: int(name.stem.split("_")[-1]))  # frame_2 before frame_10
    for sources in (names, str(folder / "*.dng")):
        again = sn.estimate_sweep(sources, bayer="none")
        assert [entry["channels"] for entry in again["settings"]] == [entry["channels"] for entry in found["settings"]]
    with pytest.raises(ValueError, match=r"frame_0\.dng records no gain; expected frames that do"):
        sn.estimate_sweep(names, kind="gain")


def test_frames_of_one_iso_speed_are_grouped_by_their_exposure(recorded, bursts):
    recorded(bursts[100.0], 100, (1, 50))
    folder = recorded(simulated(0.5, 7), 100, (1, 100))
    found = sn.estimate_sweep(folder, bayer="none")
    assert found["setting"] == "exposure"
    assert [entry["setting"] for entry in found["settings"]] == [0.01, 0.02]
    assert found["common_gain"][0]["is_same"]


def test_exposures_at_another_iso_speed_are_not_measured(recorded, measured, tmp_path):
    for iso, milliseconds, seed in ((100, 10, 7), (100, 20, 8), (200, 40, 9)):
        recorded(simulated(0.005 * iso, seed), iso, (milliseconds, 1000), f"camera/{milliseconds}ms")
    names = {1e-3 * milliseconds: tmp_path / f"camera/{milliseconds}ms" for milliseconds in (10, 20, 40)}
    (tmp_path / "list.csv").write_text("exposure_ms,frames\n10,camera/10ms\n20,camera/20ms\n40,camera/40ms\n")
    for sources, first in ((tmp_path / "camera", "10ms"), (tmp_path / "list.csv", "10ms"), (names, "0.01")):
        measured.clear()
        found = sn.estimate_sweep(sources, kind="exposure", bayer="none")
        assert len(measured) == 2 and found["common_gain"][0]["settings"] == 2
        assert [entry["reason"] for entry in found["settings"]] == [
            None,
            None,
            f"its files record ISO 200, and the files of {first} ISO 100; expected exposures at one ISO speed",
        ]


def test_what_files_record_counts_before_names(recorded, measured, tmp_path):
    frames = simulated(0.5, 7)
    recorded(frames, 100, (1, 100), "camera/iso100.5")
    recorded(frames, 400, (1, 100), "camera/iso200")
    recorded(frames[:12], 800, (1, 100), "camera/iso800")
    mixed = recorded(frames[12:], 1600, (1, 100), "camera/iso800")
    (tmp_path / "camera" / "night").mkdir()
    np.save(tmp_path / "camera" / "night" / "a.npy", frames)
    (tmp_path / "camera" / "nothing").mkdir()
    found = sn.estimate_sweep(tmp_path / "camera", bayer="none")
    assert len(measured) == 1
    assert [(entry["name"], entry["setting"]) for entry in found["settings"]] == [
        ("iso100.5", 100.0),
        ("iso200", 400.0),
        ("iso800", 800.0),
        ("night", None),
        ("nothing", None),
    ]
    reasons = [entry["reason"] for entry in found["settings"]]
    assert reasons[0] is None
    assert reasons[1] == (
        "its files record ISO 400, but ISO 200 was given; expected the same. Correct the name or the table"
    )
    assert reasons[2] == (
        f"the frames record different ISO speeds, 800 ({mixed / 'frame_0.dng'}) and 1600 ({mixed / 'frame_12.dng'}); "
        "expected one setting"
    )
    assert reasons[3].startswith("its setting is not known: neither the files record an ISO speed, nor does the name")
    assert "nothing: is a folder without files" in reasons[4]


def test_files_without_a_header_are_stacks_of_a_layout(bursts, tmp_path):
    for iso in ISO_SPEEDS[:2]:
        bursts[iso].astype("<u2").tofile(tmp_path / f"iso{iso:g}.raw")
    found = sn.estimate_sweep(tmp_path, raw="64x64:uint16le", bayer="none")
    assert [entry["reason"] for entry in found["settings"]] == [None, None]
    assert found.report(200).gain.value == pytest.approx(1.0, rel=0.1)


def test_frames_without_an_iso_speed_are_refused(bursts, tmp_path):
    for number, frame in enumerate(bursts[100.0][:2]):
        np.save(tmp_path / f"{number}.npy", frame)
    with pytest.raises(ValueError, match=r"0\.npy records no ISO speed, so that its burst is not known"):
        sn.estimate_sweep(tmp_path)
