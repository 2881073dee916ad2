# ==========================================================================
#
#   Copyright the ITKSensorNoise contributors
#
#   Licensed under the Apache License, Version 2.0 (the "License");
#   you may not use this file except in compliance with the License.
#   You may obtain a copy of the License at
#
#          https://www.apache.org/licenses/LICENSE-2.0.txt
#
#   Unless required by applicable law or agreed to in writing, software
#   distributed under the License is distributed on an "AS IS" BASIS,
#   WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
#   See the License for the specific language governing permissions and
#   limitations under the License.
#
# ==========================================================================*/
"""Parameters, checked before a pixel is read, as the command-line tools check theirs."""

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
