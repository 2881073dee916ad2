# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""From layers of napari to frames, and from results to layers. Nothing here needs a window."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from itk_sensornoise import ChannelReports, Report
from napari.layers import Image

# Keys of a layer's metadata: the report that was measured from the layer, and the source and name of a map.
REPORT = "sensornoise_report"
MAP = "sensornoise_map"

# The range of grey values that a map shows leaves out this fraction of the pixels at each end: hot pixels are far off.
_OUTSIDE = 0.005
# The map that is shown at first; the others lie below it.
_SHOWN = "variance"


def pixels_of(layer: Any) -> Any:
    """Returns the array of a layer, of a layer with several scales the largest. Raises ValueError for a layer of
    colours."""
    if layer.rgb:
        raise ValueError(
            f"Layer '{layer.name}' has colours (RGB). Expected: one grey value for each pixel. Open the raw frames."
        )
    return layer.data[0] if layer.multiscale else layer.data


def frames_of(layer: Any, is_frame_allowed: bool = False) -> Any:
    """Returns the frames (t, y, x) of a layer, or one frame (y, x) where that is allowed. Raises ValueError for another
    number of axes."""
    pixels = pixels_of(layer)
    if pixels.ndim == 3 or (is_frame_allowed and pixels.ndim == 2):
        return pixels
    shape = " x ".join(str(extent) for extent in pixels.shape)
    expected = "2 axes (y, x) or 3 axes (t, y, x)" if is_frame_allowed else "3 axes (t, y, x)"
    action = "Choose one channel and one plane, and add them as a layer." if pixels.ndim > 3 else "Open a burst."
    raise ValueError(f"Layer '{layer.name}' has {pixels.ndim} axes ({shape}). Expected: {expected}. {action}")


def plain(layer: Any) -> Any:
    """Returns the layer behind the proxy in which napari hands it to plugins: proxies of one layer differ."""
    return getattr(layer, "__wrapped__", layer)


def images(layers: Iterable[Any]) -> list[Any]:
    """Returns the image layers, the uppermost first."""
    return [plain(layer) for layer in reversed(list(layers)) if isinstance(layer, Image)]


def report_of(layer: Any) -> Report | ChannelReports | None:
    """Returns the report that belongs to a layer; None: it was not measured."""
    found = layer.metadata.get(REPORT)
    return found if isinstance(found, (Report, ChannelReports)) else None


def place_of(layer: Any, axes: int) -> dict[str, Any]:
    """Returns the scale, position and unit of the last axes of a layer, for a layer of its results."""
    place = {"scale": layer.scale[-axes:], "translate": layer.translate[-axes:]}
    if hasattr(layer, "units"):
        place["units"] = tuple(layer.units)[-axes:]
    return place


def add_maps(viewer: Any, layer: Any, maps: Mapping[str, np.ndarray]) -> None:
    """Adds the maps of a measured layer, in place of the maps of an earlier measurement of the same layer."""
    marks = [(layer.name, name) for name in maps]
    for earlier in [each for each in viewer.layers if each.metadata.get(MAP) in marks]:
        viewer.layers.remove(earlier)
    for name, values in reversed(list(maps.items())):
        viewer.add_image(
            values,
            name=f"{layer.name}: {name.replace('_', ' ')}",
            colormap="gray" if name in ("mean", "pixel_use") else "viridis",
            contrast_limits=_shown_range(values),
            visible=name == _SHOWN,
            metadata={MAP: (layer.name, name)},
            **place_of(layer, 2),
        )


def _shown_range(values: np.ndarray) -> tuple[float, float]:
    """Returns the range of grey values that shows a map, whatever its outliers are."""
    finite = values[np.isfinite(values)]
    if finite.size == 0:
        return 0.0, 1.0
    low, high = (float(end) for end in np.quantile(finite, (_OUTSIDE, 1.0 - _OUTSIDE)))
    return (low, high) if high > low else (low, low + 1.0)
