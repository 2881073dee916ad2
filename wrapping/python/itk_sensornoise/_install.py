# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Sets the functions of this package on `itk`."""

import sys

_NEW = ("estimate_sensor_noise", "simulate_sensor_noise")
# ITK generates functions of these names too; what they return holds a C++ struct that Python cannot open, or they must
# be told the pixel type.
_REPLACED = (
    "noise_correlation_estimator",
    "noise_regression_estimator",
    "sensor_noise_estimator",
    "sensor_noise_frame_list_source",
    "vibration_covariance_estimator",
)
_MODULE = "SensorNoise"


def _replace_generated() -> None:
    """Puts our functions into ITK's module of generated ones, if that is loaded: ITK copies them from there."""
    import itk_sensornoise

    generated = sys.modules.get(f"itk.{_MODULE}Python")
    if generated is not None:
        for name in _REPLACED:
            setattr(generated, name, getattr(itk_sensornoise, name))


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
