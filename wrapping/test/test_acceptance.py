# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the acceptance suite: verdicts, sums, comparisons, continued runs, and one line with the built programs."""

import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"
TRUTH = {"gain": 0.5, "offset": 100.0, "read_noise": 3.0}
SIGNAL_RANGE = 2500.0  # [DN]


@pytest.fixture(autouse=True)
def examples(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))


def quantity(value, error, status="identified"):
    return {
        "value": value,
        "standard_error": error,
        "interval95": [value - 2 * error, value + 2 * error],
        "status": status,
    }


def evaluated(gain=(0.5, 0.001), offset=(100, 1), loud=(), expected="measured", status="identified"):
    from acceptance_stacks import evaluate

    found = {"gain": quantity(*gain, status), "offset": quantity(*offset), "read_noise": quantity(3, 0.1)}
    return evaluate(found, TRUTH, SIGNAL_RANGE, list(loud), expected)


@pytest.mark.parametrize(
    ("gain", "is_wrong"),
    [
        ((0.506, 0.001), True),  # 6 standard errors and 1.2 %
        ((0.504, 0.0001), False),  # 40 standard errors, but 0.8 %
        ((0.530, 0.010), False),  # 6 %, but 3 standard errors
    ],
)
def test_a_gain_is_wrong_beyond_chance_and_a_smallest_size(gain, is_wrong):
    stack = evaluated(gain)
    assert (stack["wrong"] == ["gain"]) == stack["silent"] == is_wrong
    assert stack["error"] == pytest.approx(gain[0] / 0.5 - 1)
    assert stack["z"] == pytest.approx((gain[0] - 0.5) / gain[1])


def test_a_warning_breaks_the_silence():
    stack = evaluated((0.6, 0.001), loud=["not-static"])
    assert stack["wrong"] == ["gain"] and not stack["silent"]


def test_an_offset_is_tested_by_the_signal_range():
    assert evaluated(offset=(126, 1))["wrong"] == ["offset"]  # 26 of 2500 DN
    assert evaluated(offset=(124, 1))["wrong"] == []


def test_a_gain_that_cannot_be_determined_is_wrong_if_identified():
    assert evaluated(expected="must refuse")["wrong"] == ["gain"]
    stack = evaluated((0.9, 0.001), expected="must refuse", status="not-identifiable")
    assert stack["refused"] and not stack["wrong"] and stack["error"] is None and "gain" not in stack["covered"]


def stacks_of(gains, line="a", **options):
    """Returns the results of a line, one stack per seed."""
    return {
        (line, "target", "", n, "r"): evaluated(gain, **options) | {"bound": 0.002, "seconds": 1.0} for n, gain in gains
    }


def test_a_line_is_summed_up():
    from acceptance_compare import summarise

    stacks = [*stacks_of([(0, (0.502, 0.002)), (1, (0.497, 0.002)), (2, (5.0, 0.001))]).values()]
    stacks.append({**evaluated(status="failed"), "bound": 0.002, "seconds": 3.0})
    row = summarise(stacks)
    assert row["stacks"] == 4 and row["refused"] == row["wrong"] == row["silent"] == 1
    assert row["error"] == pytest.approx((0.004 + 0.006 + 1.0) / 3)  # the error of the last stack is 900 %
    assert row["over_bound"] == pytest.approx(math.sqrt((2**2 + 3**2 + 4500**2) / 3))
    assert row["held"]["gain"] == (2, 3) and row["held"]["offset"] == (4, 4)
    assert row["seconds"] == 1.5
    assert row["faults"] == ["silent", "refused 1"]


@pytest.mark.parametrize(("ours", "is_fault"), [(0.001, False), (0.002, False), (0.005, True)])
def test_a_line_is_held_against_emvas_errors(ours, is_fault):
    """The ratio 2.96 of rms errors of 10 stacks is exceeded with a probability of 0.001: F(10, 10) = 8.75."""
    from acceptance_compare import summarise

    emva = {"emva_error": 0.0015, "seconds": 1.0, "bound": None}
    stacks = [evaluated((0.5 + 0.5 * ours * (-1) ** n, 0.01)) | emva for n in range(10)]
    stacks.append(evaluated(status="failed") | emva | {"emva_error": 9.0})
    row = summarise(stacks)
    assert row["over_emva"] == pytest.approx(ours / 0.0015)
    assert ("above EMVA" in row["faults"]) == is_fault


@pytest.mark.parametrize("dof", [1, 2, 3, 4])
def test_students_distribution_is_the_closed_form(dof):
    from acceptance_compare import CHANCE, student_factor

    t = student_factor(dof)
    closed = {
        1: 2 / math.pi * math.atan(t),
        2: t / math.sqrt(2 + t**2),
        3: 2 / math.pi * (math.atan(t / math.sqrt(3)) + t / math.sqrt(3) / (1 + t**2 / 3)),
        4: t / math.sqrt(4 + t**2) * (1 + 2 / (4 + t**2)),
    }
    assert closed[dof] == pytest.approx(math.erf(CHANCE / math.sqrt(2)), abs=1e-12)


def test_chance_needs_more_standard_errors_of_few_stacks():
    from acceptance_compare import student_factor

    assert student_factor(2) == pytest.approx(19.2, abs=0.05)  # 0.27 % quantile for 2 degrees of freedom
    assert student_factor(10_000) == pytest.approx(3.0, abs=0.01)


def test_few_intervals_that_hold_are_improbable():
    from acceptance_compare import lower_tail

    assert lower_tail(1, 2, 0.95) == pytest.approx(1 - 0.95**2)
    assert lower_tail(2000, 2000, 0.95) == pytest.approx(1.0)
    assert lower_tail(1900, 2000, 0.95) == pytest.approx(
        0.52, abs=0.03
    )  # a half, and half of the probability of 1900 itself


def test_the_same_results_are_the_same():
    from acceptance_compare import compare

    stacks = stacks_of([(n, (0.5 + 0.001 * n, 0.002)) for n in range(5)])
    line = compare(stacks, stacks)["a"]
    assert line["verdict"] == "same" and line["differences"]["error"].changed == 0 and line["time"] == 1.0


def test_paired_errors_that_all_grow_are_worse_and_scattered_ones_are_not():
    from acceptance_compare import compare

    old = stacks_of([(n, (0.502 + 0.0002 * n, 0.01)) for n in range(9)])
    grown = stacks_of([(n, (0.503 + 0.0002 * n + 0.0001 * (n % 2), 0.01)) for n in range(9)])
    mixed = stacks_of([(n, (0.502 + 0.0002 * n + 0.002 * (-1) ** n, 0.01)) for n in range(9)])
    assert compare(old, grown)["a"]["verdict"] == "worse" and compare(old, grown)["a"]["by"] == ["error"]
    assert compare(grown, old)["a"]["verdict"] == "better"
    assert compare(old, mixed)["a"]["verdict"] == "same"


@pytest.mark.parametrize(("count", "verdict"), [(2, "same"), (12, "better")])
def test_silence_decides_before_failures(count, verdict):
    from acceptance_compare import compare

    old = stacks_of([(n, (0.6, 0.001)) for n in range(count)])
    new = stacks_of([(n, (0.6, 0.001)) for n in range(count)], status="not-identifiable")
    assert compare(old, new)["a"]["verdict"] == verdict


def test_all_lines_of_a_kind_are_compared_together():
    from acceptance_compare import compare

    old, new = {}, {}
    for line in ("kind/a", "kind/b", "kind/c"):  # each line alone has too few stacks
        old |= stacks_of([(n, (0.5, 0.001)) for n in range(4)], line, offset=(150, 1))
        new |= stacks_of([(n, (0.5, 0.001)) for n in range(4)], line)
    verdicts = {name: (line["verdict"], line["silent"]) for name, line in compare(old, new).items()}
    assert verdicts == {
        **dict.fromkeys(["kind/a", "kind/b", "kind/c"], ("same", (4, 0))),
        "kind, all lines": ("better", (12, 0)),
    }


def test_settings_with_one_seed_count_as_a_group():
    from acceptance_compare import scatter_of

    alone = [(n, float(n // 8)) for n in range(16)]
    shared = [(n // 8, float(n // 8)) for n in range(16)]
    assert scatter_of(alone) == pytest.approx(math.sqrt(4 / 15) / 4)
    assert scatter_of(shared) == pytest.approx(0.5)  # half the difference of the two means, which is 1


def test_what_the_file_has_is_not_run_again(tmp_path):
    from acceptance_jobs import Job, append_result, missing_jobs, read_results, stacks_of

    name = tmp_path / "results.jsonl"
    jobs = [Job("a", "target", seed, "size 9", program, list) for program in ("old", "new") for seed in (1, 2)]
    append_result(name, jobs[0], [{"setting": "x"}, {"setting": "y"}])
    with name.open("a") as file:
        file.write('{"line": "a", "vari')  # incomplete line, as after a crash
    assert missing_jobs(jobs, read_results(name)) == jobs[1:]
    append_result(name, jobs[3], [{"setting": "x"}])
    records = read_results(name)
    assert missing_jobs(jobs, records) == jobs[1:3]
    assert list(stacks_of(records)) == [("a", "target", "x", 2, "size 9")]  # the result of the last program
    assert len(stacks_of(records, jobs[:2])) == 2


def record(case, gain, status="identified", **members):
    """Returns a record of measure-cases with a true gain of 0.5 DN/e-."""
    report = {"gain": quantity(*gain, status), "offset": quantity(101.0, 0.4), "warnings": []}
    return {"case": case, "truth": {"gain": 0.5, "offset": 100.0}, "report": report} | members


@pytest.mark.parametrize(
    ("expectation", "status", "expected"),
    [
        ("measured", "identified", {"refused": False, "wrong": ["gain"], "silent": True, "expected": "measured"}),
        ("refused", "failed", {"refused": True, "wrong": [], "silent": False, "expected": "must refuse"}),
        ("refused", "identified", {"refused": False, "wrong": ["gain"], "silent": True}),
        ("processed", "not-identifiable", {"refused": True, "wrong": [], "expected": "may refuse"}),
    ],
)
def test_a_robustness_case_is_tested_by_its_expectation(expectation, status, expected):
    from acceptance_studies import evaluate_record

    stack = evaluate_record(record("robustness/a/target", (0.51, 0.001), status, expectation=expectation))
    assert {name: stack[name] for name in expected} == expected
    assert stack["covered"]["offset"] is False and stack["setting"] == ""  # 2.5 standard errors, interval of 2


def test_the_offset_of_a_study_has_no_size_to_be_held_against():
    from acceptance_studies import evaluate_record

    stack = evaluate_record(record("efficiency/B3/target", (0.5, 0.001), limit={"gain": 0.0005}))
    assert stack["wrong"] == [] and stack["bound"] == 0.001


def test_a_setting_of_the_sensors_is_named_by_the_case():
    from acceptance_studies import evaluate_record

    stack = evaluate_record(record("sensors/bends/wave 0.02, 50 frames/texture", (0.5, 0.001)))
    assert stack["setting"] == "wave 0.02, 50 frames/texture" and stack["expected"] == "may refuse"


@pytest.mark.skipif("SENSORNOISE_BIN" not in os.environ, reason="SENSORNOISE_BIN names no folder of the tools")
def test_one_line_is_measured_once(tmp_path):
    name = tmp_path / "results.jsonl"
    script = [sys.executable, str(EXAMPLES / "measure_acceptance.py")]
    lines = ["--lines", "illumination/steady", "exposures/5x2", "unlike/dark-first", "--seeds", "1", "--jobs", "2"]
    command = [*script, "--quick", "--bin", os.environ["SENSORNOISE_BIN"], *lines, "--results", str(name)]
    first = subprocess.run(command, capture_output=True, text=True, check=False)
    assert first.returncode == 0 and "18 jobs" in first.stderr, first.stderr
    again = subprocess.run(command, capture_output=True, text=True, check=False)
    assert again.stdout == first.stdout and "0 jobs" in again.stderr
    steady, series, dark = (line.split() for line in first.stdout.splitlines()[1:4])
    assert steady[:2] == ["illumination/steady", "6"] and dark[:2] == ["unlike/dark-first", "6"]
    assert float(steady[2]) < 1 and steady[11] == "0"  # error [%] and number of wrong stacks
    assert series[:2] == ["exposures/5x2", "6"] and steady[4] == "-" and float(series[4]) < 10  # error over EMVA's
    done = subprocess.run([*script, "--compare", str(name), str(name)], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stdout.endswith("0 better, 6 same, 0 worse\n")
