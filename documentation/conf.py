# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Configuration of Sphinx for the documentation: `bash documentation/build.sh` builds it into build/site."""

import os
import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "wrapping" / "python"))

project = "ITKSensorNoise"
author = "The ITKSensorNoise contributors"
copyright = author
release = re.search(r"project\(SensorNoise VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
version = release

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton"]
exclude_patterns = ["requirements.txt"]
nitpicky = True
# The types of annotations belong to packages whose inventories the build, which works offline, does not read.
nitpick_ignore_regex = [("py:.*", ".*")]

myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 4

# The page of the Python package is made from its sources: neither the wheel nor ITK is needed.
autodoc_mock_imports = ["itk", "dask", "distributed", "pandas"]
autodoc_typehints = "none"
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_rtype = False

# The copy buttons leave out the prompt of a command and its output.
copybutton_prompt_text = "$ "
copybutton_here_doc_delimiter = "EOF"
copybutton_line_continuation_character = "\\"

html_theme = "furo"
html_title = f"ITKSensorNoise {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
pygments_style = "tango"
pygments_dark_style = "github-dark"


# Files of the repository that have a page.
PAGES = {"README.md": "index.md"}


def _with_included(text: str, folder: pathlib.Path) -> str:
    """Returns the text of a page in which a file stands in the place of its include directive."""

    def included(match: re.Match[str]) -> str:
        path = folder / match[1]
        return _with_page_links(path.read_text(encoding="utf-8"), path.resolve().parent, folder)

    return re.sub(r"^```\{include\} (\S+)\n```$", included, text, flags=re.MULTILINE)


def _with_page_links(text: str, folder: pathlib.Path, page_folder: pathlib.Path) -> str:
    """Returns the text in which only pages and files of the documentation are linked.

    Links to other files of the repository become the names of these files, as the site has no copy of them."""

    def link(match: re.Match[str]) -> str:
        words, target, anchor = match.groups()
        path = (folder / target).resolve()
        if not path.exists():
            return match[0]
        if path.is_relative_to(SOURCE / "documentation"):
            return f"[{words}]({os.path.relpath(path, page_folder.resolve())}{anchor or ''})"
        name = str(path.relative_to(SOURCE))
        if page := PAGES.get(name):
            steps = len(page_folder.resolve().relative_to(SOURCE / "documentation").parts)
            return f"[{words}]({'../' * steps}{page}{anchor or ''})"
        return f"`{name}`" if name.endswith(words) else f"{words} (`{name}`)"

    return re.sub(r"(?<!!)\[([^\]]+)\]\((?!https?:)([^)#\s]+)(#[^)]*)?\)", link, text)


def _read_source(app, name: str, source: list[str]) -> None:
    """Replaces what is read of a page."""
    folder = (SOURCE / "documentation" / name).parent
    source[0] = _with_page_links(_with_included(source[0], folder), folder, folder)


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def _read_docstring(app, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Makes plain text of a docstring reStructuredText: indented tables and programs are literal blocks, and no
    character is markup."""
    made: list[str] = []
    above, literal = "", None  # the line above that is not empty, and the indentation of a literal block
    for line in lines:
        if line.strip():
            if literal is not None and _indent(line) < literal:
                literal = None
            is_section = set(above.strip()) == {"-"}
            if literal is None and made and not made[-1] and not is_section and _indent(line) >= _indent(above) + 4:
                literal = _indent(line)
                made += [" " * _indent(above) + "::", ""]
            above = line
        made.append(line if literal is not None else re.sub(r"(?<!\\)([*|])", r"\\\1", line))
    lines[:] = made


def _run_doxygen(app, error: Exception | None) -> None:
    """Writes the pages of the C++ interface, with warnings as errors."""
    if error is not None:
        return
    folder = pathlib.Path(app.outdir) / "cpp"
    folder.mkdir(exist_ok=True)
    settings = (SOURCE / "documentation" / "Doxyfile").read_text(encoding="utf-8")
    settings += f'OUTPUT_DIRECTORY = "{folder}"\nPROJECT_NUMBER = {release}\n'
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=SOURCE, check=True)


def setup(app) -> None:
    """Called by Sphinx."""
    app.connect("source-read", _read_source)
    app.connect("autodoc-process-docstring", _read_docstring, priority=100)
    app.connect("build-finished", _run_doxygen)
