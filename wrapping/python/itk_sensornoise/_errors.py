# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""One policy for errors: TypeError for a wrong type or an unknown keyword, ValueError for a wrong value.

Both have one sentence, which says what was found and what was expected, in the names of the Python interface. ITK's own
text is not shown. The classes below also derive from the errors that were raised before 0.1.0, until 0.2.0: programs
catch TypeError, ValueError and MemoryError, and do not name these classes."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

# "file:line:", then, unless the error is about files, "ITK ERROR: Class(address): "; the sentence follows.
# ITK 6 has "file:line: in 'function':" before it, and sometimes "ITK ERROR Class(address): " with a decimal address.
_PLACE = re.compile(r"\A[^\n]*:\d+:(?: in '[^'\n]*':)?\n")
_CLASS = re.compile(r"\A\s*(?:ITK ERROR|itk::ERROR):? [^\n]*?\((?:0x[0-9a-f]+|\d+)\): ")
# SWIG's words for an argument that does not fit, and for one that fits none of several functions of one name.
_ARGUMENT = re.compile(r"\Ain method '[^']*', argument \d+ of type '([^']*)'")
_OVERLOADED = "Wrong number or type of arguments"
# Expected type for the first entry whose letters are in the name of the C++ type.
_EXPECTED = (
    ("std::vector", "a sequence of numbers"),
    ("string", "a str"),
    ("bool", "True or False"),
    ("unsigned", "a whole number, 0 or more"),
    ("double", "a number"),
    ("float", "a number"),
    ("int", "a whole number"),
    ("long", "a whole number"),
    ("itk::SizeValueType", "a whole number, 0 or more"),
    ("Image", "an itk.Image of the type that the filter takes"),
)
# An option of the tool in a sentence of the library, and the same in Python.
_OPTION = re.compile(r"--method ([\w-]+)")
_NO_MEMORY = ("std::bad_alloc", "Failed to allocate memory")
_ABORTED = "aborted by an external request"


class InvalidValueError(ValueError, RuntimeError):
    """A wrong value that ITK found. It is also a RuntimeError, as until version 0.2.0."""


class InvalidTypeError(TypeError, ValueError, RuntimeError):
    """A wrong type or an unknown keyword. It is also a ValueError and a RuntimeError, as until version 0.2.0."""


class OutOfMemoryError(MemoryError, RuntimeError):
    """Memory that ITK could not allocate. It is also a RuntimeError, as until version 0.2.0."""


def _expected_of(cpp_type: str) -> str:
    """Words for a type of C++, for an error."""
    return next((words for part, words in _EXPECTED if part in cpp_type), "a value of another type")


def cause_of(error: BaseException) -> str:
    """Returns the sentence of an ITK exception on one line, without the file, class and address before it, and with the
    name of a method as Python has it."""
    text = str(error)
    argument = _ARGUMENT.match(text)
    if argument:
        return f"expected {_expected_of(argument[1])}"
    if text.startswith(_OVERLOADED):
        return f"expected {_expected_of(text)}"
    return _OPTION.sub(r'method="\1"', " ".join(_CLASS.sub("", _PLACE.sub("", text)).split()))


def python_error_of(error: BaseException, context: str = "", kind: type[Exception] = InvalidValueError) -> Exception:
    """Translates an exception of ITK or of SWIG: its sentence stands after `context`, and it is of the `kind` where ITK
    found a wrong value."""
    cause = cause_of(error)
    if isinstance(error, TypeError):
        return InvalidTypeError(f"{context}{cause}")
    if any(words in cause for words in _NO_MEMORY):
        return OutOfMemoryError(f"{context}there is not enough memory")
    if _ABORTED in cause:
        return RuntimeError(f"{context}the work was stopped before it was done")
    return kind(f"{context}{cause}")


@contextmanager
def itk_errors(context: str = "", kind: type[Exception] = InvalidValueError) -> Iterator[None]:
    """Raises what ITK throws as an error of Python: one sentence, after `context`; of the `kind` for a wrong value."""
    try:
        yield
    except (InvalidValueError, InvalidTypeError):
        raise  # has its sentence
    except (RuntimeError, TypeError, OverflowError) as error:
        # ITK's exceptions arrive as RuntimeError; SWIG itself throws the others, where a value fits no C++ type.
        raise python_error_of(error, context, kind) from None
