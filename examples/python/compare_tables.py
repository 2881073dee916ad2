# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes the tables of compare_methods.py, and writes them as Markdown and as one HTML file."""

import html
import math
from typing import NamedTuple

NONE = "–"
DIGITS_OF_ERROR = 2
DIGITS_WITHOUT_ERROR = 4

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 80em; padding: 0 1em; }
table { border-collapse: collapse; margin: 1em 0 2em; font-size: 14px; }
th, td { border-bottom: 1px solid #8884; padding: 0.25em 0.7em; text-align: left; }
th { border-bottom: 2px solid #8888; }
:root { color-scheme: light dark; }
"""


class Table(NamedTuple):
    """Table with its heading, a sentence about it, its columns and its rows of texts."""

    heading: str
    text: str
    columns: tuple
    rows: list


def digits_behind_point(number, digits):
    """Returns how many digits behind the point show a number to so many digits."""
    return max(0, digits - 1 - math.floor(math.log10(abs(number)))) if number else digits


def text_of(estimate):
    """Returns an estimate as text, rounded to its error."""
    if estimate is None:
        return NONE
    if not estimate.error or not math.isfinite(estimate.error):
        return f"{estimate.value:.{digits_behind_point(estimate.value, DIGITS_WITHOUT_ERROR)}f}"
    places = digits_behind_point(estimate.error, DIGITS_OF_ERROR)
    return f"{estimate.value:.{places}f} ± {estimate.error:.{places}f}"


def percent(error):
    """Returns a relative error [1] as text in %, with two digits below 100 %."""
    return (
        NONE
        if error is None
        else f"{100 * error:+.{0 if abs(error) > 1 else min(2, digits_behind_point(100 * error, 2))}f}"
    )


def as_markdown(title, text, tables):
    """Returns the tables as Markdown."""
    lines = [f"# {title}", "", text, ""]
    for table in tables:
        lines += [f"## {table.heading}", "", table.text, ""]
        lines += [f"| {' | '.join(table.columns)} |", "|" + "---|" * len(table.columns)]
        lines += [f"| {' | '.join(cell.replace('|', '/') for cell in row)} |" for row in table.rows]
        lines.append("")
    return "\n".join(lines)


def as_html(title, text, tables):
    """Returns the tables as an HTML page that needs no other file."""

    def cells(row, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row) + "</tr>"

    parts = [
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{html.escape(title)}</title>',
        f"<style>{STYLE}</style>\n</head>\n<body>\n<h1>{html.escape(title)}</h1>\n<p>{html.escape(text)}</p>",
    ]
    for table in tables:
        parts.append(f"<h2>{html.escape(table.heading)}</h2>\n<p>{html.escape(table.text)}</p>\n<table>")
        parts += [cells(table.columns, "th"), *(cells(row, "td") for row in table.rows), "</table>"]
    return "\n".join([*parts, "</body>\n</html>\n"])
