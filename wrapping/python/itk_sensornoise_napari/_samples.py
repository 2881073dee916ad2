# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Sample data of napari's File menu: simulated bursts with known truth."""

from typing import Any

from itk_sensornoise import simulate_sensor_noise

LayerData = tuple[Any, dict[str, Any], str]

# A sensor whose pixels differ like the pixels of an sCMOS sensor, so that the calibration maps show a pattern.
_SENSOR: dict[str, Any] = dict(
    size=(256, 192), gain=2.0, offset=100.0, electrons=1500.0, dsnu=4.0, read_noise=4.0, read_noise_spread=0.3
)


def flickering_burst() -> list[LayerData]:
    """Simulates 60 frames under flickering illumination and 60 dark frames of the same sensor: gain 2 DN/e-, dark
    offset 100 DN, and read noise 4 DN in the median pixel. The metadata of the layers have the truth."""
    burst, truth = simulate_sensor_noise(frames=60, flicker_sd=0.05, **_SENSOR)
    dark, _ = simulate_sensor_noise(frames=60, dark=True, seed=2, **_SENSOR)
    return [
        (dark, {"name": "dark frames", "visible": False, "metadata": {"truth": truth}}, "image"),
        (burst, {"name": "flickering burst", "metadata": {"truth": truth}}, "image"),
    ]


def steady_burst() -> list[LayerData]:
    """Simulates 60 frames of the same sensor under steady illumination: the gain is identifiable, the dark offset is
    not. The metadata of the layer have the truth."""
    burst, truth = simulate_sensor_noise(frames=60, flicker_sd=0.0, seed=3, **_SENSOR)
    return [(burst, {"name": "steady burst", "metadata": {"truth": truth}}, "image")]
