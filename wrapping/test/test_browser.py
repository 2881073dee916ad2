# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests pages of `estimate-sensor-noise --plot`, of one report and of several compared reports, in a real browser.

The pages are shown on a telephone and on a wide screen, light and dark. `pytest test_browser.py --screenshots DIR`
keeps pictures of all pages. `-k documentation --screenshots documentation` makes the pictures of the documentation.
"""

import json
import os
import re
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest
from browser import Browser

CHECKS = (Path(__file__).parent / "page_checks.js").read_text()
WIDTHS = {"telephone": 390, "desk": 1280}
SCHEMES = ("light", "dark")

# Options of the simulator, and the exit code of the estimator: 3 if there is no gain.
SITUATIONS = {
    "good": ("--size 256x192 --frames 60", 0),
    "failed": ("--size 96x64 --frames 12 --clip 0,300", 3),  # nearly all pixels are saturated
    "flat-field": ("--size 256x192 --frames 60 --reference flat --prnu 0.3", 3),
    "bayer": ("--size 384x256 --frames 60 --bayer RGGB", 0),
    "bayer-failed": ("--size 192x128 --frames 12 --bayer RGGB --clip 0,300", 0),  # two channels have no gain
    "smoothed": ("--size 256x192 --frames 60 --smoothing 0.7", 0),
    "gamma": ("--size 256x192 --frames 60 --response gamma,0.6", 3),
    "warnings": ("--size 256x192 --frames 15 --repeat 2 --flicker-sd 0 --response shoulder,0.2 --coupling 0.02", 3),
}

# Options of the simulator for each stored report that is compared.
SMALL = "--size 128x96 --frames 40"
COMPARED = {
    "compared-six": [f"{SMALL} --seed {seed} --gain {1 + 0.1 * (seed // 4)}" for seed in range(1, 7)],
    "compared-mosaics": [f"--size 192x128 --frames 40 --bayer RGGB --seed {seed}" for seed in (1, 2)],
    "compared-failed": [f"{SMALL} --seed 1", SITUATIONS["failed"][0], f"{SMALL} --seed 2"],
}
NAME = "camera_0123456789abcdef_exposure_000010_ms_at_" * 4  # name of a report that cannot be broken into lines


def code_of(tool, *arguments) -> int:
    """Runs the estimator. Returns its exit code."""
    try:
        tool("estimate-sensor-noise", *arguments, "--quiet")
    except subprocess.CalledProcessError as error:
        return error.returncode
    return 0


def measured(tool, folder: Path, name: str, flags: str, code: int = 0) -> Path:
    """Returns the page of a simulated burst."""
    stack, page = folder / f"{name}.mha", folder / f"{name}.html"
    tool("simulate-sensor-noise", "--output", stack, *flags.split())
    assert code_of(tool, stack, "--plot", page) == code
    stack.unlink()
    return page


def compared(tool, folder: Path, name: str, bursts: list[str], ending: str = "html") -> Path:
    """Returns the page of the reports of simulated bursts, with their hashes."""
    stack, page, reports = folder / f"{name}.mha", folder / f"{name}.{ending}", []
    for number, flags in enumerate(bursts):
        tool("simulate-sensor-noise", "--output", stack, *flags.split())
        reports.append(folder / f"{NAME}{number}.json")
        assert code_of(tool, stack, "--json", reports[-1], "--plot", folder / "of-one.html") in (0, 3)
    assert code_of(tool, "--compare", *reports, "--plot", page) == 0
    return page


@pytest.fixture(scope="session")
def pages(tool, tmp_path_factory):
    """Returns one page of each situation."""
    folder = tmp_path_factory.mktemp("pages")
    single = {name: measured(tool, folder, name, *what) for name, what in SITUATIONS.items()}
    return single | {name: compared(tool, folder, name, bursts) for name, bursts in COMPARED.items()}


def test_title_has_the_files_and_their_date(tool, tmp_path):
    stacks = [tmp_path / name for name in ("a&b.mha", "c.mha")]
    for seconds, stack in enumerate(stacks):
        tool("simulate-sensor-noise", "--output", stack, *["--size", "64x48", "--frames", "10"], "--seed", seconds + 1)
        os.utime(stack, (0, 1_000_000_000 + 60 * seconds))  # 2001-09-09 01:46:40 UTC
    for given, title, date in (
        (stacks[:1], "Noise of a&amp;b.mha", "2001-09-09 01:46 UTC"),
        (stacks, "Noise of a&amp;b.mha to c.mha", "2001-09-09 01:47 UTC"),
    ):
        assert code_of(tool, *given, "--plot", tmp_path / "page.html") in (0, 3)
        page = (tmp_path / "page.html").read_text()
        assert f"<title>{title}</title>" in page and f"<h1>{title}</h1>" in page and f"<time>{date}</time>" in page


def outside(browser: Browser, file: Path) -> list[str]:
    """Returns the addresses that the page requests, except its own and "data:"."""
    asked = [event["request"]["url"] for method, event in browser.events if method == "Network.requestWillBeSent"]
    return [url for url in asked if url != file.resolve().as_uri() and not url.startswith("data:")]


def complaints(browser: Browser) -> list[str]:
    """Returns the errors in the page that the browser reports."""
    kinds = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")
    return [f"{method}: {event}" for method, event in browser.events if method in kinds]


def faults(browser: Browser, file: Path) -> list[str]:
    found = browser.run(CHECKS)
    return [*found, *complaints(browser), *(f"asks for {url}" for url in outside(browser, file))]


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("screen", WIDTHS)
@pytest.mark.parametrize("situation", [*SITUATIONS, *COMPARED])
def test_page_is_whole_and_readable(chrome, pages, situation, screen, scheme, screenshots):
    page = pages[situation]
    chrome.open(page, WIDTHS[screen], scheme)
    if screenshots:
        chrome.picture(screenshots / f"{situation}-{screen}-{scheme}.png")
    assert faults(chrome, page) == []
    dark = chrome.run("matchMedia('(prefers-color-scheme: dark)').matches")
    ground = chrome.run("getComputedStyle(document.body).backgroundColor")
    assert dark == (scheme == "dark") and (ground == "rgb(255, 255, 255)") == (scheme == "light")


@pytest.mark.parametrize("situation", ["good", "flat-field", "smoothed", "gamma", "warnings"])
def test_first_screen_has_verdict_key_numbers_and_curve(chrome, pages, situation):
    """The screen has 1280 x 800 pixels. On a telephone the verdict and the key numbers are on the first screen."""
    bottoms = "[...document.querySelectorAll('WHAT')].map((part) => part.getBoundingClientRect().bottom)"
    for screen, what in (("telephone", ".verdict, .keys"), ("desk", ".verdict, .keys, .two svg[role=img]")):
        chrome.open(pages[situation], WIDTHS[screen], "light")
        found = chrome.run(bottoms.replace("WHAT", what))
        assert len(found) == what.count(",") + 1
        assert max(found) <= 800, (screen, found)


def test_sections_open_by_the_keyboard(chrome, pages):
    """The Tab key goes through the links of the verdict and the sections; Enter opens a section."""
    chrome.open(pages["smoothed"], WIDTHS["desk"], "light")

    def press(key: str, code: int, text: str = "") -> str:
        for kind in ("keyDown", "keyUp"):
            chrome.send("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, text=text)
            text = ""
        return chrome.run("document.activeElement.innerText")

    count = chrome.run("document.querySelectorAll('a, summary').length")
    reached = [press("Tab", 9) for _ in range(count)]
    assert reached[0] == "noise correlated" and reached[-1].startswith("Input and settings")
    assert not chrome.run("document.activeElement.parentElement.open")
    press("Enter", 13, "\r")
    assert chrome.run("document.activeElement.parentElement.open")


def every_warning() -> list[tuple[str, str]]:
    """Returns code and sentence of each warning in the library."""
    header = Path(__file__).resolve().parents[2] / "module/include/sensornoise/WarningCodes.h"
    kinds = re.findall(r'"([a-z-]+)",\s*Severity::\w+,((?:\s*"[^"]*")+) }', header.read_text())
    return [(code, "".join(re.findall(r'"([^"]*)"', parts))) for code, parts in kinds]


@pytest.mark.parametrize("screen", WIDTHS)
def test_every_warning_fits(chrome, pages, screen):
    """No simulated burst has all warnings: the first warning of the page is repeated with their texts."""
    kinds = every_warning()
    assert len(kinds) > 40
    name = "frame_" * 30  # name of a file that cannot be broken into lines
    chrome.open(pages["warnings"], WIDTHS[screen], "light")
    chrome.run(
        f"""for (const [code, sentence] of {json.dumps(kinds)}) {{
          const item = document.querySelector(".warning").cloneNode(true);
          const [finding, action, name] = item.querySelectorAll("p");
          item.id = "copy-of-" + code;
          item.querySelector("h3").firstChild.data = code.replaceAll("-", " ") + " ";
          finding.innerText = sentence + " {name}";
          action.lastChild.data = " " + sentence;
          name.firstElementChild.innerText = code;
          document.querySelector(".warnings").append(item);
        }}"""
    )
    assert chrome.run("document.querySelectorAll('.warning').length") > len(kinds)
    assert faults(chrome, pages["warnings"]) == []


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("what", ["report", "comparison"])
def test_svg_file_is_whole_and_readable(chrome, tool, tmp_path, what, scheme):
    stack, file = tmp_path / "stack.mha", tmp_path / "figure.svg"
    if what == "comparison":
        file = compared(tool, tmp_path, "figure", COMPARED["compared-six"], "svg")
    else:
        tool("simulate-sensor-noise", "--output", stack, *SITUATIONS["good"][0].split())
        tool("estimate-sensor-noise", stack, "--quiet", "--plot", file)
    assert ElementTree.parse(file).getroot().tag == "{http://www.w3.org/2000/svg}svg"
    chrome.open(file, 1280, scheme)
    assert faults(chrome, file) == []


def test_figures_of_every_page_are_xml(pages):
    for name, page in pages.items():
        text = page.read_text()
        for figure in re.findall(r"<figure>(<svg.*?</svg>)\s*(?:<figcaption|</figure>)", text, re.DOTALL):
            assert ElementTree.fromstring(figure).get("viewBox"), name
        assert ("<svg" in text) == (name != "failed"), name


def test_page_of_24_megapixels_is_small_and_opens_at_once(chrome, tool, tmp_path):
    """The burst has six frames of 12 bits. More frames do not make the page larger."""
    page = measured(tool, tmp_path, "large", "--size 6000x4000 --frames 6")
    assert page.stat().st_size < 1_000_000
    seconds = min(chrome.open(page, 390, "light") for _ in range(2))  # another program may slow one of them
    assert seconds < 1.0
    assert faults(chrome, page) == []


# Pictures in documentation/: options of the simulator, colours, and the beginnings of the headings.
PICTURES = {
    "page-good": ("--camera A --frames 50", "light", ("Noise of", "All quantities", "Illumination and")),
    "page-bayer": ("--size 384x256 --frames 60 --bayer RGGB", "light", ("Noise of", "What was found", "Channel B")),
    "page-smoothed": (
        "--size 256x192 --frames 60 --smoothing 0.7",
        "dark",
        ("Noise of", "What was found", "Correlation of"),
    ),
}
SCREEN = (390, 800)  # screen of a telephone [CSS pixels]


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_of_the_documentation(chrome, tool, tmp_path, name, screenshots):
    """The picture has three screens of a telephone side by side, each from a heading on."""
    flags, scheme, headings = PICTURES[name]
    page = measured(tool, tmp_path, name, flags)
    chrome.open(page, SCREEN[0], scheme)
    chrome.run("document.querySelectorAll('details').forEach((part) => (part.open = true))")
    screens = []
    for words in headings:
        heading = f"[...document.querySelectorAll('h1, h2')].find((h) => h.innerText.startsWith('{words}'))"
        top = chrome.run(f"{heading}.getBoundingClientRect().top")
        screens.append(tmp_path / f"{len(screens)}.png")
        chrome.picture(screens[-1], max(top - 12, 0), SCREEN[1])
    images = "".join(f"<img alt='screen' src='{screen.name}'>" for screen in screens)
    style = "body{margin:12px;display:flex;gap:12px;background:#8c959f}"
    (tmp_path / "side.html").write_text(f"<!DOCTYPE html><title>side by side</title><style>{style}</style>{images}")
    chrome.open(tmp_path / "side.html", 3 * SCREEN[0] + 4 * 12, "light")
    file = (screenshots or tmp_path) / f"{name}.png"
    chrome.picture(file, 0, SCREEN[1] + 24)
    pillow = pytest.importorskip("PIL.Image")
    with pillow.open(file) as picture:
        few = picture.convert("RGB").quantize(256, method=pillow.Quantize.MAXCOVERAGE, kmeans=3)  # keeps rare colours
    few.save(file, optimize=True)  # reduces the size to a third
    assert file.stat().st_size < 200_000


# Pages that the checks must reject, and a word of the message.
BAD = {
    "scrolls sideways": "<p style='width:2000px'>wide</p>",
    "contrast": "<p style='color:#999'>pale</p>",
    "contrast 1.0": "<svg viewBox='0 0 9 9'><text y='8' fill='#fff'>o</text></svg>",
    "letters of": "<p style='font-size:8px'>small</p>",
    "is cut off by its svg": "<svg viewBox='0 0 100 20' width='100'><text x='80' y='15'>too long a word</text></svg>",
    "is cut off by its P": "<p style='height:10px'>one<br>two<br>three</p>",
    "lie on each other": "<p>one</p><p style='margin-top:-28px'>two</p>",
    "on the points": "<svg viewBox='0 0 90 90'><svg x='9' y='9' width='80' height='80'></svg><text x='20' y='50'>on"
    "</text></svg>",
    "no picture": "<img alt='nothing' src='data:image/png;base64,AAAA'><p>words</p>",
    "asks for http": "<p>words</p><img alt='far' src='http://127.0.0.1:9/far.png'>",
    "exceptionThrown": "<p>words</p><script>missing()</script>",
    "consoleAPICalled": "<p>words</p><script>console.error('wrong')</script>",
    "is no number": "<p>from -nan to 3</p>",
    "no text": "<style>p { color: red }</style>",
    "leads nowhere": "<p><a href='#there'>words</a></p>",
    "twice": "<p id='one'>words</p><p id='one'>words</p>",
    "skips a level": "<h1>words</h1><h3>words</h3>",
    "without a name": "<p>words</p><svg role='img'></svg>",
    "without a scope": "<table><tr><th>words</th></tr></table>",
}


@pytest.mark.parametrize("word", BAD)
def test_checks_see_what_is_wrong(chrome, tmp_path, word):
    file = tmp_path / "bad.html"
    file.write_text(f"<!DOCTYPE html><meta charset=utf-8><title>bad</title><body style='margin:8px'>{BAD[word]}</body>")
    chrome.open(file, 390, "light")
    found = faults(chrome, file)
    assert any(word in fault for fault in found), found


def test_checks_let_a_plain_page_pass(chrome, tmp_path):
    file = tmp_path / "plain.html"
    file.write_text("<!DOCTYPE html><meta charset=utf-8><title>plain</title><h1>Plain</h1><p>words</p>")
    chrome.open(file, 390, "light")
    assert faults(chrome, file) == []
