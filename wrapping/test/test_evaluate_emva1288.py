# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests evaluate_emva1288() on frames of a simulated camera, against the tool, single planes, and the truth."""

import json
import pickle

import itk
import itk_sensornoise as sn
import numpy as np
import pytest

GAIN, OFFSET, DARK_NOISE = 0.5, 60.0, 6.0  # [DN/e-], [DN], [e-]
SATURATION = 4095  # [DN]
ELECTRONS = 8600.0  # signal at the exposure 1 [e-]: 4360 DN
EXPOSURES = [0.1 * level for level in range(1, 11)]
SIZE = (48, 64)  # rows, columns [pixel]


def frames_of(exposure, count, seed):
    """Returns frames (count, y, x) of one exposure, 12 bits."""
    noise = np.random.default_rng(seed)
    electrons = noise.poisson(ELECTRONS * exposure, (count, *SIZE)) + noise.normal(0.0, DARK_NOISE, (count, *SIZE))
    return np.clip(np.round(OFFSET + GAIN * electrons), 0, SATURATION).astype(np.uint16)


@pytest.fixture(scope="module")
def flats():
    return {exposure: frames_of(exposure, 2, 10 + n) for n, exposure in enumerate(EXPOSURES)}


@pytest.fixture(scope="module")
def darks():
    return {0.0: frames_of(0.0, 4, 1)}


@pytest.fixture(scope="module")
def report(flats, darks):
    photons = {exposure: 2.0 * ELECTRONS * exposure for exposure in EXPOSURES}
    return sn.evaluate_emva1288(flats, darks, photons=photons, bit_depth=12, exposure_unit="s")


def test_truth_is_found_within_the_errors(report):
    # 4 standard errors: of 4 quantities, one is outside by chance in 4000 runs. The seed is fixed.
    for quantity, truth in (
        (report.gain, GAIN),
        (report.weighted_gain, GAIN),
        (report.dark_noise, DARK_NOISE),
        (report.quantity("sensitivity.quantum_efficiency"), 50.0),
    ):
        assert abs(quantity.value - truth) < 4.0 * quantity.standard_error < 0.15 * truth
    assert report["settings"] == {"quantisation_step": 1.0, "bit_depth": 12, "exposure_unit": "s"}
    assert "not-saturated" not in {note["code"] for note in report["notes"]}


def rounded(record):
    """Returns a record with numbers of 12 digits: two compilations may round the last digits otherwise."""
    if isinstance(record, dict):
        return {name: rounded(value) for name, value in record.items()}
    if isinstance(record, list):
        return [rounded(value) for value in record]
    return float(f"{record:.12g}") if isinstance(record, float) else record


def test_tool_says_the_same(report, flats, darks, tool, tmp_path):
    lines = ["exposure_s,kind,photons,files"]
    for kind, all_frames in (("flat", flats), ("dark", darks)):
        for exposure, frames in all_frames.items():
            name = f"{kind}{exposure:.1f}.npy"
            np.save(tmp_path / name, frames)
            photons = repr(2.0 * ELECTRONS * exposure) if kind == "flat" else ""
            lines.append(f"{exposure!r},{kind},{photons},{name}")
    (tmp_path / "list.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    record, xml = tmp_path / "record.json", tmp_path / "record.xml"
    options = ("--method", "emva1288", "--bit-depth", "12", "--json", record, "--xml", xml)
    table = tool("estimate-sensor-noise", tmp_path / "list.csv", *options)
    assert rounded(json.loads(record.read_text(encoding="utf-8"))) == rounded(report.to_dict())
    assert xml.read_text(encoding="utf-8") == report.to_xml()
    assert table.rstrip("\n") == str(report)
    names = {exposure: str(tmp_path / f"flat{exposure:.1f}.npy") for exposure in EXPOSURES}
    assert sn.evaluate_emva1288(names, darks)["points"][3]["mean"] == report["points"][3]["mean"]


class Lazy:
    """Frames that are read when they are asked for."""

    def __init__(self, frames):
        self._frames, self.shape, self.dtype = frames, frames.shape, frames.dtype

    def __getitem__(self, times):
        return self._frames[times]


class Broken(Lazy):
    """Frames that cannot be read."""

    def __getitem__(self, times):
        raise LookupError("the disk is gone")


def test_frames_may_be_given_in_any_form(report, flats, darks):
    def evaluated(flats, darks, **options):
        return sn.evaluate_emva1288(flats, darks, bit_depth=12, exposure_unit="s", **options)

    expected = evaluated(flats, darks)
    assert expected == evaluated({exposure: list(pair) for exposure, pair in flats.items()}, darks)
    assert expected == evaluated(list(flats.items()), [(0.0, darks[0.0])], threads=1)
    assert expected == evaluated({exposure: Lazy(pair) for exposure, pair in flats.items()}, darks)
    assert expected == itk.evaluate_emva1288(flats, darks, bit_depth=12, exposure_unit="s", roi=(0, 0, 64, 48))
    assert expected.gain == report.gain


def test_masked_pixels_are_refused(flats, darks):
    masked = np.ma.masked_greater(flats[EXPOSURES[-1]], 4000)
    array = pytest.importorskip("dask.array")
    for frames in (masked, array.from_array(masked)):
        with pytest.raises(
            TypeError, match="^flats of the exposure 1 is a masked array, expected a plain one: fill in"
        ):
            sn.evaluate_emva1288({**flats, EXPOSURES[-1]: frames}, darks)


def test_longer_series_gives_the_non_uniformity(flats, darks):
    long = frames_of(0.5, 6, 99)
    report = sn.evaluate_emva1288([*flats.items(), (0.5, long)], darks)
    assert report["series"][report["bright_series"]]["frames"] == 6
    assert [point["frames"] for point in report["points"]] == [2] * len(EXPOSURES)


@pytest.mark.parametrize("roi", [None, (3, 5, 50, 42)])
def test_planes_of_a_mosaic_are_evaluated_by_themselves(flats, darks, roi):
    reports = sn.evaluate_emva1288(flats, darks, bayer="RGGB", roi=roi)
    assert list(reports) == ["R", "G1", "G2", "B"]
    # GRBG and the other patterns begin with another plane; (3, 5) leaves BGGR
    start = {"R": (0, 0), "G1": (0, 1), "G2": (1, 0), "B": (1, 1)}
    x, y, width, height = roi or (0, 0, SIZE[1], SIZE[0])
    for plane, (row, column) in start.items():
        rows = slice(y + (row - y) % 2, y + height, 2)
        columns = slice(x + (column - x) % 2, x + width, 2)
        expected = sn.evaluate_emva1288(
            {exposure: pair[:, rows, columns] for exposure, pair in flats.items()},
            {0.0: darks[0.0][:, rows, columns]},
        )
        assert reports[plane] == expected


def test_record_travels(report):
    again = pickle.loads(pickle.dumps(report))
    assert (again, str(again), again.to_xml()) == (report, str(report), report.to_xml())
    rows = {row["path"]: row["value"] for row in report.quantities()}
    assert rows["spatial.prnu"] == report.prnu.value and rows["linearity.linearity_error"] == (
        report.linearity_error.value
    )
    assert "system gain" in report._repr_html_() and repr(report).startswith("<Emva1288Report: 10 exposures, gain 0.")
    with pytest.raises(KeyError, match="is no quantity"):
        report.quantity("spatial.gain")
    with pytest.raises(TypeError, match="cannot be changed"):
        report["points"] = []


PAIR = frames_of(0.5, 2, 3)
DARK = {0.0: frames_of(0.0, 2, 4)}


@pytest.mark.parametrize(
    ("flats", "darks", "options", "kind", "message"),
    [
        (PAIR, DARK, {}, TypeError, "flats is of type ndarray; expected a mapping"),
        ({}, DARK, {}, ValueError, "flats is empty"),
        ([PAIR], DARK, {}, TypeError, "flats holds a ndarray; expected a mapping"),
        ({-1.0: PAIR}, DARK, {}, ValueError, "an exposure of flats is -1.0; expected a finite number of 0 or more"),
        ({0.5: PAIR[:1]}, DARK, {}, ValueError, "flats of the exposure 0.5: a series has 1 frame; expected 2"),
        ({0.5: PAIR[0]}, DARK, {}, ValueError, "flats of the exposure 0.5 has 2 dimensions"),
        ({0.5: PAIR}, DARK, {}, ValueError, "expected"),
        ({0.5: PAIR}, {0.0: PAIR[:, 1:]}, {}, ValueError, "darks of the exposure 0 have 64 x 47 pixels"),
        ({0.5: PAIR}, {0.0: PAIR.astype(float)}, {}, ValueError, "of type float64; expected 64 x 48 pixels of type"),
        ({0.5: PAIR}, DARK, {"photons": {0.4: 1.0}}, ValueError, "photons has no number for the exposure 0.5"),
        ({0.5: PAIR}, DARK, {"photons": [1.0]}, TypeError, "photons is"),
        ({0.5: PAIR}, DARK, {"step": 0.0}, ValueError, "step is 0.0; expected a number above 0"),
        ({0.5: PAIR}, DARK, {"bit_depth": 17}, ValueError, "bit_depth is 17; expected a whole number from 1 to 16"),
        ({1: PAIR, 2: PAIR, 3: PAIR}, DARK, {"bit_depth": 8}, ValueError, "DN, but 8 bits with a quantization step"),
        ({0.5: PAIR}, DARK, {"bayer": "moon"}, ValueError, "bayer is 'moon'"),
        ({0.5: PAIR}, DARK, {"exposure_unit": "h"}, ValueError, "exposure_unit is 'h'; expected 's'"),
        ({0.5: PAIR}, DARK, {"roi": (0, 0, 99, 9)}, ValueError, "roi is"),
        ({0.5: Broken(PAIR)}, DARK, {}, LookupError, "the disk is gone"),
    ],
)
def test_input_that_cannot_be_evaluated_is_named(flats, darks, options, kind, message):
    with pytest.raises(kind, match=message):
        sn.evaluate_emva1288(flats, darks, **options)
