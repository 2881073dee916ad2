# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the tables of the studies with closed forms, and the lines of measure-cases from which they are made."""

import json
import math
import os
import subprocess
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"
needs_programs = pytest.mark.skipif(
    "SENSORNOISE_BIN" not in os.environ, reason="SENSORNOISE_BIN names no folder of the tools"
)


@pytest.fixture(autouse=True)
def examples(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))


def quantity(value, error=None, interval=None, status="identified", bounds=None):
    return {"value": value, "standard_error": error, "interval95": interval, "status": status, "bracket": bounds}


def record(gain, **members):
    report = {"gain": gain, "warnings": [], "pixels": {"used": 90, "total": 100}, "noise_correlation": None}
    return {"case": "robustness/a/target", "seed": 1, "truth": {"gain": 1.0}, "report": report} | members


def test_an_estimate_is_compared_with_its_truth():
    from study_records import estimate_of

    found = estimate_of(record(quantity(1.02, 0.005, [1.01, 1.03])), "gain")
    assert found.error == pytest.approx(0.02) and found.z == pytest.approx(4) and found.is_held is False
    assert found.is_within(0.021) and not found.is_within(0.019)
    none = estimate_of(record(quantity(None, status="not-identifiable", bounds=[0.5, None])), "gain")
    assert none.error is none.z is none.is_held is None and none.bounds == [0.5, None]
    assert estimate_of(record(quantity(1.0)), "row_noise").status == "none"  # this report has no such quantity


def test_the_interval_is_the_criterion_where_the_response_is_non_linear():
    from study_robustness import find_fault

    def fault(expectation, half, value=1.02):
        return find_fault(record(quantity(value, 0.02, [value - half, value + half]), expectation=expectation))

    assert fault("measured", 0.03) == "gain" and fault("measured", 0.03, 1.009) == ""
    assert fault("non-linear", 0.03) == "" and fault("non-linear", 0.01) == "gain"
    assert fault("processed", 0.01) == ""
    assert find_fault(record(quantity(None, status="not-identifiable"), expectation="non-linear")) == "no gain"
    failed = record(quantity(None, status="failed"), expectation="refused")
    assert find_fault(failed) == "no variance-not-affine"
    failed["report"]["warnings"] = [{"code": "variance-not-affine"}]
    assert find_fault(failed) == ""


def test_the_efficiency_is_the_rms_error_over_the_bound(capsys):
    from study_efficiency import print_rows

    names = ("intercept", "offset", "read_noise", "flicker_sd", "vibration_sd_x", "vibration_sd_y")
    others = dict.fromkeys(names)
    further = {"limit": {"gain": 0.01} | others, "unclipped_fraction": 1.0, "offset_limit_of_range": None}
    records = [
        record(quantity(value, 0.01, [value - 0.02, value + 0.02]), truth={"gain": 1.0} | others, **further)
        for value in (1.01, 0.97, 1.01)
    ]
    print_rows("B3", records)
    row = capsys.readouterr().out.splitlines()[0].split()
    rms = math.sqrt((1 + 9 + 1) / 3)
    assert row[:2] == ["B3", "gain"] and row[3] == "-0.333" and row[5] == f"{rms:.2f}"
    assert row[6:10] == ["-0.33", "0.667", f"{rms:.2f}", "3/3"]


def test_a_demand_is_missed_by_too_few_stacks(capsys):
    from study_demands import coverage
    from study_sensors import print_demand

    def stacks(count, held):
        far = {True: [0.9, 1.1], False: [1.01, 1.1]}
        return [record(quantity(1.02, 0.01, far[n < held])) for n in range(count)]

    print_demand(coverage("gain"), [stacks(10, 9), stacks(10, 8)])
    print_demand(coverage("gain"), [stacks(10, 9), stacks(10, 9)])
    missed, worst, met, _ = capsys.readouterr().out.splitlines()
    assert "17/20   85.0 %  expected at least 90 %: MISS" in missed and "18/20   90.0 %" in met and met.endswith(": ok")
    tail = sum(math.comb(10, k) * 0.95**k * 0.05 ** (10 - k) for k in range(9))
    assert f"{tail:.2g} (8/10" in worst and worst.endswith("below 0.001: 0 of 2 settings")


def test_a_single_image_is_silent_if_its_gain_is_far_off_without_a_warning(capsys):
    from study_single import print_table

    def image(value, codes=()):
        others = {"case": "single/B/bars", "truth": {"gain": 1.0, "intercept": -36.0}}
        one = record(quantity(value, 0.1, [value - 0.2, value + 0.2]), **others)
        one["report"]["warnings"] = [{"code": code} for code in codes]
        return one

    print_table([image(1.3), image(1.3, ["texture-dominates"]), image(0.8, ["other"]), image(0.95)])
    _, row = capsys.readouterr().out.splitlines()
    name, scene, number, bias, rms, worst, z, held, _, warned, silent = row.split()
    assert (name, scene, number, bias, worst) == ("B", "bars", "4/4", "+8.75", "30.00")
    assert rms == f"{100 * math.sqrt((0.09 + 0.09 + 0.04 + 0.0025) / 4):.2f}" and z == f"{float(rms) / 10:.2f}"
    assert (held, warned, silent) == ("2/4", "1", "2")


def test_a_composite_is_compared_with_the_program_of_the_paper():
    from study_single import verdict_on

    paper = (1.01, 0.005)
    assert [verdict_on(mean, 1.0, paper) for mean in (1.009, 0.991, 1.014, 1.016, 0.985)] == [
        *("closer", "closer", "within", "neither", "neither")
    ]


def test_the_paper_has_a_figure_for_each_quantity():
    from study_paper import QUANTITIES, TABLES

    figures = [row.split() for table in TABLES.values() for row in table.values()]
    assert len(figures) == 16 and {len(row) for row in figures} == {len(QUANTITIES)}


def run(*arguments):
    program = Path(os.environ["SENSORNOISE_BIN"]) / "measure-cases"
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)


@needs_programs
def test_the_lines_do_not_depend_on_the_number_of_threads():
    cases = ("efficiency/B3/target", "robustness/hot_pixels/texture", "check/B3/target", "sensors/crossing/*20 frames*")
    one = run(*cases, "--size", 64, "--frames", 20, "--seeds", 2, "--threads", 1)
    assert one.returncode == 0, one.stderr
    three = run(*cases, "--size", 64, "--frames", 20, "--seeds", 2, "--threads", 3)
    assert three.stdout == one.stdout
    records = [json.loads(line) for line in one.stdout.splitlines()]
    assert [record["seed"] for record in records] == [1, 2] * 5
    assert len({record["case"] for record in records}) == 5  # the last pattern has two scenes


@needs_programs
def test_tables_are_made_of_what_the_program_prints(tmp_path, capsys):
    import study_tables

    cases = ("efficiency/B3/target", "robustness/hot_pixels/target", "check/B3/target", "sensors/plain/B3, plain, 50*")
    cases += ("single/B/target", "single/B3 composite/target")
    done = run(*cases, "--size", 96, "--frames", 30)
    (tmp_path / "cases.jsonl").write_text(done.stdout)
    assert study_tables.main([str(tmp_path / "cases.jsonl")]) == 0
    text = capsys.readouterr().out
    for expected in (
        "B3    gain",
        "hot_pixels           target",
        "0 of 1 missed",
        "plain, all settings together: 2 stacks",
        "B          target        ",
        "B3   target   gain              1 ",
    ):
        assert expected in text
    assert study_tables.main(["--paper", str(tmp_path / "cases.jsonl")]) == 0
    assert "1.00±0.00" in capsys.readouterr().out


@needs_programs
def test_each_plane_of_a_mosaic_has_a_line():
    done = run("efficiency/B3/target", "--size", 128, "--frames", 20, "--bayer", "RGGB")
    planes = [json.loads(line) for line in done.stdout.splitlines()]
    assert [record["plane"] for record in planes] == ["R", "G1", "G2", "B"]


@needs_programs
@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["efficiency/D9/*"], 'no case has the name "efficiency/D9/*"; --list prints all names'),
        ([], "no CASE was given; --list prints all names"),
    ],
)
def test_wrong_use_ends_in_a_sentence(arguments, sentence):
    done = run(*arguments)
    assert done.returncode == 2 and done.stdout == "" and sentence in done.stderr
