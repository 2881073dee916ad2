# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables of HTML for notebooks and pages. They have the same numbers as the tables of text."""

import html
import re
from collections.abc import Iterable, Sequence

_CELL = "text-align:left;white-space:nowrap;padding:0.15em 0.8em"
_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>:root{{color-scheme:light dark}}
body{{margin:1rem auto;max-width:64rem;padding:0 1rem;font-family:system-ui,sans-serif}}
table{{border-collapse:collapse;overflow-x:auto;display:block}}td,th{{border-bottom:1px solid #8884}}</style>
</head>
<body>
<h1>{title}</h1>
{body}
</body>
</html>
"""
_STATUS = re.compile(r" (identified|not-identifiable|upper-limit|failed)(?: |$)")


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Returns a table whose cells are not broken into lines."""
    titles = "".join(f'<th style="{_CELL}">{html.escape(cell)}</th>' for cell in head)
    body = "".join(
        "<tr>" + "".join(f'<td style="{_CELL}">{html.escape(cell)}</td>' for cell in row) + "</tr>" for row in rows
    )
    return f"<table><thead><tr>{titles}</tr></thead><tbody>{body}</tbody></table>"


def paragraphs(lines: Iterable[str]) -> str:
    """Returns one paragraph for each line. A warning begins with its severity."""
    return "".join(f"<p style='margin:0.3em 0'>{html.escape(line)}</p>" for line in lines if line.strip())


def figure(element: str) -> str:
    """Returns an HTML figure around an element; "" without an element."""
    return f'<figure style="margin:0.5em 0">{element}</figure>' if element else ""


def page(title: str, body: str) -> str:
    """Returns a whole page, which needs no other file."""
    return _PAGE.format(title=html.escape(title), body=body)


def with_title(text: str, title: str | None) -> str:
    """Returns a page with another title."""
    if title is None:
        return text
    for tag in ("title", "h1"):
        text = re.sub(f"(<{tag}>).*?(</{tag}>)", lambda found: found[1] + html.escape(title) + found[2], text, count=1)
    return text


def rows_of_text(text: str) -> list[tuple[str, ...]]:
    """Returns the quantities in the text of a report: label, value with its error, unit, status, limits."""
    lines = text.split("\n")
    start = next((number for number, line in enumerate(lines) if line.startswith("quantity ")), None)
    if start is None:
        return []
    width = lines[start].index(" unit ") + 1
    rows: list[tuple[str, ...]] = []
    for line in lines[start + 1 :]:
        if not line.strip():
            break
        found = _STATUS.search(line)
        if found is None:
            continue
        value = " ".join(line[24:width].split())
        rows.append(
            (line[:24].strip(), value, line[width : found.start()].strip(), found[1], line[found.end() :].strip())
        )
    return rows


def table_of_text(text: str) -> str:
    """Returns the text of a report as HTML: the lines above the table, the table, and the lines below it."""
    lines = text.rstrip("\n").split("\n")
    rows = rows_of_text(text)
    start = next((number for number, line in enumerate(lines) if line.startswith("quantity ")), len(lines))
    end = start + 1 + len(rows)
    head = ("quantity", "value", "unit", "status", "95 % interval or limits")
    return paragraphs(lines[:start]) + (table(head, rows) if rows else "") + paragraphs(lines[end:])
