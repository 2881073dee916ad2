# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares the output that a document shows with the output that a program prints."""

import difflib
import re

GAP = "…"


def is_alike(shown: str, printed: str) -> bool:
    """Returns whether a line of the document equals the printed line, where `…` stands for any text."""
    return re.fullmatch(".+".join(map(re.escape, shown.split(GAP))), printed) is not None


def differences(shown: list[str], printed: list[str]) -> list[str]:
    """Lists the shown lines that the program does not print there, and the printed lines that the document lacks.

    A lone `…` among the shown lines stands for any number of printed lines.
    """
    found, at, may_skip = [], 0, False
    for line in shown:
        if line == GAP:
            may_skip = True
            continue
        place = next((i for i in range(at, len(printed)) if is_alike(line, printed[i])), None) if may_skip else at
        if place is None or place >= len(printed):
            found.append(f"document: {line}")
        elif is_alike(line, printed[place]):
            at, may_skip = place + 1, False
        else:
            found += [f"document: {line}", f"printed:  {printed[place]}"]
            at, may_skip = place + 1, False
    if not may_skip:
        found += [f"printed:  {line}" for line in printed[at:]]
    return found


def rewritten(shown: list[str], printed: list[str]) -> list[str]:
    """Returns the printed lines. A shortened block keeps its `…` and its selection of lines."""
    if GAP not in shown:
        marked = {line for line in shown if GAP in line}
        return [next((line for line in marked if is_alike(line, text)), text) for text in printed]
    result, at = [], 0
    for line in shown:
        if line == GAP:
            result.append(line)
        elif at < len(printed):
            at = max(range(at, len(printed)), key=lambda place: _likeness(line, printed[place])) + 1
            result.append(line if is_alike(line, printed[at - 1]) else printed[at - 1])
    return result


def _likeness(line: str, printed: str) -> tuple[float, float]:
    """Returns how alike two lines are, from 0 to 1: first without their digits, then with them."""
    pairs = ((re.sub(r"\d", "", line), re.sub(r"\d", "", printed)), (line, printed))
    words, whole = (difflib.SequenceMatcher(None, *pair).ratio() for pair in pairs)
    return words, whole
