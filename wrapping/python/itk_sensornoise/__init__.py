# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the noise of a camera from a burst of raw frames of any static scene.

`import itk` sets these functions on `itk`, beside the filters that ITK wraps itself:

    import itk
    report = itk.estimate_sensor_noise(frames)
    print(report)

Terms: a frame is one image, a stack (t, y, x) the frames; DN is a grey level. gain g [DN/e-], offset mu [DN], read
noise sigma [DN], flicker gamma_t [1] and vibration (alpha_t, beta_t) [pixel] are those of F. Sur, M. Grédiac, SIAM J.
Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
"""

from ._catalogue import quantity_list, warning_table
from ._channels import ChannelReports
from ._check import NoiseModelCheck, check_noise_model
from ._correlation import NoiseCorrelation, noise_correlation_estimator
from ._denoise import denoise_with_noise_model
from ._estimate import estimate_sensor_noise
from ._estimators import (
    noise_regression_estimator,
    sensor_noise_estimator,
    temporal_statistics_image_filter,
    vibration_covariance_estimator,
)
from ._rawpy import raw_metadata
from ._report import Report
from ._simulate import simulate_sensor_noise
from ._source import sensor_noise_frame_list_source
from ._stabilise import generalized_anscombe_image_filter, inverse_generalized_anscombe_image_filter
from ._sums import SensorNoiseSums

__all__ = [
    "ChannelReports",
    "NoiseCorrelation",
    "NoiseModelCheck",
    "Report",
    "SensorNoiseSums",
    "check_noise_model",
    "denoise_with_noise_model",
    "estimate_sensor_noise",
    "generalized_anscombe_image_filter",
    "inverse_generalized_anscombe_image_filter",
    "noise_correlation_estimator",
    "noise_regression_estimator",
    "quantity_list",
    "raw_metadata",
    "sensor_noise_estimator",
    "sensor_noise_frame_list_source",
    "simulate_sensor_noise",
    "temporal_statistics_image_filter",
    "vibration_covariance_estimator",
    "warning_table",
]
