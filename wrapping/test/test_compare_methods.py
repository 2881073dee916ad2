# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the comparison of methods: its frames against NumPy, its rows, and its smallest setting from end to end."""

import json
import math
import os
import sys
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(autouse=True)
def examples(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "examples" / "python"))


@pytest.mark.parametrize("kind", ["uint8", "uint16"])
def test_frames_are_those_of_numpy(tmp_path, kind):
    from compare_frames import read_npy, write_npy

    frames = np.random.default_rng(1).integers(0, np.iinfo(kind).max, (11, 7, 5), kind)
    np.save(tmp_path / "numpy.npy", frames)
    stack = read_npy(tmp_path / "numpy.npy")

    def written(one):
        return np.load(write_npy(tmp_path / "ours.npy", one))

    assert np.array_equal(written(stack), frames)
    assert np.array_equal(written(stack.first(3)), frames[:3])
    square = frames[:9].reshape(3, 3, 7, 5).swapaxes(1, 2).reshape(1, 21, 15)
    assert np.array_equal(written(stack.composite()), square)
    for y in (0, 1):
        for x in (0, 1):
            assert np.array_equal(written(stack.plane(x, y)), frames[:, y::2, x::2])


@pytest.mark.parametrize("frames", [np.zeros((2, 3)), np.zeros((2, 3, 4), "uint16", order="F")])
def test_other_arrays_end_in_a_sentence(tmp_path, frames):
    from compare_frames import read_npy

    np.save(tmp_path / "other.npy", frames)
    with pytest.raises(ValueError, match=r"other.npy: has .*; expected frames \(t, y, x\) of uint8 or uint16"):
        read_npy(tmp_path / "other.npy")


def test_numbers_are_rounded_to_their_error():
    from compare_rows import Estimate
    from compare_tables import percent, text_of

    assert text_of(Estimate(0.99990, 0.00035)) == "0.99990 ± 0.00035"
    assert text_of(Estimate(-348.12, 12.7)) == "-348 ± 13"
    assert text_of(Estimate(0.3087, None)) == "0.3087"
    assert [percent(error) for error in (0.001, -0.0151, 0.19, 8.5, None)] == ["+0.10", "-1.5", "+19", "+850", "–"]


def test_a_program_of_others_answers_or_has_a_reason(tmp_path):
    from compare_peers import Peer, install, peer_row
    from compare_rows import Estimate

    np.save(tmp_path / "burst.npy", np.full((3, 4, 5), 7, "uint16"))
    job = json.dumps({"burst": str(tmp_path / "burst.npy")})
    script = 'start = time.process_time()\nfound = {"gain": load("burst", 2).sum(), "remark": "a sum"}\n'
    row = peer_row(Peer("sum", (), "burst", script), sys.executable, job)
    assert row.found == {"gain": Estimate(2 * 4 * 5 * 7, None)} and row.remark == "a sum" and row.seconds >= 0
    failed = peer_row(Peer("none", (), "burst", "raise RuntimeError('no light')\n"), sys.executable, job)
    assert failed.found == {} and failed.remark == "failed: RuntimeError: no light"
    python, reason = install(Peer("absent", (str(tmp_path / "absent"),), "burst", ""), tmp_path)
    assert python is None and reason.startswith("not installed: ") and "absent" in reason


def test_quick_measures_one_setting_of_each_kind(tmp_path):
    from compare_methods import PARTS, parse, text_of_times

    for tool in ("estimate-sensor-noise", "simulate-sensor-noise"):
        (tmp_path / tool).touch()
    _, every, _ = parse(["--bin", str(tmp_path)])
    _, quick, _ = parse(["--bin", str(tmp_path), "--quick"])
    assert (len(every), len(quick)) == (38, 6)
    assert {(one.group, one.scene, one.bits) for one in quick} == {(one.group, one.scene, one.bits) for one in every}
    (tmp_path / "saz_75x40x640_u8.npy").touch()
    _, with_real, note = parse(["--bin", str(tmp_path), "--quick", "--real", str(tmp_path)])
    assert [one.name for one in with_real] == [one.name for one in quick] + ["SA-Z"]
    assert note.endswith("does not have the frames: EMCCD.")
    _, _, note = parse(["--bin", str(tmp_path), "--settings", "B3/*", "--real", str(tmp_path)])
    assert note.endswith("Left out by --settings, as real frames that it does not name: SA-Z.")
    text = text_of_times(dict(zip(PARTS, (6.0, 3.0, 1.0), strict=True)))
    assert text == "processor time: 10 s (simulation 60 %, methods of this project 30 %, other programs 10 %)"


def test_rms_errors_have_two_digits():
    from compare_methods import rms_cell
    from compare_rows import Estimate, Row
    from compare_settings import paper_settings

    setting = next(paper_settings(None, None))
    cells = []
    for error in (0.0007, 0.02, 0.07, 0.143, 14.33, None):
        found = {} if error is None else {"gain": Estimate(setting.truth.gain * (1 + error), None)}
        measured = [(setting, [Row("one", "burst", found, 0.1)], [])]
        cells.append(rms_cell(measured, "one", "paper", "target"))
    assert cells == [f"{text} (1 of 1)" for text in ("0.070", "2.0", "7.0", "14", "1433")] + ["– (0 of 1)"]
    assert rms_cell(measured, "other", "paper", "target") == "–"


def test_dark_noise_of_emva_1288_is_in_electrons():
    from compare_rows import Estimate, emva_estimates

    def quantity(value, error):
        return {"value": value, "standard_error": error, "status": "identified"}

    report = {"sensitivity": {"gain": quantity(0.5, 0.005), "dark_signal": quantity(60.0, 0.1)}}
    report["sensitivity"]["dark_noise"] = quantity(8.0, 0.16)
    found = emva_estimates(report)
    assert found["gain"] == Estimate(0.5, 0.005) and found["offset"] == Estimate(60.0, 0.1)
    assert found["read_noise"] == pytest.approx((4.0, 4.0 * math.hypot(0.01, 0.02)))
    assert found["intercept"].value == 16 - 30
    report["sensitivity"]["dark_noise"]["status"] = "failed"
    assert set(emva_estimates(report)) == {"gain", "offset"}


class Cells(HTMLParser):
    """Collects the cells of all tables of a page."""

    def __init__(self):
        super().__init__()
        self.rows, self.is_cell = [], False

    def handle_starttag(self, tag, attrs):
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
            self.is_cell = True

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self.is_cell = False

    def handle_data(self, data):
        if self.is_cell:
            self.rows[-1][-1] += data


@pytest.fixture
def programs():
    """Returns the folder of the built tools."""
    folder = Path(os.environ.get("SENSORNOISE_BIN", ROOT / "build" / "bin"))
    if not (folder / "simulate-sensor-noise").exists():
        pytest.skip(f"no simulate-sensor-noise in {folder}; set SENSORNOISE_BIN")
    return folder


def test_all_methods_measure_the_smallest_settings(programs, tmp_path):
    """The gain of camera B is 1 DN/e-. The affine fit takes flicker of 5 % for noise of bright pixels."""
    import compare_methods

    output = tmp_path / "comparison"
    settings = ("B3/target", "EOS 350D/target/ISO 400")
    arguments = ["--bin", programs, "--output", output, "--size", 192, "--frames", 25, "--folder", tmp_path]
    assert compare_methods.main([*map(str, arguments), "--settings", *settings]) == 0
    text = output.with_suffix(".md").read_text(encoding="utf-8")
    assert "Real frames are left out: --real names no folder." in text
    assert "cameras A and B in Table 3 are missing" in text
    lines = [line.strip("|").split("|") for line in text.splitlines() if line.startswith("|") and "---" not in line]
    rows = [[cell.strip() for cell in line] for line in lines]
    page = Cells()
    page.feed(output.with_suffix(".html").read_text(encoding="utf-8"))
    assert page.rows == rows
    found = {(row[0], row[1]): row for row in rows}
    for setting, gain in zip(settings, (1.0, 0.384), strict=True):
        value, error = map(float, found[setting, "refined"][2].split(" ± "))
        assert abs(value - gain) < 4 * error and error < 0.15 * gain  # 11 % of a red channel of 96 x 96 x 25
        assert float(found[setting, "affine fit, no correction"][2]) > 2 * gain
        assert found[setting, "scikit-image"][-1] == "not run: --peers names no folder"
    value, error = map(float, found[settings[0], "single image, all frames"][2].split(" ± "))
    assert abs(value - 1) < 4 * error
    channels = [row for row in rows if row[:2] == [settings[1], "R"] or row[:2] == [settings[1], "truth"]]
    assert len(channels) == 3  # the truth of the camera, the truth of the motion, and the red channel
    truth, red = (float(row[5].split(" ± ")[0]) for row in channels[1:])
    assert red == pytest.approx(truth, rel=0.1)
