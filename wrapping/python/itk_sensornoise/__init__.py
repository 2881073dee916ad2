# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the noise of a camera from a burst of raw frames of any static scene.

    import itk_sensornoise as sn
    report = sn.estimate_sensor_noise(frames)
    print(report.gain)

is the way that type checkers and editors know: every function has its types. `import itk` sets the functions that take
frames on `itk`, too, beside the filters that ITK wraps itself: itk.estimate_sensor_noise() is the same function.

Deprecation: a name, an argument or a member of the JSON that is going to change works for one more release in its old
form, with a DeprecationWarning that names the new one, and CHANGELOG.md lists it under "Incompatible changes". For as
long, errors also derive from the class that they had. Names that begin with an underscore may change at any time.

Terms: a frame is one image, a stack (t, y, x) the frames; DN is a grey level. gain g [DN/e-], offset mu [DN], read
noise sigma [DN], flicker gamma_t [1] and vibration (alpha_t, beta_t) [pixel] are defined as by F. Sur, M. Grédiac, SIAM
J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
"""

from typing import TYPE_CHECKING, Any

from ._catalogue import quantity_list, warning_table
from ._chain import flicker_correction_image_filter, vibration_mask_image_filter
from ._channels import ChannelReports
from ._check import NoiseModelCheck, check_noise_model
from ._compare import Comparison, compare
from ._correlation import NoiseCorrelation, noise_correlation_estimator
from ._denoise import denoise_with_noise_model
from ._emva1288 import evaluate_emva1288
from ._emva1288_report import Emva1288Report
from ._estimate import estimate_sensor_noise
from ._estimators import (
    noise_regression_estimator,
    sensor_noise_estimator,
    temporal_statistics_image_filter,
    vibration_covariance_estimator,
)
from ._export import NoiseExport, export_formats, export_noise_model
from ._passport import Passport
from ._profile import check_noise_profile
from ._protocol import NoiseReport
from ._quantity import Quantity
from ._rawpy import raw_metadata
from ._report import Report
from ._simulate import simulate_sensor_noise
from ._single_image import single_image_noise_estimator
from ._source import sensor_noise_frame_list_source
from ._stabilise import generalized_anscombe_image_filter, inverse_generalized_anscombe_image_filter
from ._sums import SensorNoiseSums
from ._sweep import estimate_sweep

__all__ = [
    "ChannelReports",
    "Comparison",
    "Emva1288Report",
    "NoiseCorrelation",
    "NoiseExport",
    "NoiseModelCheck",
    "NoiseReport",
    "Passport",
    "Quantity",
    "Report",
    "SensorNoiseSums",
    "__version__",
    "check_noise_model",
    "check_noise_profile",
    "compare",
    "denoise_with_noise_model",
    "estimate_sensor_noise",
    "estimate_sweep",
    "evaluate_emva1288",
    "export_formats",
    "export_noise_model",
    "flicker_correction_image_filter",
    "generalized_anscombe_image_filter",
    "inverse_generalized_anscombe_image_filter",
    "noise_correlation_estimator",
    "noise_regression_estimator",
    "quantity_list",
    "raw_metadata",
    "sensor_noise_estimator",
    "sensor_noise_frame_list_source",
    "simulate_sensor_noise",
    "single_image_noise_estimator",
    "temporal_statistics_image_filter",
    "vibration_covariance_estimator",
    "vibration_mask_image_filter",
    "warning_table",
]

if TYPE_CHECKING:
    __version__: str


def __getattr__(name: str) -> Any:
    """Looks up the version of the installed package at its first use."""
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from ._version import version_of_package

    return version_of_package()
