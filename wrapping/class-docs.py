#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes Python docstrings of the comments in the filters' headers, which SWIG does not see.

    class-docs.py _class_docs.py HEADER...

The first file is written: a module with the dictionary CLASS_DOCS, name of a class -> (its text, name of a method ->
its text). The script reads the comment that begins with "\\class", and the comments before public methods and ITK's
macros. A comment holds for all methods up to the next blank line.
"""

import re
import sys
from pathlib import Path
from pprint import pformat

_COMMENT = re.compile(r"/\*\*(.*?)\*/", re.DOTALL)
_CLASS = re.compile(r"\\class\s+(\w+)")
# The macros and the methods that they define: % stands for the name of the parameter.
_MACROS = {
    "SetMacro": ["Set%"],
    "GetConstMacro": ["Get%"],
    "GetMacro": ["Get%"],
    "BooleanMacro": ["%On", "%Off"],
    "SetInputMacro": ["Set%"],
    "GetInputMacro": ["Get%"],
    "SetGetDecoratedInputMacro": ["Set%", "Get%", "Set%Input", "Get%Input"],
    "SetDecoratedInputMacro": ["Set%", "Set%Input"],
    "GetDecoratedInputMacro": ["Get%", "Get%Input"],
    "SetStringMacro": ["Set%"],
    "GetStringMacro": ["Get%"],
    "SensorFlawMacro": ["Set%", "Get%"],
}
_MACRO = re.compile(r"^\s*itk(\w+Macro)\((\w+)", re.MULTILINE)
_METHOD = re.compile(r"^  (?!itk)(\w+)\(", re.MULTILINE)
_BODY = re.compile(r"^  \{.*?^  \}\n", re.MULTILINE | re.DOTALL)


def _lines(comment: str) -> str:
    """Returns the comment without the stars before its lines."""
    return re.sub(r"^[ \t]*\*? ?", "", comment.strip(), flags=re.MULTILINE).strip()


def _text(comment: str) -> str:
    """Returns the comment without the commands of Doxygen; paragraphs are kept."""
    text = _lines(comment).replace(r"Gredi\'ac", "Grédiac")
    text = re.sub(r"^\\(class|ingroup)\b.*\n?", "", text, flags=re.MULTILINE)
    text = re.sub(r"\\brief\s+", "", text)
    text = re.sub(r"\\tparam\s+(\w+)\s+", r"Template parameter \1: ", text)
    text = re.sub(r"\\param\s+(\w+)\s+", r"\1: ", text)
    text = re.sub(r"\\(see|sa)\s+", "See ", text)
    text = re.sub(r"\\(throws?|exception)\s+(\S+)\s+", r"Throws \2 ", text)
    text = re.sub(r"\\(returns?)\s+", "Returns ", text)
    text = re.sub(r"\\[acp]\s+(\w+)", r"\1", text)
    return text.strip()


def _methods(body: str) -> dict[str, str]:
    """Returns the texts of the methods in the code behind the comment of a class."""
    found: dict[str, list[str]] = {}
    for comment in _COMMENT.finditer(body):
        # The code that a comment describes ends at a blank line or the next comment. Bodies may hold blank lines.
        rest = _BODY.sub("", body[comment.end() :])
        block = re.split(r"\n[ \t]*\n|/\*\*", rest.lstrip("\n"), maxsplit=1)[0]
        names = [
            form.replace("%", name) for macro, name in _MACRO.findall(block) for form in _MACROS.get(macro, [])
        ] + _METHOD.findall(block)
        for name in dict.fromkeys(names):
            found.setdefault(name, []).append(_text(comment[1]))
    return {name: "\n\n".join(dict.fromkeys(texts)) for name, texts in found.items()}


def class_docs(header: str) -> dict[str, tuple[str, dict[str, str]]]:
    """Returns the classes of a header with the texts of their public methods."""
    comments = [comment for comment in _COMMENT.finditer(header) if _CLASS.search(comment[1])]
    bounds = [comment.start() for comment in comments] + [len(header)]
    docs = {}
    for comment, end in zip(comments, bounds[1:], strict=True):
        public = re.split(r"^(?:protected|private):", header[comment.end() : end], maxsplit=1, flags=re.MULTILINE)[0]
        name = _CLASS.search(comment[1])
        assert name is not None
        docs[name[1]] = (_text(comment[1]), _methods(public))
    return docs


def main() -> None:
    """Writes the module."""
    docs = {}
    for header in sys.argv[2:]:
        docs |= class_docs(Path(header).read_text(encoding="utf-8"))
    text = '"""Made of the headers of the filters by wrapping/class-docs.py."""\n\n'
    text += f"CLASS_DOCS: dict[str, tuple[str, dict[str, str]]] = {pformat(docs, width=120)}\n"
    Path(sys.argv[1]).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
