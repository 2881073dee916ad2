#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Checks the sentences of documents, and of docstrings, comments and messages of C++ and Python: length, beginning and
words.

    check_language.py [FILE...] [--count] [--sample COUNT] [--seed SEED]

A sentence has at most 40 words, and does not begin with a genitive ("Of a row.") or with a clause ("What is left is").
Words that the field does not use in this sense are listed in WORDS, with what to write instead. Blocks of code, code
within a line and addresses are not read. The pages of warnings, quantities and filters hold sentences of the sources.

Documents are README.md, CONTRIBUTING.md, CHANGELOG.md, module/ and documentation/. Docstrings are the comments of
Doxygen and the docstrings of Python. Comments are lines of // and #, and what follows code in a line. Messages are the
strings of four words or more in a statement of C++, and in the calls SAYING of Python, with X in place of values. The
folders are SOURCES, COMMENTED and SPEAKING.

--count prints only how much was found. Exit code 1 if something was found.

--sample prints COUNT docstrings, comments and messages of each component, drawn by SEED, to be read against the rules.
"""

import argparse
import ast
import io
import pathlib
import random
import re
import sys
import tokenize
from collections import Counter
from collections.abc import Iterator

SOURCE = pathlib.Path(__file__).resolve().parent.parent
LONGEST = 40  # words

# Pattern of words, and what to write.
WORDS = {
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
    r"\bfreedom\b(?<!degrees of freedom)(?<!degree of freedom)": "degrees of freedom",
    r"\bdeparts?\b|\bdeparture\b": "deviates, deviation",
    r"\brefusal\b|\bobstacle\b": "failed estimate, reason",
    r"\bwide vectors\b": "SIMD",
    r"\btrembl\w+|\bvouch\w*|\bstrangers?\b|\bblame[ds]?\b": "a thing that does what things do",
    r"\blamps? (?:flickers?|flickering)\b": "the illumination flickers",
    r"\btells?\b|\btold\b": "shows, says, determines",
    r"\btak(?:es?|en|ing) (?:\w+ ){0,3}off\b": "subtracts",
    r"\bclaims?\b": "states",
    r"\bpile-?ups?\b|\bpiles? up\b": "saturation level, repeated extreme values",
    r"\bquantisation\b": "quantization",
    r"\bof which\b|\bthat of\b|\bthose of\b": "repeat the noun",
}
ANY_WORD = re.compile("|".join(WORDS), re.IGNORECASE)
GENITIVE = re.compile(r"Of (?!\d|course)|The same,? of\b|As (?:by|of)\b[^,]*$")
# A clause as the subject: "What a report says is kept." Titles without a full stop, and questions, may begin so.
CLAUSE = re.compile(r"What [^?]*[.:;]$")
# Docstrings may begin with a small letter; "the same" there needs the line above.
BEGIN_OF_DOCSTRING = re.compile(r"of (?!\d|course)|the same\b(?! \w+ (?:gives?|continues))", re.IGNORECASE)
# Comments often begin with "the same" as a part of a whole sentence.
BEGIN_OF_COMMENT = re.compile(r"of (?!\d|course)|the same(?:,? of\b|[,;:.]|$)", re.IGNORECASE)
CPP = {".h", ".hxx", ".cxx"}
# Folders of sources whose docstrings are read, and folders whose comments are read, too.
SOURCES = ("module", "filters", "wrapping", "examples", "test", "documentation")
SPEAKING = ("module", "filters", "wrapping", "examples")  # their strings are messages for users
SAYING = {"print", "warn", "exit", "error", "add_argument"}
COMMENTED = ("module", "filters", "wrapping", "examples", "test", "documentation")
# A string, a character or a comment of C++: strings are matched so that // within them begins no comment.
TOKEN_OF_CPP = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|/\*.*?\*/|//[^\n]*', re.DOTALL)
LITERAL_OF_CPP = re.compile(r"//[^\n]*|/\*.*?\*/|'(?:\\.|[^'\\\n])'|\"((?:\\.|[^\"\\\n])*)\"|[;{}]", re.DOTALL)
# Comments for programs: licences, clang-tidy, clang-format, ruff, mypy.
FOR_PROGRAMS = re.compile(r"SPDX-|NOLINT|clang-format|noqa|type:|ruff:|mypy:|fmt:|!/|-\*-|#")
# A comment of Doxygen: /** ... */, or lines of /// and ///<.
DOXYGEN = re.compile(r"/\*\*(?!\*)(.*?)\*/|///<?(?!/)((?:[^\n]*\n[ \t]*///<?(?=[ \t]))*[^\n]*)", re.DOTALL)
# Commands of Doxygen at whose place the text goes on, and commands that begin another paragraph.
WITHIN = re.compile(r"\\(?:a|c|p|e|b|ref)\s+([\w:.]*[\w:])")
COMMAND = re.compile(r"\\(?:brief|file|note|sa|see|warning|return|details|par)\b|\\(?:class|struct|t?param) +\S+")
FORMULA = re.compile(r"\\f\$.*?\\f\$|\\f\[.*?\\f\]|\\(?:code|verbatim).*?\\end(?:code|verbatim)", re.DOTALL)
# Lines of docstrings of Python that are typed into a terminal.
COMMAND_LINE = re.compile(r"\s*(?:build/bin/|python3? |>>> |\.\.\. )")
# What ends a sentence; a point of an abbreviation does not.
END = re.compile(r"(?:(?<=[.!?;])|(?<=[.]\)))(?<!\be\.g\.)(?<!\bF\.)(?<!\bM\.)\s+(?=[A-Z0-9\"'“*(`\[]|--)|(?<=:)\s+")


def documents() -> list[pathlib.Path]:
    """Lists the documents and sources that are checked."""
    sources = (path for folder in SOURCES for path in (SOURCE / folder).rglob("*") if path.suffix in {*CPP, ".py"})
    return [
        *(SOURCE / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "wrapping/README.md")),
        *sorted((SOURCE / "module").glob("*.md")),
        *sorted((SOURCE / "documentation").rglob("*.md")),
        *sorted(path for path in sources if path != pathlib.Path(__file__).resolve()),  # its word list
    ]


def prose(text: str) -> Iterator[tuple[int, str]]:
    """Yields the paragraphs, items of lists and cells of tables of Markdown, each with its line."""
    paragraph: list[str] = []
    first, fence = 1, False
    for number, line in enumerate([*text.splitlines(), ""], 1):
        if line.lstrip().startswith(("```", "~~~")):
            fence = not fence
        is_text = not fence and not line.startswith(("    ", "```", "<!--", ":", "#"))
        is_row, is_item = line.lstrip().startswith("|"), re.match(r"\s*(?:[-*]|\d+\.) ", line)
        if paragraph and (not line.strip() or not is_text or is_row or is_item):
            yield first, " ".join(paragraph)
            paragraph = []
        if is_row and is_text:
            yield from ((number, cell.strip()) for cell in line.strip().strip("|").split("|"))
        elif is_text and line.strip():
            if not paragraph:
                first = number
            paragraph.append(re.sub(r"^\s*(?:[-*]|\d+\.) ", "", line).strip())


def docstrings_of_cpp(text: str) -> Iterator[tuple[int, str]]:
    """Yields the paragraphs of the comments of Doxygen, each with the line of its comment."""
    for comment in DOXYGEN.finditer(text):
        words = FORMULA.sub("X", comment[1] or comment[2] or "")
        words = re.sub(r"^[ \t]*(?:\*|///<?)", "", words, flags=re.MULTILINE)
        words = COMMAND.sub("\n\n", WITHIN.sub(r"`\1`", words))
        for paragraph in re.split(r"\n[ \t]*\n|\n[ \t]*(?:[-*]|\d+\.|\|) |\n(?=[ \t]*\S+(?: \S+)*   )", words):
            if paragraph.strip():
                yield text.count("\n", 0, comment.start()) + 1, " ".join(paragraph.split())


def docstrings_of_python(text: str) -> Iterator[tuple[int, str]]:
    """Yields the paragraphs of the docstrings of Python, each with the line of its docstring. A line with another
    indent begins a paragraph, as in lists of parameters."""
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        first = node.body[0] if node.body else None
        if not (isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and ast.get_docstring(node)):
            continue
        paragraph: list[str] = []
        indent = 0
        for line in [*(ast.get_docstring(node) or "").splitlines(), ""]:
            depth = len(line) - len(line.lstrip())
            begins = depth != indent or line.lstrip().startswith(("- ", "* ")) or "  " in line.strip()
            if paragraph and (begins or not line.strip()):
                yield first.lineno, " ".join(paragraph)
                paragraph = []
            indent = depth
            if line.strip() and not COMMAND_LINE.match(line):
                paragraph.append(line.strip().removeprefix("- "))


def joined(comments: Iterator[tuple[int, bool, str]]) -> Iterator[tuple[int, str]]:
    """Yields the paragraphs of comments, each with its first line. A comment is its line, whether it is alone in its
    line, and its text. Comments in lines that follow each other are one paragraph."""
    paragraph: list[str] = []
    first = last = 0
    for number, is_alone, text in comments:
        continues = is_alone and number == last + 1 and text and not text.startswith(("  ", "- ", "* ", "| "))
        if paragraph and not continues:
            yield first, " ".join(paragraph)
            paragraph = []
        if text.strip() and not FOR_PROGRAMS.match(text.strip()):
            first = first if paragraph else number
            paragraph.append(text.strip().removeprefix("- "))
        last = number
    if paragraph:
        yield first, " ".join(paragraph)


def comments_of_cpp(text: str) -> Iterator[tuple[int, bool, str]]:
    """Yields the comments of lines of C++."""
    for token in TOKEN_OF_CPP.finditer(text):
        if token[0].startswith("//") and not token[0].startswith("///"):
            before = text[text.rfind("\n", 0, token.start()) + 1 : token.start()]
            yield text.count("\n", 0, token.start()) + 1, not before.strip(), token[0][2:].removeprefix(" ")


def comments_of_python(text: str) -> Iterator[tuple[int, bool, str]]:
    """Yields the comments of Python."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            yield token.start[0], not token.line[: token.start[1]].strip(), token.string.lstrip("#:").removeprefix(" ")


def messages_of_cpp(text: str) -> Iterator[tuple[int, str]]:
    """Yields the strings of each statement, joined, with X in place of the values between them. A string behind a comma
    is another message."""
    first, message, end = 0, "", 0
    for token in LITERAL_OF_CPP.finditer(re.sub(r"(?m)^#.*", "", text)):
        if token[1] is None and token[0] not in ";{}":
            continue
        between = re.sub(r"//[^\n]*", "", token.string[end : token.start()]).strip()
        if message and (token[1] is None or between == ","):
            yield first, message
            message = ""
        if token[1] is not None:
            first = first if message else token.string.count("\n", 0, token.start()) + 1
            message += ("X" if message and between else "") + token[1].replace("\\n", "\n").replace('\\"', '"')
            end = token.end()


def messages_of_python(text: str) -> Iterator[tuple[int, str]]:
    """Yields the strings of errors and of the calls SAYING, with X in place of values."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        if not (isinstance(node, ast.Raise) or (isinstance(node, ast.Call) and name in SAYING)):
            continue
        strings = [each for each in ast.walk(node) if isinstance(each, ast.JoinedStr)]
        parts = {id(part) for string in strings for part in ast.walk(string) if part is not string}
        strings += [each for each in ast.walk(node) if isinstance(each, ast.Constant) and id(each) not in parts]
        for string in strings:
            values = string.values if isinstance(string, ast.JoinedStr) else [string]
            texts = [getattr(value, "value", "X") if isinstance(value, ast.Constant) else "X" for value in values]
            yield string.lineno, "".join(text for text in texts if isinstance(text, str))


def is_speaking(folders: tuple[str, ...]) -> bool:
    """Returns whether the strings of a source are messages for users."""
    return folders[0] in SPEAKING and "test" not in folders


def messages(path: pathlib.Path, text: str) -> Iterator[tuple[int, str]]:
    """Yields the paragraphs of the messages of a source that have four words or more, each with its line."""
    for line, message in messages_of_cpp(text) if path.suffix in CPP else messages_of_python(text):
        for paragraph in re.split(r"\n[ \t]*\n", message):
            if len(paragraph.split()) >= 4:
                yield line, " ".join(paragraph.split())


def paragraphs(path: pathlib.Path, text: str) -> Iterator[tuple[int, str, re.Pattern[str]]]:
    """Yields what people read in a file: each paragraph with its line, and with the genitives that may not begin it."""
    if path.suffix == ".md":
        yield from ((line, words, GENITIVE) for line, words in prose(text))
        return
    is_cpp = path.suffix in CPP
    docstrings = docstrings_of_cpp(text) if is_cpp else docstrings_of_python(text)
    read = [(line, words, BEGIN_OF_DOCSTRING) for line, words in docstrings]
    if path.relative_to(SOURCE).parts[0] in COMMENTED:
        comments = joined(comments_of_cpp(text) if is_cpp else comments_of_python(text))
        read += [(line, words, BEGIN_OF_COMMENT) for line, words in comments]
    if is_speaking(path.relative_to(SOURCE).parts):
        read += [(line, words, GENITIVE) for line, words in messages(path, text)]
    for line, words, genitive in read:
        yield line, re.sub(r'"[^"]{1,30}"', "X", words), genitive  # without values, as "none"


def plain(text: str) -> str:
    """Returns prose without code, addresses and the marks of emphasis."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\$[^$]+\$|`[^`]+`", "X", text)  # a capital, as it may begin a sentence
    text = re.sub(r"<https?://[^>]*>|https?://[^\s)]+", "x", text)
    return text.replace("**", "").replace("*", "")


def findings(path: pathlib.Path, text: str) -> Iterator[tuple[str, int, str]]:
    """Yields what was found in a file: its kind, its line, and the words."""
    for number, paragraph, genitive in paragraphs(path, text):
        words_of_paragraph = plain(paragraph)
        begins_wrong = genitive.match(words_of_paragraph.strip())
        if begins_wrong:
            yield "a genitive at its beginning", number, words_of_paragraph[:100]
        for place, sentence in enumerate(END.split(words_of_paragraph)):
            if len(sentence.split()) > LONGEST:
                yield f"a sentence of {len(sentence.split())} words", number, sentence[:100]
            if GENITIVE.match(sentence.strip()) and not (place == 0 and begins_wrong):
                yield "a genitive at its beginning", number, sentence[:100]
            if CLAUSE.match(sentence.strip()):
                yield "a clause as its subject", number, sentence[:100]
        for pattern, advice in WORDS.items() if ANY_WORD.search(words_of_paragraph) else ():
            for match in re.finditer(pattern, words_of_paragraph, re.IGNORECASE):
                yield f'write "{advice}" for', number, match[0]


def component_of(path: pathlib.Path) -> str:
    """Returns the folder that a sample is drawn from: a component of module/src, or the first two folders."""
    folders = path.relative_to(SOURCE).parts[:-1]
    return "/".join(folders[: 3 if folders[:2] == ("module", "src") else 2])


def print_sample(files: list[pathlib.Path], count: int, seed: int) -> None:
    """Prints docstrings, comments and messages of each component, with their numbers. Leaves out texts of one or two
    words."""
    texts: dict[str, dict[str, list[str]]] = {}
    for path in (path for path in files if path.suffix != ".md"):
        text, is_cpp = path.read_text(encoding="utf-8"), path.suffix in CPP
        kinds = {
            "docstring": docstrings_of_cpp(text) if is_cpp else docstrings_of_python(text),
            "comment": joined(comments_of_cpp(text) if is_cpp else comments_of_python(text)),
            "message": messages(path, text) if is_speaking(path.relative_to(SOURCE).parts) else (),
        }
        for kind, found in kinds.items():
            lines = texts.setdefault(component_of(path), {}).setdefault(kind, [])
            lines += [
                f"{kind} {path.relative_to(SOURCE)}:{line}: {words}" for line, words in found if len(words.split()) > 2
            ]
    for component, kinds_of_component in texts.items():
        print(f"\n{component}: " + ", ".join(f"{len(lines)} {kind}s" for kind, lines in kinds_of_component.items()))
        for kind, lines in kinds_of_component.items():
            chosen = random.Random(f"{seed} {component} {kind}").sample(lines, min(count, len(lines)))
            print(*chosen, sep="\n", end="\n" if chosen else "")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=pathlib.Path, metavar="FILE", help="default: all documents")
    parser.add_argument("--count", action="store_true", help="print only how much was found")
    parser.add_argument("--sample", type=int, metavar="COUNT", help="print texts of each component instead")
    parser.add_argument("--seed", type=int, default=1, help="seed of the sample (default: 1)")
    options = parser.parse_args()

    counts: Counter[str] = Counter()
    files = [path.resolve() for path in options.files] or documents()
    if options.sample:
        print_sample(files, options.sample, options.seed)
        return 0
    for path in files:
        text = path.read_text(encoding="utf-8")
        for kind, number, words in findings(path, text):
            counts[re.sub(r"\d+", "more than 40", kind) if kind.startswith("a sentence") else kind.split('"')[0]] += 1
            if not options.count:
                print(f"{path.relative_to(SOURCE)}:{number}: {kind}: {words}")
    print(f"{len(files)} files: " + (", ".join(f"{n} x {k.strip()}" for k, n in counts.items()) or "nothing found"))
    return 1 if counts else 0


if __name__ == "__main__":
    sys.exit(main())
