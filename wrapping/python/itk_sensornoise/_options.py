# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Parameters, checked before a pixel is read, as the tools check theirs. `value` is whatever a user gave."""

import math
import operator
from collections.abc import Sequence
from typing import Any


def refuse(name: str, value: Any, expected: str) -> ValueError:
    return ValueError(f"{name} is {value!r}; expected {expected}")


def integer(name: str, value: Any, low: int, high: int) -> int:
    """A whole number from `low` to `high`; bool is none."""
    expected = f"a whole number from {low} to {high}"
    try:
        number = operator.index(value)
    except TypeError:
        raise refuse(name, value, expected) from None
    if isinstance(value, bool) or not low <= number <= high:
        raise refuse(name, value, expected)
    return number


def number(name: str, value: Any, expected: str = "a finite number", above: float = -math.inf) -> float:
    """A finite number above `above`."""
    try:
        result = math.nan if isinstance(value, (bool, str)) else float(value)
    except (TypeError, ValueError):
        result = math.nan
    if not (math.isfinite(result) and result > above):
        raise refuse(name, value, expected)
    return result


def items(name: str, value: Any, count: int, expected: str) -> Sequence[Any]:
    """`count` items of a sequence."""
    try:
        result = () if isinstance(value, (str, bytes)) else tuple(value)
    except TypeError:
        result = ()
    if len(result) != count:
        raise refuse(name, value, expected)
    return result


def numbers(name: str, value: Any, count: int, expected: str) -> list[float]:
    """`count` finite numbers."""
    return [number(name, item, expected) for item in items(name, value, count, expected)]


def integers(name: str, value: Any, count: int, expected: str) -> list[int]:
    """`count` whole numbers."""
    try:
        return [operator.index(item) for item in items(name, value, count, expected)]
    except TypeError:
        raise refuse(name, value, expected) from None


def one_of(name: str, value: Any, choices: Sequence[Any]) -> Any:
    """One of the choices."""
    if isinstance(value, bool) or not any(type(value) is type(choice) and value == choice for choice in choices):
        raise refuse(name, value, " or ".join(repr(choice) for choice in choices))
    return value
