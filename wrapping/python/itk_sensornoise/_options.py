# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Parameters, checked before a pixel is read, as the tools check theirs. `value` is whatever a user gave.

A value of another type is a TypeError, another value a ValueError."""

import math
import operator
from collections.abc import Sequence
from typing import Any

import numpy as np

from ._errors import InvalidTypeError


def refuse(name: str, value: Any, expected: str) -> ValueError:
    """Returns the error for a wrong value."""
    return ValueError(f"{name} is {value!r}; expected {expected}")


def refuse_type(name: str, value: Any, expected: str) -> InvalidTypeError:
    """Returns the error for a value of a wrong type."""
    return InvalidTypeError(f"{name} is {value!r}; expected {expected}")


def integer(name: str, value: Any, low: int, high: int) -> int:
    """Returns `value` as a whole number from `low` to `high`. A bool is not a number."""
    expected = f"a whole number from {low} to {high}"
    if isinstance(value, (bool, np.bool_)):
        raise refuse_type(name, value, expected)
    try:
        number = operator.index(value)
    except TypeError:
        raise refuse_type(name, value, expected) from None
    if not low <= number <= high:
        raise refuse(name, value, expected)
    return number


def number(name: str, value: Any, expected: str = "a finite number", above: float = -math.inf) -> float:
    """Returns `value` as a finite number above `above`."""
    if isinstance(value, (bool, np.bool_, str, bytes)):
        raise refuse_type(name, value, expected)
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise refuse_type(name, value, expected) from None
    if not (math.isfinite(result) and result > above):
        raise refuse(name, value, expected)
    return result


def items(name: str, value: Any, count: int, expected: str) -> Sequence[Any]:
    """Returns the `count` items of a sequence."""
    if isinstance(value, (str, bytes)):
        raise refuse_type(name, value, expected)
    try:
        result = tuple(value)
    except TypeError:
        raise refuse_type(name, value, expected) from None
    if len(result) != count:
        raise refuse(name, value, expected)
    return result


def numbers(name: str, value: Any, count: int, expected: str) -> list[float]:
    """Returns the `count` finite numbers of a sequence."""
    return [number(name, item, expected) for item in items(name, value, count, expected)]


def integers(name: str, value: Any, count: int, expected: str) -> list[int]:
    """Returns the `count` whole numbers of a sequence."""
    try:
        return [operator.index(item) for item in items(name, value, count, expected)]
    except TypeError:
        raise refuse_type(name, value, expected) from None


def one_of(name: str, value: Any, choices: Sequence[Any]) -> Any:
    """Returns one of the choices."""
    expected = " or ".join(repr(choice) for choice in choices)
    if not any(isinstance(value, type(choice)) for choice in choices):
        raise refuse_type(name, value, expected)
    if value not in choices:
        raise refuse(name, value, expected)
    return value


def true_or_false(name: str, value: Any, expected: str = "True or False") -> bool:
    """Returns a bool, also of NumPy."""
    if not isinstance(value, (bool, np.bool_)):
        raise refuse_type(name, value, expected)
    return bool(value)


def rectangle(name: str, value: Any, width: int, height: int, expected: str) -> list[int]:
    """Returns x, y, width and height of a rectangle. It may be given as slices (y, x) without a step of an array of
    this size."""
    if not (isinstance(value, tuple) and any(isinstance(part, slice) for part in value)):
        return integers(name, value, 4, expected)
    slices = f"{expected}, or two slices (y, x) without a step, np.s_[y:y_end, x:x_end]"
    if len(value) != 2 or not all(isinstance(part, slice) for part in value):
        raise refuse_type(name, value, slices)
    try:
        rows, columns = value[0].indices(height), value[1].indices(width)
    except TypeError:
        raise refuse_type(name, value, slices) from None
    for part, size in zip(value, (height, width), strict=True):
        ends = [end for end in (part.start, part.stop) if end is not None]
        if any(not -size <= end <= size for end in ends) or part.step not in (None, 1):
            raise refuse(name, value, slices)
    if rows[0] >= rows[1] or columns[0] >= columns[1]:
        raise refuse(name, value, slices)
    return [columns[0], rows[0], columns[1] - columns[0], rows[1] - rows[0]]
