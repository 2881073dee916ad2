# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The commands of the documents that check_documents.py does not run, each with the reason."""

_BUILDS = "builds or tests the whole project: continuous integration runs it"
_STUDY = "takes minutes or hours: the tables of the documents come from it"
_FILES = "needs raw files of a camera at several exposures; the same with FITS files is a test of the tool"

_NAPARI = "needs napari: test/run.sh installs it and runs its test"

NOT_RUN = {
    "pip install itk-sensornoise": _NAPARI,
    'pip install pytest "napari[pyqt5]" dist/itk_sensornoise-*.whl': _NAPARI,
    "QT_QPA_PLATFORM=offscreen pytest wrapping/test/test_napari.py": _NAPARI,
    "bash test/run.sh": _BUILDS,
    "bash examples/browser/build.sh": _BUILDS,
    "python3 test/fuzz/fuzz_files.py --bin build/bin --count 20000": _STUDY,
    "python examples/python/measure_speed.py --bin build/bin --opencv ENV/bin/python "
    "--anscombe-transform ENV/bin/python --nanoimagingpack ENV/bin/python": _STUDY,
    **{
        f"python examples/python/measure_acceptance.py {options}": _STUDY
        for options in (
            "--quick --results before.jsonl",
            "--quick --results after.jsonl",
            "--compare before.jsonl after.jsonl",
        )
    },
    **dict.fromkeys(
        (
            "measure-cases 'efficiency/*/target' --seeds 24 >efficiency.jsonl",
            "python examples/python/study_tables.py efficiency.jsonl",
            "measure-cases 'efficiency/*/target' --method published --seeds 20 >table2.jsonl",
            "python examples/python/study_tables.py --paper table2.jsonl",
            "measure-cases 'single/*' --seeds 20 >single.jsonl",
            "python examples/python/study_tables.py single.jsonl",
            "python examples/python/compare_methods.py --bin build/bin --peers environments",
            "python examples/python/study_likelihood.py --bin build/bin --seeds 10",
            "python examples/python/study_ablation.py --bin build/bin --seeds 3 --lines 'drawn/*'",
        ),
        _STUDY,
    ),
    "estimate-sensor-noise flat_*.dng --dark dark_*.dng --method emva1288": _FILES,
    "bash wrapping/build-wheel.sh && pip install dist/itk_sensornoise-*.whl": _BUILDS,
}

# Programs that a build or a computer may lack; their commands are then not run.
OPTIONAL = {
    "stabilise-mats": "needs OpenCV with image and video files",
    "exiftool": "needs exiftool",
}
