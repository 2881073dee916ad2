# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the bursts that NumPy makes for measure_acceptance.py."""

import itertools
import os
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"


@pytest.fixture(autouse=True)
def examples(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))


def test_names_are_different_and_scenes_are_known():
    from situations import SCENES
    from situations_all import all_situations

    names = [situation.name for situation in all_situations()]
    assert len(set(names)) == len(names)
    assert all("/" in name for name in names)
    assert {scene for situation in all_situations() for scene in situation.scenes} <= set(SCENES)


def test_a_burst_depends_on_its_name_scene_and_number_alone():
    from situations_all import all_situations, make

    plain = next(situation for situation in all_situations() if situation.name == "plain/12-bits")
    first, same, other = (make(plain, "texture", number).frames for number in (1, 1, 2))
    assert np.array_equal(first, same)
    assert not np.array_equal(first, other)


def test_frames_have_the_noise_of_the_camera_model():
    from situations import expose

    random = np.random.default_rng(1)
    electrons = np.full((50, 60), 900.0)
    frames = expose(random, electrons, [0.5, 1.0, 2.0], gain=0.5, offset=100.0, read_noise=3.0)
    for frame, factor in zip(frames, (0.5, 1.0, 2.0), strict=True):
        variance = 0.25 * 900 * factor + 9.0
        # The mean of 3000 pixels, within 4 standard errors.
        assert frame.mean() == pytest.approx(100 + 450 * factor, abs=4 * (variance / 3000) ** 0.5)
        assert frame.var() == pytest.approx(variance, rel=4 * (2 / 3000) ** 0.5)


def test_digital_numbers_are_whole_and_clipped():
    from situations import digitise

    assert digitise(np.array([-3.2, 1.4, 1.6, 5000.0]), 12).tolist() == [0, 1, 2, 4095]


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "int16", "float32", "float64"])
def test_a_stack_of_any_type_is_read_as_it_was_written(dtype, tmp_path):
    itk = pytest.importorskip("itk")
    from frame_stacks import write_stack

    frames = np.arange(24).reshape(2, 3, 4).astype(dtype)
    write_stack(tmp_path / "burst.mha", frames)
    assert np.array_equal(itk.array_from_image(itk.imread(str(tmp_path / "burst.mha"))), frames)


def test_the_linearity_error_of_a_line_is_0_and_that_of_a_parabola_that_of_its_best_line():
    from situations_frames import linearity_error

    exposures = np.linspace(0.1, 0.9, 9)
    assert linearity_error(100 + 1000 * exposures, exposures, 100, 1100) == pytest.approx(0, abs=1e-9)
    levels = 100 + 1000 * exposures * (1 - 0.04 * exposures)
    signal = levels - 100

    def squares(line):
        return np.sum(((levels - line[0] - line[1] * exposures) / signal) ** 2)

    # The residuals of neighbouring lines are not smaller than the residuals of the line of the returned error.
    design = np.stack([np.ones(9), exposures], axis=1) / signal[:, None]
    line = np.linalg.solve(design.T @ design, design.T @ (levels / signal))
    for step in itertools.product((-0.01, 0.01), repeat=2):
        assert squares(line) < squares(line + np.array(step))
    fitted = line[0] + line[1] * exposures
    expected = 100 * np.mean(np.abs(levels - fitted) / (fitted - 100))
    assert linearity_error(levels, exposures, 100, 1100) == pytest.approx(expected)


def test_frames_unlike_the_others_are_counted():
    from acceptance_stacks import evaluate_frames

    assert evaluate_frames([3, 7, 9], (3, 9, 20)) == {"named": 2, "unlike": 3, "named_falsely": 1}


def test_a_situation_is_measured(tmp_path):
    programs = os.environ.get("SENSORNOISE_BIN")
    if not programs:
        pytest.skip("needs the built programs: SENSORNOISE_BIN")
    from acceptance_programs import Programs
    from situations_all import all_situations, measure

    chosen = next(situation for situation in all_situations() if situation.name == "frames/zeros-1")
    (stack,) = measure(Programs(Path(programs), Path(programs)), chosen, "patches", 1)
    assert not stack["refused"]
    assert stack["wrong"] == []
    assert (stack["named"], stack["unlike"], stack["named_falsely"]) == (1, 1, 0)


def test_without_the_gains_of_parts_quadrants_are_not_noticed(capsys):
    programs = os.environ.get("SENSORNOISE_BIN")
    if not programs or not Path(programs, "measure-varied-stack").exists():
        pytest.skip("needs measure-varied-stack: SENSORNOISE_BIN, and SensorNoise_BUILD_INFLUENCE=ON")
    import study_ablation

    chosen = ["--bin", programs, "--lines", "parts/quadrants-2", "--mechanism", "gains of parts"]
    assert study_ablation.main(chosen) == 0
    title, _, *rows = capsys.readouterr().out.splitlines()
    assert title.startswith("3 of 3 bursts")
    cells = rows[-1].split(" | ")
    assert cells[0] == "| gains of parts"
    assert cells[2] == "3"  # reports that change
    with pytest.raises(SystemExit):
        study_ablation.main([*chosen, "--mechanism", "none of them"])


def test_constants_that_switch_a_mechanism_off_exist():
    programs = os.environ.get("SENSORNOISE_BIN")
    if not programs or not Path(programs, "measure-varied-cases").exists():
        pytest.skip("needs measure-varied-cases: SENSORNOISE_BIN, and SensorNoise_BUILD_INFLUENCE=ON")
    from study_ablation import MECHANISMS
    from study_influence import constants_of

    names = {name for mechanism in MECHANISMS for name in mechanism.off}
    assert set(constants_of(Path(programs, "measure-varied-cases"), names)) == names
    assert len({mechanism.name for mechanism in MECHANISMS}) == len(MECHANISMS)
