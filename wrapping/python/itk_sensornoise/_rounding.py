# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Numbers for people: rounded to two digits of their error, as the tables of C++ have them."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

# Signs of units, as in the tables of the C++ library.
_SIGNS = (("DN/e-", "DN/e⁻"), ("[e-]", "[e⁻]"), ("^2", "²"), (" +- ", " ± "))
# Smaller errors, and decimals beyond these, are not rounded to.
_LEAST_ERROR = 1e-300
_MOST_DECIMALS = 15


class Rounded(NamedTuple):
    """A value and its error as texts. Without an error, `error` is "" and `decimals` is None."""

    value: str
    error: str
    decimals: int | None

    def __str__(self) -> str:
        return f"{self.value} ± {self.error}" if self.error else self.value


def with_signs(text: str) -> str:
    """Returns a unit or a label with typographic signs: DN/e⁻, DN²."""
    if text == "e-":
        return "e⁻"
    for letters, sign in _SIGNS:
        text = text.replace(letters, sign)
    return text


def measured(value: float, standard_error: float) -> Rounded:
    """Returns a value and its standard error, both to two digits of the error."""
    if not (_LEAST_ERROR < standard_error < math.inf and math.isfinite(value)):
        return Rounded(f"{value:.6g}", f"{standard_error:.6g}", 0)
    # The place of the error's second digit, after rounding it to two: 0.0996 is 0.10.
    place = int(f"{standard_error:.1e}".partition("e")[2]) - 1
    decimals = max(0, -place)

    def rounded(number: float) -> str:
        if place > 0:
            unit = 10.0**place
            number = math.copysign(math.floor(abs(number) / unit + 0.5), number) * unit
        return f"{number:.{decimals}f}"

    return Rounded(rounded(value), rounded(standard_error), decimals)


def shortened(number: float | None) -> str:
    """Returns a number of five digits; "-" for None."""
    return "-" if number is None else f"{number:.5g}"


def of_three_digits(number: float) -> str:
    """Returns a number of three digits, or an integer from 1000 on."""
    return f"{number:.3g}" if abs(number) < 999.5 else f"{round(number):.15g}"


def limits_of(quantity: Mapping[str, Any]) -> Any:
    """Returns the 95 % interval of a quantity if there is one, else its limits."""
    return quantity["interval95"] or quantity["bracket"]


def rounded_quantity(quantity: Mapping[str, Any]) -> Rounded:
    """Returns the value of a quantity with its error, or its upper limit; "-" if it has neither."""
    value, error, limits = quantity["value"], quantity["standard_error"], limits_of(quantity)
    if value is not None and error is not None:
        return measured(value, error)
    if quantity["status"] == "upper-limit" and limits and limits[1] is not None:
        return Rounded(f"< {of_three_digits(limits[1])}", "", None)
    return Rounded(shortened(value), "", None)


def end_of_interval(end: float | None, rounded: Rounded) -> str:
    """Returns an end of an interval with the decimals of its value, or the digits of its upper limit."""
    if end is not None and rounded.value.startswith("<"):
        return of_three_digits(end)
    if end is not None and rounded.decimals is not None and rounded.decimals <= _MOST_DECIMALS and abs(end) < 1e9:
        return f"{end:.{rounded.decimals}f}"
    return shortened(end)
