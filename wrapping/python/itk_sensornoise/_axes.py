# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Finds the time axis among axes with names, as in xarray."""

from typing import Any

_TIME = ("t", "time", "times", "frame", "frames", "image", "images", "exposure", "n")
_Y = ("y", "row", "rows", "line", "lines", "height", "v")
_X = ("x", "column", "columns", "col", "cols", "width", "u")


def in_time_order(frames: Any, name: str) -> Any:
    """Returns frames with `dims`, names of their axes, as (t, y, x); other frames as they are.

    Axes of one element whose names are none of these are left out. One axis may have any name: it is the one that is
    left. Where no name is known the axes are taken as they lie. Raises ValueError if names leave it open."""
    dims = getattr(frames, "dims", None)
    if not isinstance(dims, tuple) or not hasattr(frames, "transpose") or not hasattr(frames, "squeeze"):
        return frames
    if len(dims) > 3:
        single = [dim for dim, size in zip(dims, frames.shape, strict=True) if size == 1 and _role(dim) is None]
        frames = frames.squeeze(single)
        dims = frames.dims
    roles = [_role(dim) for dim in dims]
    if len(dims) != 3 or roles == [None, None, None]:
        return frames
    left = [role for role in "tyx" if role not in roles]
    if roles.count(None) == 1 and len(left) == 1:
        roles[roles.index(None)] = left[0]
    if roles.count("t") == 1 and roles.count(None) == 2:
        others = iter("yx")  # as they lie
        roles = [role or next(others) for role in roles]
    if sorted(map(str, roles)) != ["t", "x", "y"]:
        raise ValueError(
            f"{name} has the axes {dims}, which do not show which axis is time; expected names as ('t', 'y', 'x') "
            "in any order, or the array without names: .values or .data, as (t, y, x)"
        )
    return frames.transpose(*(dims[roles.index(role)] for role in "tyx"))


def _role(dim: object) -> str | None:
    word = str(dim).lower()
    return next((role for role, words in (("t", _TIME), ("y", _Y), ("x", _X)) if word in words), None)
