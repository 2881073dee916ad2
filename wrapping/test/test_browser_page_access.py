# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that the page that measures bursts can be read, and used without a mouse or a screen.

The test reads the sources of the page, without a browser. So it sees what is hidden at first, too: errors, progress and
the result.
"""

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[2] / "examples" / "browser" / "page"
VOID = {"br", "hr", "img", "input", "link", "meta"}
TEXT_CONTRAST = 4.5  # WCAG 2.1, 1.4.3, level AA
EDGE_CONTRAST = 3.0  # WCAG 2.1, 1.4.11: edges of controls


def colours(scheme: str) -> dict[str, str]:
    """Returns the colours of the style sheet by name."""
    css = (PAGE / "page.css").read_text()
    light, dark = re.findall(r":root \{(.*?)\}", css, re.DOTALL)
    named = dict(re.findall(r"--([\w-]+): (#\w+);", light))
    return named | dict(re.findall(r"--([\w-]+): (#\w+);", dark)) if scheme == "dark" else named


def luminance(colour: str) -> float:
    """Returns the relative luminance of WCAG 2.1."""
    digits = colour[1:] if len(colour) == 7 else "".join(digit * 2 for digit in colour[1:])
    values = [int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4)]
    linear = [value / 12.92 if value <= 0.03928 else ((value + 0.055) / 1.055) ** 2.4 for value in values]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_is_that_of_wcag():
    assert contrast("#fff", "#000000") == pytest.approx(21.0)
    assert contrast("#777777", "#fff") == pytest.approx(4.48, abs=0.005)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_colours_have_enough_contrast(scheme):
    named = colours(scheme)
    assert len(named) == 7
    for text in ("text", "soft", "action", "error"):
        assert contrast(named[text], named["ground"]) >= TEXT_CONTRAST, text
    assert contrast(named["on-action"], named["action"]) >= TEXT_CONTRAST
    assert contrast(named["edge"], named["ground"]) >= EDGE_CONTRAST


def test_style_has_no_other_colours():
    css = (PAGE / "page.css").read_text()
    rules = re.sub(r":root \{.*?\}", "", css, flags=re.DOTALL)
    assert re.findall(r"#[0-9a-f]{3,8}\b(?=[;,)])|\brgba?\(|\bhsl", rules) == []


class Elements(HTMLParser):
    """All elements of a page: name, attributes, and the text inside."""

    def __init__(self, text: str):
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None], list[str]]] = []
        self._open: list[tuple[str, dict[str, str | None], list[str]]] = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs), []))
        if tag not in VOID:
            self._open.append(self.found[-1])

    def handle_endtag(self, tag):
        assert self._open.pop()[0] == tag

    def handle_data(self, data):
        for _, _, texts in self._open:
            texts.append(data)


@pytest.fixture(scope="module")
def elements():
    return Elements((PAGE / "index.html").read_text()).found


def test_every_control_has_a_name(elements):
    labels = {attributes["for"]: "".join(texts).strip() for tag, attributes, texts in elements if tag == "label"}
    controls = 0
    for tag, attributes, texts in elements:
        if tag in ("input", "select"):
            assert labels[attributes["id"]], attributes
        elif tag in ("button", "summary"):
            assert "".join(texts).strip(), attributes
        elif tag in ("progress", "form", "iframe", "section"):
            named_by = attributes.get("aria-labelledby")
            words = [" ".join(texts) for _, other, texts in elements if named_by and other.get("id") == named_by]
            assert attributes.get("aria-label") or attributes.get("title") or words, attributes
        else:
            continue
        controls += 1
    assert controls > 25


def test_messages_are_announced_and_the_keyboard_reaches_all_controls(elements):
    by_id = {attributes["id"]: attributes for _, attributes, _ in elements if "id" in attributes}
    assert by_id["error"]["role"] == "alert"
    assert {by_id[name]["role"] for name in ("chosen", "note", "planned", "export-note")} == {"status"}
    for tag, attributes, _ in elements:
        assert int(attributes.get("tabindex", 0)) <= 0
        # Only controls, which the keyboard reaches, can be clicked.
        assert not any(name.startswith("on") for name in attributes)
        if tag == "html":
            assert attributes["lang"] == "en"
    # The file pickers are hidden from the eye alone.
    assert not re.search(
        r"#(files|folder)\b[^{]*\{[^}]*(display: none|visibility: hidden)", (PAGE / "page.css").read_text()
    )
