#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Checks the sentences of README.md, CONTRIBUTING.md, module/ and documentation/: length, beginning and words.

    check_language.py [FILE...] [--count]

A sentence has at most 40 words, and does not begin with a genitive ("Of a row."). Words that the field does not
use in this sense are listed in WORDS, with what to write instead. Blocks of code, code within a line and addresses are
not read. The pages of warnings, quantities and filters hold sentences of the sources.

--count prints only how much was found. Exit code 1 if something was found.
"""

import argparse
import pathlib
import re
import sys
from collections import Counter
from collections.abc import Iterator

SOURCE = pathlib.Path(__file__).resolve().parent.parent
LONGEST = 40  # words

# Pattern of words, and what to write.
WORDS = {
    r"\b(?:is|are|be|was|were|not) told\b": "is identifiable, is distinguished, is determined",
    r"\btells? (?:it|the|a|an|what|which|how|of|nothing|whether|us|you|equal)\b": "determines, shows, says",
    r"\blight (?:line|series)\b": "instrumental-variable fit; temporal components of the illumination",
    r"\bjudging line\b|\bjudge[ds]?\b": "rejection model; tests",
    r"\bpolished\b": "re-estimated",
    r"\bshared squares\b|\bsquares (?:are )?shared\b": "variance inflation",
    r"\bprovisional model\b": "initial noise model",
    r"\bstill scene\b|\bstands? still\b|\bstill floor\b": "static scene, no vibration",
    r"\bcrossed region\b|\bwhat crosses\b": "moving object",
    r"\b(?:neighbours|pixels|frames) share\b|\bshares? (?:of )?(?:their|its) noise\b": "noise correlation",
    r"\bthe pixels' own (?:patterns?|gains?|offsets?)\b": "fixed-pattern noise (PRNU, DSNU)",
    r"\blevel without light\b": "dark offset",
    r"\bgrey levels an electron\b": "DN per electron",
    r"\bbends?\b(?! it| the noise)|\bbent\b": "is non-linear",
    r"\bcodes? step\b|\bcodes? range\b|\bcodes too coarse\b": "quantization step, DN range",
    r"\bmore than a trifle\b|\bworth a word\b": "above the threshold, which is given",
    r"\bset by hand\b": "chosen empirically, on what",
    r"\bfreedom\b(?<!degrees of freedom)": "degrees of freedom",
    r"\bdeparts?\b|\bdeparture\b": "deviates, deviation",
    r"\brefusal\b|\bobstacle\b": "failed estimate, reason",
    r"\bwide vectors\b": "SIMD",
    r"\btrembl\w+|\bvouch\w*|\bstrangers?\b|\bblame[ds]?\b": "a thing that does what things do",
    r"\blamps? (?:flickers?|flickering)\b": "the illumination flickers",
    r"\bof which\b|\bthat of\b|\bthose of\b": "repeat the noun",
}
GENITIVE = re.compile(r"Of (?!\d|course)|The same,? of\b|As (?:by|of)\b[^,]*$")
# What ends a sentence; a point of an abbreviation does not.
END = re.compile(r"(?<=[.!?;])(?<!\be\.g\.)(?<!\bF\.)(?<!\bM\.)\s+(?=[A-Z0-9\"'“*(`\[])|(?<=:)\s+")


def documents() -> list[pathlib.Path]:
    """Lists the documents that are checked."""
    return [
        *(SOURCE / name for name in ("README.md", "CONTRIBUTING.md", "wrapping/README.md")),
        *sorted((SOURCE / "module").glob("*.md")),
        *sorted((SOURCE / "documentation").rglob("*.md")),
    ]


def prose(text: str) -> Iterator[tuple[int, str]]:
    """Yields the paragraphs, items of lists and cells of tables of Markdown, each with its line."""
    paragraph: list[str] = []
    first, fence = 1, False
    for number, line in enumerate([*text.splitlines(), ""], 1):
        if line.lstrip().startswith(("```", "~~~")):
            fence = not fence
        is_text = not fence and not line.startswith(("    ", "```", "<!--", ":", "#"))
        is_row, is_item = line.startswith("|"), re.match(r"\s*(?:[-*]|\d+\.) ", line)
        if paragraph and (not line.strip() or not is_text or is_row or is_item):
            yield first, " ".join(paragraph)
            paragraph = []
        if is_row and is_text:
            yield from ((number, cell.strip()) for cell in line.strip("|").split("|"))
        elif is_text and line.strip():
            if not paragraph:
                first = number
            paragraph.append(re.sub(r"^\s*(?:[-*]|\d+\.) ", "", line).strip())


def plain(text: str) -> str:
    """Returns prose without code, addresses and the marks of emphasis."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\$[^$]+\$|`[^`]+`", "X", text)  # a capital, as it may begin a sentence
    text = re.sub(r"<https?://[^>]*>|https?://\S+", "x", text)
    return text.replace("**", "").replace("*", "")


def findings(text: str) -> Iterator[tuple[str, int, str]]:
    """Yields what was found in a document: its kind, its line, and the words."""
    for number, paragraph in prose(text):
        words_of_paragraph = plain(paragraph)
        for sentence in END.split(words_of_paragraph):
            if len(sentence.split()) > LONGEST:
                yield f"a sentence of {len(sentence.split())} words", number, sentence[:100]
            if GENITIVE.match(sentence.strip()):
                yield "a genitive at its beginning", number, sentence[:100]
        for pattern, advice in WORDS.items():
            for match in re.finditer(pattern, words_of_paragraph, re.IGNORECASE):
                yield f'write "{advice}" for', number, match[0]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path, metavar="FILE", help="default: all documents")
    parser.add_argument("--count", action="store_true", help="print only how much was found")
    options = parser.parse_args()

    counts: Counter[str] = Counter()
    files = [path.resolve() for path in options.files] or documents()
    for path in files:
        text = path.read_text(encoding="utf-8")
        for kind, number, words in findings(text):
            counts[re.sub(r"\d+", "more than 40", kind) if kind.startswith("a sentence") else kind.split('"')[0]] += 1
            if not options.count:
                print(f"{path.relative_to(SOURCE)}:{number}: {kind}: {words}")
    print(f"{len(files)} documents: " + (", ".join(f"{n} x {k.strip()}" for k, n in counts.items()) or "nothing found"))
    return 1 if counts else 0


if __name__ == "__main__":
    sys.exit(main())
