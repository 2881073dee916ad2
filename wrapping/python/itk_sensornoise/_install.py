# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Sets the functions of this package on `itk`, and the docstrings of its classes."""

import inspect
import sys
from types import FunctionType

_NEW = (
    "check_noise_model",
    "check_noise_profile",
    "denoise_with_noise_model",
    "estimate_sensor_noise",
    "estimate_sweep",
    "evaluate_emva1288",
    "simulate_sensor_noise",
)
# ITK generates functions of these names too; what they return holds a C++ struct that Python cannot open, or they must
# be given the pixel type, or do not accept a report.
_REPLACED = (
    "flicker_correction_image_filter",
    "generalized_anscombe_image_filter",
    "inverse_generalized_anscombe_image_filter",
    "noise_correlation_estimator",
    "noise_regression_estimator",
    "sensor_noise_estimator",
    "sensor_noise_frame_list_source",
    "single_image_noise_estimator",
    "temporal_statistics_image_filter",
    "vibration_covariance_estimator",
    "vibration_mask_image_filter",
)
_MODULE = "SensorNoise"

# Methods whose result is an enumeration of C++, which Python cannot open and SWIG warns of when it goes, and those that
# return its name.
_NAMED = {
    "GetInverse": "GetInverseName",
    "GetMethod": "GetMethodName",
    "GetRollingShutter": "GetRollingShutterName",
}
# Methods whose result is a struct of C++, which Python cannot open; the same is in methods that end in AsJson, or in
# numbers and vectors that have a method each.
_CLOSED = (
    *("GetBrightSet", "GetChannelReports", "GetDarkSet", "GetFlicker", "GetNoiseCorrelation", "GetReport"),
    *("GetResult", "GetSource", "GetSummary", "GetTruth"),
)


def _open(cls: type) -> None:
    """Gives a class the methods that Python can use in place of those that it cannot."""
    for name in _CLOSED:
        if isinstance(vars(cls).get(name), FunctionType):
            delattr(cls, name)
    for name, readable in _NAMED.items():
        if isinstance(vars(cls).get(name), FunctionType) and readable in vars(cls):
            setattr(cls, name, vars(cls)[readable])


def _document(cls: type, text: str, methods: dict[str, str]) -> None:
    """Sets the docstring of a class, and puts the comments of its header before SWIG's docstrings of its methods."""
    cls.__doc__ = text
    for name, words in methods.items():
        method = vars(cls).get(name)
        if isinstance(method, FunctionType) and not (method.__doc__ or "").startswith(words):
            method.__doc__ = f"{words}\n\n{inspect.cleandoc(method.__doc__ or '')}"


def _replace_generated() -> None:
    """Puts our functions into ITK's module of generated ones, if that is loaded: ITK copies them from there.

    Its classes get the documentation of their headers."""
    from itk.support.base import itk_base_global_module_data
    from itk.support.template_class import itkTemplate

    import itk_sensornoise

    generated = sys.modules.get(f"itk.{_MODULE}Python")
    if generated is None:
        return
    for name in _REPLACED:
        setattr(generated, name, getattr(itk_sensornoise, name))

    from ._class_docs import CLASS_DOCS

    for feature in itk_base_global_module_data[_MODULE].get_all_template_features():
        cls = getattr(generated, feature.get_swig_class_name(), None)
        docs = CLASS_DOCS.get(feature.get_python_class_name())
        if cls is not None:
            _open(cls)
        if cls is not None and docs is not None:
            _document(cls, *docs)
            itkTemplate(feature.get_cpp_class_name()).__doc__ = docs[0]


def install() -> None:
    """Sets the functions on `itk`; called by ITK at the end of `import itk`, and of each reload.

    ITK loads a module at the first use of one of its classes and then writes all of its names to `itk`, the generated
    functions over ours. It asks its record of the module for their names just before: that is where ours take their
    place.
    """
    import itk
    from itk.support.base import itk_base_global_module_data

    import itk_sensornoise

    for name in _NEW + _REPLACED:
        setattr(itk, name, getattr(itk_sensornoise, name))

    info = itk_base_global_module_data[_MODULE]
    names = tuple(info.get_snake_case_functions())

    def get_snake_case_functions() -> tuple[str, ...]:
        _replace_generated()
        return names

    info.get_snake_case_functions = get_snake_case_functions
    _replace_generated()
