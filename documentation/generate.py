#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the parts of documentation/reference/ that tables and comments of the C++ sources hold.

    generate.py [--check]

A part stands between the comments `<!-- generated: NAME -->` and `<!-- end -->` of a page: the warnings, the
quantities, the filters, the formats of exports, and the quantities of EMVA 1288. --check writes nothing, and has the
exit code 1 if a page is not as it would be written. The test SensorNoiseDocuments compares the tables with the library.
"""

import argparse
import ast
import importlib.util
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
REFERENCE = SOURCE / "documentation" / "reference"

# Symbols of EMVA 1288 Release 4.0 Linear, by the path of the quantity.
EMVA = {
    "gain": "K",
    "offset": "μ_y.dark",
    "read_noise_electrons": "σ_d",
    "linearity.linearity_error_percent": "LE",
    "linearity.responsivity_dn_per_exposure": "R",
}

# The filters by what they are for; every class that has a wrapping is in one group.
GROUPS = {
    "Estimates": [
        "SensorNoiseEstimator",
        "NoiseCorrelationEstimator",
        "SingleImageNoiseEstimator",
        "Emva1288Evaluator",
        "SensorNoiseSums",
    ],
    "Steps of the published method": [
        "TemporalStatisticsImageFilter",
        "VibrationMaskImageFilter",
        "FlickerCorrectionImageFilter",
        "NoiseRegressionEstimator",
        "VibrationCovarianceEstimator",
    ],
    "Before and after a denoiser": ["GeneralizedAnscombeImageFilter", "InverseGeneralizedAnscombeImageFilter"],
    "Exports": ["NoiseModelExporter", "NoiseProfileChecker", "SensorNoiseSweep"],
    "Files and planes": [
        "SensorNoiseFrameListSource",
        "SensorNoiseImageIO",
        "SensorNoiseImageIOFactory",
        "BayerPlaneImageFilter",
    ],
    "Simulation": ["SensorNoiseSceneSource", "SensorNoiseStackSource"],
    "Base classes": [
        "SensorNoiseReportReader",
        "SensorNoiseReportSink",
        "SensorNoiseStabiliser",
        "SensorNoiseStackSink",
    ],
}


def source_of(name: str) -> str:
    """Reads the source file of the library with this name, wherever it is in module/."""
    (path,) = (SOURCE / "module").rglob(name)
    return path.read_text(encoding="utf-8")


def strings_of(text: str) -> list[str]:
    """Lists the string literals of C++ text; literals that follow each other are one string."""
    literal = r'"(?:[^"\\]|\\.)*"'
    found = re.findall(rf"{literal}(?:\s+{literal})*", text)
    return ["".join(ast.literal_eval(part) for part in re.findall(literal, string)) for string in found]


def warnings() -> str:
    """Returns the table of warnings."""
    text = source_of("WarningCodes.h")
    entries = re.findall(r"\{ WarningCode::\w+,\s*(\".*?\")\s*\}", text, re.DOTALL)
    rows = ["| code | severity | what it means, and what helps |", "|---|---|---|"]
    for entry in entries:
        severity = re.search(r"Severity::(\w+)", entry)
        code, sentence = strings_of(entry)
        rows.append(f"| `{code}` | {severity[1].lower()} | {sentence} |")
    return "\n".join(rows)


def quantities() -> str:
    """Returns the table of quantities."""
    entries = re.findall(r"QuantityEntry\{(.*?)ShownIn::", source_of("QuantityList.cxx"), re.DOTALL)
    rows = ["| quantity | in the table | unit | what it is | EMVA 1288 |", "|---|---|---|---|---|"]
    for entry in entries:
        path, label, unit, meaning = strings_of(entry)
        rows.append(f"| `{path}` | {label} | {unit} | {meaning} | {EMVA.get(path, '')} |")
    return "\n".join(rows)


def emva1288() -> str:
    """Returns the table of the quantities of the evaluation of EMVA 1288."""
    entry = re.compile(r"\{\s*(\"\w+\",\s*\"\w+\",.*?)&Of::", re.DOTALL)
    rows = ["| quantity | in the table | symbol | unit | equation |", "|---|---|---|---|---|"]
    for strings in entry.findall(source_of("EmvaText.cxx")):
        section, name, symbol, label, unit, equation = re.findall(r'"([^"]*)"', strings)
        rows.append(f"| `{section}.{name}` | {label} | {escaped(symbol)} | {unit} | {equation} |")
    return "\n".join(rows)


def exports() -> str:
    """Returns the table of the formats of `export-noise-model`."""
    entry = re.compile(r"\{\s*(\"[\w-]+\",.*?)ExportTakes::(\w+),\s*ExportExactness::(\w+),(.*?)\}", re.DOTALL)
    rows = ["| format | for | takes | model | what is written |", "|---|---|---|---|---|"]
    for names, takes, exactness, rest in entry.findall(source_of("NoiseExport.cxx")):
        name, consumer = strings_of(names)
        rows.append(f"| `{name}` | {consumer} | {takes.lower()} | {exactness.lower()} | {strings_of(rest)[0]} |")
    return "\n".join(rows)


def class_docs() -> dict[str, tuple[str, dict[str, str]]]:
    """Reads the comments of the filters' headers, as the wheel's help() has them."""
    spec = importlib.util.spec_from_file_location("class_docs", SOURCE / "wrapping" / "class-docs.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    docs = {}
    for header in sorted((SOURCE / "filters").glob("*.h")):
        docs |= module.class_docs(header.read_text(encoding="utf-8"))
    return docs


def base_of(name: str) -> str:
    """Returns the name of the class from which a filter is derived; empty if it is derived from none."""
    header = (SOURCE / "filters" / f"itk{name}.h").read_text(encoding="utf-8")
    found = re.search(rf"^class [\w ]*\b{name}\s*: public (\w+)", header, re.MULTILINE)
    return found[1] if found else ""


def filters() -> str:
    """Returns a section for each filter, with its description, parameters and results."""
    docs = class_docs()
    wrapped = {path.stem.removeprefix("itk") for path in (SOURCE / "wrapping").glob("*.wrap")}
    grouped = [name for names in GROUPS.values() for name in names]
    if missing := wrapped - set(grouped):
        sys.exit(f"generate.py: GROUPS lacks {', '.join(sorted(missing))}")
    parts = []
    for group, names in GROUPS.items():
        parts.append(f"## {group}")
        for name in names:
            text, methods = docs[name]
            parts += [f"### {name}", blocks(text)]
            if (base := base_of(name)) in docs:
                parts.append(f"The methods of [{base}](#{base.lower()}) belong to this class, too.")
            if methods:
                names_of = {}
                for method, words in methods.items():
                    names_of.setdefault(cell(words), []).append(f"`{method}`")
                rows = [f"| {', '.join(names)} | {words} |" for words, names in names_of.items() if words]
                parts.append("\n".join(["| method | description |", "|---|---|", *rows]))
    return "\n\n".join(parts)


def blocks(text: str) -> str:
    """Returns the text of a comment as Markdown: indented lines, and tables by spaces, are blocks of code."""
    paragraphs = []
    for paragraph in text.split("\n\n"):
        lines = paragraph.splitlines()
        is_code = all(line.startswith("  ") for line in lines)
        paragraphs.append(
            "\n".join(["<!-- not run: a formula or a table -->", "```none", *lines, "```"])
            if is_code
            else escaped(paragraph)
        )
    return "\n\n".join(paragraphs)


def escaped(text: str) -> str:
    """Returns text in which nothing is taken for markup of Markdown."""
    return re.sub(r"(?<!`)([<>*_|])(?!`)", r"\\\1", text)


def cell(text: str) -> str:
    """Returns text as the cell of a table."""
    return escaped(" ".join(text.split()))


PARTS = {
    "warnings": warnings,
    "quantities": quantities,
    "filters": filters,
    "exports": exports,
    "emva1288": emva1288,
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, and say which pages are old")
    is_check = parser.parse_args().check

    old = []
    for name, make in PARTS.items():
        page = REFERENCE / f"{name}.md"
        text = page.read_text(encoding="utf-8")
        begin, end = f"<!-- generated: {name} -->\n", "\n<!-- end -->"
        before, rest = text.split(begin)
        new = f"{before}{begin}\n{make()}\n{end}{rest.split(end)[1]}"
        if new != text:
            old.append(str(page.relative_to(SOURCE)))
            if not is_check:
                page.write_text(new, encoding="utf-8")
    if old:
        print(f"{'not as generate.py writes it' if is_check else 'written'}: {', '.join(old)}")
    return 1 if is_check and old else 0


if __name__ == "__main__":
    sys.exit(main())
