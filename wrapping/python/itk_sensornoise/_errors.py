# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""What ITK throws, in words for people."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

# "file:line:", then, unless the error is about files, "ITK ERROR: Class(address): "; the sentence follows.
_PLACE = re.compile(r"\A[^\n]*:\d+:\n")
_CLASS = re.compile(r"\A\s*(?:ITK ERROR|itk::ERROR): [^\n]*?\(0x[0-9a-f]+\): ")
# SWIG's words for an argument that does not fit.
_ARGUMENT = re.compile(r"\Ain method '[^']*', argument \d+ of type '([^']*)'")
_OVERLOADED = "Wrong number or type of arguments"


def cause_of(error: BaseException) -> str:
    """The sentence in an ITK exception, on one line, without the file, class and address that stand before it."""
    text = str(error)
    argument = _ARGUMENT.match(text)
    if argument:
        return f"expected a value that fits C++'s type {argument[1]}"
    if text.startswith(_OVERLOADED):
        return "expected a value of another type"
    return " ".join(_CLASS.sub("", _PLACE.sub("", text)).split())


@contextmanager
def itk_errors(context: str = "", kind: type[Exception] = RuntimeError) -> Iterator[None]:
    """Raises what ITK throws as `kind`: the cause, one sentence, after `context`. ITK's own text is its cause."""
    try:
        yield
    except (RuntimeError, TypeError, OverflowError) as error:
        # ITK's exceptions arrive as RuntimeError; SWIG itself throws the others, where a value fits no C++ type.
        raise kind(f"{context}{cause_of(error)}") from error
