# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that help() of the classes shows the comments of their headers."""

import pydoc
import re
from pathlib import Path

import itk
import pytest
from itk.support.base import itk_base_global_module_data

FEATURES = itk_base_global_module_data["SensorNoise"].get_all_template_features()
NAMES = sorted({feature.get_python_class_name() for feature in FEATURES})
HEADERS = Path(__file__).resolve().parents[2] / "filters"


def sentence_of(name):
    """Returns the first sentence of the comment of a class in its header."""
    comment = re.search(rf"\\class {name}\n \* \\brief (.*)", (HEADERS / f"itk{name}.h").read_text())
    return re.split(r"[\\(]", comment[1])[0].strip()


def test_all_classes_are_looked_at():
    wrapped = sorted(path.stem.removeprefix("itk") for path in (HEADERS.parent / "wrapping").glob("*.wrap"))
    assert wrapped == [name for name in NAMES if name != "SensorNoiseImageIOFactory"]  # shares a file with its ImageIO
    assert len(NAMES) >= 11


@pytest.mark.parametrize("name", NAMES)
def test_help_is_the_header_s(name):
    template = getattr(itk, name)
    for described in [template, *(template.values() if hasattr(template, "values") else ())]:
        text = described.__doc__
        assert text.startswith(sentence_of(name)) and len(text) > 200
        assert "Proxy of" not in text and not re.search(r"\\\\[a-z]+|^ ?\*", text, re.MULTILINE)
        assert sentence_of(name) in pydoc.render_doc(described, renderer=pydoc.plaintext)


def test_help_describes_the_parameters():
    cls = itk.SensorNoiseEstimator[itk.Image[itk.US, 3]]
    assert cls.SetBitDepth.__doc__.startswith("Bit depth of the sensor's digital numbers [bit], 1 to 16.")
    assert "SetBitDepth(self" in cls.SetBitDepth.__doc__  # the text of SWIG stays
    assert cls.SetDarkQuantile.__doc__.startswith("Quantiles of the mean") and "Refined" in cls.SetMethod.__doc__
    assert itk.SensorNoiseStackSource[itk.Image[itk.US, 3]].SetPrnuSd.__doc__.startswith("Photo-response")


@pytest.mark.parametrize("name", ["temporal_statistics_image_filter", "vibration_mask_image_filter"])
def test_help_of_the_functional_style_is_the_class_s(name):
    class_name = "".join(word.capitalize() for word in name.split("_"))
    assert sentence_of(class_name) in getattr(itk, name).__doc__


def test_documentation_is_there_at_the_first_use(fresh):
    code = "import itk; print(len(itk.VibrationMaskImageFilter.__doc__))"
    again = "import itk, importlib; itk.VibrationMaskImageFilter; importlib.reload(itk); " + code
    assert fresh(code) == fresh(again)
