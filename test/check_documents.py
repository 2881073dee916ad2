#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the examples of README.md and documentation/ and compares their output with the printed output, line for line.

    check_documents.py --bin build/bin [--python PYTHON] [--write] [DOCUMENT...]

The examples of a document run in an empty folder, in their order. These blocks have examples:

- `console`: each line that begins with `$ ` is a command, continued after a backslash. The lines below it are its
  standard output, then its standard error. A lone `…` stands for any number of lines, `…` within a line for any text.
- `sh`: every line is a command, whose output is not shown.
- `python`: a part of one program for each document. An `output` block below shows what it prints. These blocks need
  --python, an interpreter that has the package itk_sensornoise; without it they are not run.
- A comment `<!-- $ command -->` or `<!-- >>> statement -->` is an example that readers do not see. The block without a
  language below a hidden command shows some lines of its output, in their order.
- A comment `<!-- > file -->` above a block puts the block into this file, for the commands below it.
- A comment `<!-- not run: reason -->` above a block of `none`, `bash`, `py` or `matlab` says why it is no example. The
  syntax of `bash` and `py` is checked. Any other block is an error, as one of `text`, whose output nothing compares.
- `cpp` and `cmake` are compiled by consumer/run.sh, which reads the documents COMPILED.

A command that fails, by any exit code but 0 and 3 (no gain), fails the test. documents/not_run.py lists the commands
that are not run, with a reason each. Links to files and headings of the repository have to exist. --write puts the
outputs of the programs into the documents instead; a shortened block keeps its selection of lines. Exit code 1 if an
output differs.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator

from documents.comparison import GAP, differences, rewritten
from documents.links import broken_links
from documents.not_run import NOT_RUN, OPTIONAL
from documents.scratch import SOURCE, Scratch

COMPILED = ("README.md", "documentation/guides/pipeline.md")
NO_EXAMPLES = ("none", "bash", "py", "matlab")


def all_documents() -> list[pathlib.Path]:
    """Lists the documents whose examples are run."""
    return [SOURCE / "README.md", SOURCE / "wrapping" / "README.md", *sorted((SOURCE / "documentation").rglob("*.md"))]


def commands_of(lines: list[str]) -> list[str]:
    """Lists the commands of an `sh` block, without comments, in one line each."""
    text = re.sub(r"\\\n\s*", "", "\n".join(lines))
    commands = (re.sub(r"(^|\s+)# .*", "", line).strip() for line in text.splitlines())
    return [command for command in commands if command]


def console_runs(lines: list[str]) -> list[tuple[list[str], list[str]]]:
    """Lists each command of a `console` block, as it stands there, with the lines below it."""
    runs: list[tuple[list[str], list[str]]] = []
    for line in lines:
        if line.startswith("$ "):
            runs.append(([line], []))
        elif not runs:
            sys.exit(f"a console block begins with a command, not with: {line}")
        elif not runs[-1][1] and runs[-1][0][-1].endswith("\\"):
            runs[-1][0].append(line)
        else:
            runs[-1][1].append(line)
    return runs


def mistake_of_syntax(language: str, text: str) -> str:
    """Returns the first mistake in the syntax of a block of `bash` or `py`; "" without one, or for other languages."""
    if language == "py":
        try:
            compile(text, "block", "exec")
        except SyntaxError as error:
            return str(error)
    if language == "bash":
        found = subprocess.run(["bash", "-n", "-c", text], capture_output=True, text=True, check=False)
        return found.stderr.strip()
    return ""


class Document:
    """Goes through a document, block by block."""

    def __init__(self, path: pathlib.Path, scratch: Scratch) -> None:
        self.path = path
        self.scratch = scratch
        self.not_run: list[str] = []
        self.failures: list[str] = []
        self.compared = 0
        self.blocks = 0
        self.without_examples = 0
        self._hidden: tuple[str, list[str]] | None = None  # the last hidden command, and what it printed
        self._printed: tuple[str, list[str]] | None = None  # the last Python block, and what it printed

    def read(self) -> str:
        """Runs the examples and returns the text with the outputs of the programs."""
        result: list[str] = []
        lines = iter(self.path.read_text(encoding="utf-8").splitlines())
        above = ""
        for line in lines:
            result.append(line)
            if comment := re.fullmatch(r"<!-- (\$|>>>) (.*) -->", line):
                if comment[1] == "$":
                    self._hidden = (comment[2], self.scratch.run(comment[2]))
                else:
                    self.scratch.run_python(comment[2])
            elif line.startswith("```"):
                result += [*self._block(line[3:], lines, above), "```"]
            above = line
        return "\n".join(result) + "\n"

    def _block(self, language: str, lines: Iterator[str], above: str) -> list[str]:
        block = []
        for line in lines:
            if line == "```":
                break
            block.append(line)
        if file := re.fullmatch(r"<!-- > (\S+) -->", above):
            self.scratch.write(file[1], "\n".join(block) + "\n")
            self.blocks += 1
        elif mistake := self._mistake_of(language, block, above):
            self.failures.append(f"{self.path.relative_to(SOURCE)}: a block of {language or 'no language'}: {mistake}")
        elif language == "console":
            self.blocks += 1
            return self._console(block)
        elif language == "sh":
            self.blocks += 1
            self._shell(block)
        elif language == "python":
            printed = self.scratch.run_python("\n".join(block))
            self.blocks += printed is not None
            self._printed = None if printed is None else ("the Python block above", printed)
        elif language == "output" and self._printed:
            block = self._compare(*self._printed, block)
            self._printed = None
        elif language == "" and self._hidden:
            shown = [part for line in block for part in (GAP, line)] + [GAP]
            block = [part for part in self._compare(*self._hidden, shown) if part != GAP]
            self._hidden = None
        return block

    def _mistake_of(self, language: str, block: list[str], above: str) -> str:
        """Returns what is wrong with a block that no program runs, compares or compiles; "" if nothing is."""
        if language in NO_EXAMPLES:
            self.without_examples += 1
            if not re.fullmatch(r"<!-- not run: .{10,} -->", above):
                return "the line above it does not say why it is not run; expected <!-- not run: reason -->"
            return mistake_of_syntax(language, "\n".join(block))
        if language in ("cpp", "cmake"):
            is_compiled = str(self.path.relative_to(SOURCE)) in COMPILED
            return (
                "" if is_compiled else "test/consumer/run.sh does not compile this document; expected one of COMPILED"
            )
        if language == "output":
            # Without an interpreter the Python block above has not run.
            return "" if self._printed or not self.scratch.has_python else "no Python block is above it"
        if language == "":
            return "" if self._hidden else "no hidden command is above it"
        is_known = language in ("console", "sh", "python") or language.startswith("{")
        return (
            "" if is_known else f"expected console, sh, python, output, cpp, cmake, or one of {', '.join(NO_EXAMPLES)}"
        )

    def _compare(self, command: str, printed: list[str], shown: list[str]) -> list[str]:
        self.compared += 1
        if found := differences(shown, printed):
            self.failures += [f"{self.path.relative_to(SOURCE)}: $ {command}", *found]
        return rewritten(shown, printed)

    def _console(self, lines: list[str]) -> list[str]:
        result = []
        for command_lines, shown in console_runs(lines):
            command = "\n".join(command_lines)[2:]
            result += command_lines + self._compare(command, self.scratch.run(command), shown)
        return result

    def _shell(self, lines: list[str]) -> None:
        for command in commands_of(lines):
            program = command.split()[0]
            if command in NOT_RUN or (program in OPTIONAL and not self.scratch.has_program(program)):
                self.not_run.append(command)
            else:
                self.scratch.run(command)


def check(path: pathlib.Path, programs: pathlib.Path, python: str | None = None) -> tuple[Document, str]:
    """Runs the examples of one document in a folder of its own; returns what was found, and the text anew."""
    with tempfile.TemporaryDirectory() as folder:
        scratch = Scratch(pathlib.Path(folder), programs, python)
        try:
            document = Document(path, scratch)
            return document, document.read()
        finally:
            scratch.close()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("documents", nargs="*", type=pathlib.Path, metavar="DOCUMENT", help="default: all")
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the built programs")
    parser.add_argument("--python", help="interpreter that has the package itk_sensornoise")
    parser.add_argument("--write", action="store_true", help="write the outputs into the documents")
    options = parser.parse_args()

    failed, found, blocks = False, [], 0
    for path in [each.resolve() for each in options.documents] or all_documents():
        document, text = check(path, options.bin, options.python)
        if options.write:
            path.write_text(text, encoding="utf-8")
        elif document.failures:
            print("\n".join(document.failures))
            failed = True
        found.append(document)
        blocks += document.blocks
    for path in [*all_documents(), SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "module").glob("*.md"))]:
        for target in broken_links(path):
            print(f"{path.relative_to(SOURCE)}: a link to {target}, which does not exist")
            failed = True
    not_run = [command for document in found for command in document.not_run]
    if not options.documents:
        for command in NOT_RUN.keys() - set(not_run):
            print(f"no document has this command of documents/not_run.py: {command}")
            failed = True
    print(
        f"{len(found)} documents: {blocks} blocks with {sum(each.scratch.runs for each in found)} examples were run, "
        f"{sum(each.compared for each in found)} outputs compared, {len(not_run)} commands not run, "
        f"{sum(each.without_examples for each in found)} blocks are no examples"
    )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
