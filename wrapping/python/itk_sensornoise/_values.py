# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Records of JSON as C++ takes them: numbers and texts by their JSON Pointers, and its sentences in Python's words."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from . import _options
from ._errors import itk_errors
from ._types import ItkObject

# Names of the parameters in the sentences of the library, and their names here.
_PARAMETERS = {
    " (--check-profile)": "",
    "--black": "black=",
    "--white": "white=",
    "--channel": "channel=",
    "--dark": "dark=",
    "--offset": "offset=",
    "--bayer": "bayer=",
    "--setting": "setting=",
}


# Methods of C++ that take the numbers of an export or a check.
_METHODS = {
    "black": "SetBlackLevel",
    "white": "SetWhiteLevel",
    "analogue_gain": "SetAnalogueGain",
    "max_analogue_iso": "SetMaxAnalogueIso",
}


def in_python(sentence: str) -> str:
    """Replaces the options of the programs in a sentence by the parameters of Python."""
    for option, parameter in _PARAMETERS.items():
        sentence = sentence.replace(option, parameter)
    return sentence


@contextmanager
def python_errors() -> Iterator[None]:
    """Raises the errors of C++ as itk_errors() does. Errors about values name the parameters of Python."""
    try:
        with itk_errors():
            yield
    except ValueError as error:
        raise type(error)(in_python(str(error))) from None


def set_numbers(target: ItkObject, **numbers: float | None) -> None:
    """Sets black, white, analogue_gain and max_analogue_iso of an export or a check, except where they are None."""
    for name, value in numbers.items():
        if value is not None:
            getattr(target, _METHODS[name])(_options.number(name, value))


def set_values(target: ItkObject, record: Any) -> None:
    """Gives the numbers and texts of a record to an object of ITK that has SetNumber() and SetText()."""
    for pointer, value in _flat(record, ""):
        if isinstance(value, str):
            target.SetText(pointer, value)
        else:
            target.SetNumber(pointer, value)


def _flat(value: Any, pointer: str) -> Iterator[tuple[str, str | float]]:
    """Yields the numbers and texts of a record, each with its JSON Pointer."""
    if isinstance(value, Mapping):
        for name, member in value.items():
            escaped = str(name).replace("~", "~0").replace("/", "~1")
            yield from _flat(member, f"{pointer}/{escaped}")
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _flat(item, f"{pointer}/{number}")
    elif isinstance(value, str):
        yield pointer, value
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield pointer, float(value)
