# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the page that measures bursts (examples/browser), from a server and from the disk, in a real browser.

Frames come through its file pickers and by dropping them. Numbers and sentences are compared with the native tool.
`pytest test_browser_page.py --screenshots DIR` keeps pictures of the page.
"""

import array
import functools
import gzip
import http.server
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import threading
import time
import zlib
from pathlib import Path
from random import Random

import numpy as np
import pytest
from test_browser import CHECKS, complaints

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "build" / "browser" / "site"
sys.path += [str(ROOT / "test" / "fuzz"), str(ROOT / "examples" / "python")]
import frame_parts  # noqa: E402 - of the tests of the native tool
from frame_files import all_cases, png_chunk  # noqa: E402
from frame_stacks import RATIONAL, SHORT, read_frames, write_dng, write_stack  # noqa: E402
from mutations import mutate  # noqa: E402

pytestmark = pytest.mark.skipif(
    not (SITE / "index.html").exists(), reason=f"no page in {SITE}: build it by examples/browser/build.sh"
)
SECONDS = 60.0  # that an answer may take on a busy computer
DONE = "!document.getElementById('result').hidden || document.getElementById('error').textContent !== ''"
SMALL = "--size 96x64 --frames 20"


@pytest.fixture(scope="module")
def address():
    """Yields the address of the page on a server of this computer."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_) -> None:
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=SITE)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/index.html"
        server.shutdown()


class Page:
    """The page in a browser, as a user has it."""

    def __init__(self, browser, address: str | Path, width: int = 1280, scheme: str = "light"):
        self.browser = browser
        browser.open(address, width, scheme)
        self.wait("document.getElementById('version').textContent !== '' && planned !== undefined")

    def wait(self, condition: str) -> None:
        end = time.monotonic() + SECONDS
        while not self.browser.run(f"Boolean({condition})"):
            assert time.monotonic() < end, f"{condition}: not within {SECONDS} s"
            time.sleep(0.02)

    def text(self, part: str) -> str:
        return self.browser.run(f"document.getElementById('{part}').textContent")

    def click(self, part: str) -> None:
        self.browser.run(f"document.getElementById('{part}').click()")

    def choose(self, files: list, part: str = "files") -> str:
        """Gives files to a file picker, and waits for what the page says of them. Returns its error; "": none."""
        self.browser.run("state += 1; document.getElementById('error').textContent = ''; window.before = state; null")
        root = self.browser.send("DOM.getDocument")["root"]["nodeId"]
        node = self.browser.send("DOM.querySelector", nodeId=root, selector=f"#{part}")["nodeId"]
        self.browser.send("DOM.setFileInputFiles", nodeId=node, files=[str(file) for file in files])
        return self.wait_for_files()

    def wait_for_files(self) -> str:
        self.wait("state > before && (!part('measure').disabled || part('error').textContent !== '')")
        return self.text("error")

    def drop(self, path: Path) -> str:
        """Drops a file or a folder, and waits as choose()."""
        self.browser.run("window.before = state; null")
        place = self.browser.run("(({x, y}) => ({x: x + 20, y: y + 20}))(part('drop').getBoundingClientRect())")
        data = {"items": [], "files": [str(path)], "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            self.browser.send("Input.dispatchDragEvent", type=kind, x=place["x"], y=place["y"], data=data)
        return self.wait_for_files()

    def set(self, **options) -> None:
        for part, value in options.items():
            self.browser.run(f"document.getElementById({json.dumps(part)}).value = {json.dumps(value)}")

    def measure(self, button: str = "measure") -> dict | None:
        """Returns the report as a record; None: the page shows an error."""
        self.click(button)
        self.wait(f"part('stop').hidden && ({DONE})")
        return json.loads(self.browser.run("result.json")) if self.text("error") == "" else None


@pytest.fixture
def page(chrome, address):
    return Page(chrome, address)


def numbers(record, path: str = "") -> dict:
    """Returns the values of a record by their paths, without what the page does not know of files."""
    if isinstance(record, dict):
        items = [(f"{path}/{name}", value) for name, value in record.items() if name != "input"]
    elif isinstance(record, list):
        items = [(f"{path}/{number}", value) for number, value in enumerate(record)]
    else:
        return {path: record}
    return {name: value for at, one in items for name, value in numbers(one, at).items()}


def require_same(found: dict, expected: dict, tolerance: float = 1e-9) -> None:
    """Requires that numbers are equal to a relative tolerance, which is 1e-6 for the noise correlation, and all else
    exactly."""
    found, expected = numbers(found), numbers(expected)
    assert found.keys() == expected.keys()
    for name, value in expected.items():
        if isinstance(value, float) and isinstance(found[name], (int, float)):
            relative = max(tolerance, 1e-6) if "correlation" in name else tolerance
            assert math.isclose(found[name], value, rel_tol=relative, abs_tol=1e-12), (name, found[name], value)
        else:
            assert found[name] == value, name


def by_tool(tool, *arguments) -> dict | str:
    """Returns the report of the native tool, or its error."""
    try:
        text = tool("estimate-sensor-noise", *arguments, "--json", "-", "--quiet")
    except subprocess.CalledProcessError as error:
        if error.returncode != 3:
            return error.stderr
        text = error.stdout
    return json.loads(text)


def require_nothing_asked_elsewhere(browser, address: str | Path) -> None:
    own = address.rsplit("/", 1)[0] if isinstance(address, str) else address.resolve().as_uri()
    asked = [event["request"]["url"] for method, event in browser.events if method == "Network.requestWillBeSent"]
    assert asked
    assert [url for url in asked if not url.startswith((own, "data:", "blob:", "about:"))] == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1280])
def test_page_is_whole_and_shows_an_example(chrome, address, width, scheme, screenshots):
    page = Page(chrome, address, width, scheme)
    assert chrome.run(CHECKS) == []
    record = page.measure("example")
    gain = record["gain"]
    assert abs(gain["value"] - 1.0) < 5.0 * gain["standard_error"]  # camera B
    page.wait("part('report').contentDocument.querySelector('.verdict')")
    assert "simulated burst" in chrome.run("part('report').contentDocument.title")
    assert chrome.run(CHECKS) == []
    assert complaints(chrome) == []
    require_nothing_asked_elsewhere(chrome, address)
    assert chrome.run("document.documentElement.scrollWidth <= innerWidth")
    if screenshots:
        chrome.picture(screenshots / f"browser-page-{width}-{scheme}.png")


def press(browser, key: str, code: int) -> None:
    """Presses a key with the character "\r" for Enter, and none for others."""
    text = {"text": "\r"} if key == "Enter" else {}
    for kind in ("keyDown", "keyUp"):
        typed = text if kind == "keyDown" else {}
        browser.send("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code, **typed)


def test_keyboard_reaches_all_controls_and_measures(page, chrome):
    chrome.run("document.getElementById('options').open = true")
    controls = chrome.run(
        "[...document.querySelectorAll('input, select, button, summary')].filter((one) => !one.disabled &&"
        " one.getClientRects().length > 0).map((one) => one.id || one.tagName)"
    )
    reached = []
    for _ in range(3 * len(controls)):
        press(chrome, "Tab", 9)
        name = chrome.run("document.activeElement.id || document.activeElement.tagName")
        if reached and name == reached[0]:
            break
        reached.append(name)
        outlines = chrome.run(
            "[document.activeElement, ...(document.activeElement.labels || [])]"
            ".map((one) => getComputedStyle(one).outlineStyle)"
        )
        assert "solid" in outlines or name == "BODY", name
    assert set(controls) <= set(reached) and len(controls) > 15
    while chrome.run("document.activeElement.id") != "example":
        press(chrome, "Tab", 9)
    press(chrome, "Enter", 13)
    page.wait("part('stop').hidden && part('measure').disabled && !part('result').hidden")
    assert chrome.run("document.activeElement.id") == "result-title"


def test_every_control_has_a_name_for_screen_readers(page, chrome):
    chrome.run("document.getElementById('options').open = true")
    page.measure("example")
    nodes = chrome.send("Accessibility.getFullAXTree")["nodes"]
    roles = {"button", "combobox", "textbox", "spinbutton", "slider", "Iframe", "region", "form", "DisclosureTriangle"}
    controls = [
        (node["role"]["value"], node.get("name", {}).get("value", ""))
        for node in nodes
        if not node["ignored"] and node["role"]["value"] in roles
    ]
    assert len(controls) > 20
    assert [one for one in controls if not one[1].strip()] == []


def test_picture_of_the_documentation(chrome, address, tmp_path, screenshots):
    """`-k documentation --screenshots documentation` writes browser.png: the page with the report of its example."""
    page = Page(chrome, address, 1000, "light")
    assert page.measure("example")["gain"]["status"] == "identified"
    page.wait("part('report').contentDocument.querySelector('.verdict')")
    file = (screenshots or tmp_path) / "browser.png"
    chrome.picture(file, 0, 1136)  # to the end of the first figure
    pillow = pytest.importorskip("PIL.Image")
    with pillow.open(file) as image:
        image.convert("RGB").quantize(64).save(file, optimize=True)
    assert file.stat().st_size < 100_000


def test_one_file_works_from_the_disk(chrome):
    page = Page(chrome, SITE / "sensor-noise.html")
    assert page.measure("example")["gain"]["status"] == "identified"
    assert complaints(chrome) == []
    require_nothing_asked_elsewhere(chrome, SITE / "sensor-noise.html")


# Options of the simulator, ending of the stack, options of the page, and of the tool.
BURSTS = {
    "target": (SMALL, "mha", {}, ""),
    "texture": (f"{SMALL} --reference texture --vibration-sd 0.1,0.1", "nrrd", {}, ""),
    "bayer": ("--size 192x128 --frames 20 --bayer RGGB", "tif", {}, ""),
    "bits": (SMALL, "tif", {"bit-depth": "12", "offset": "100"}, "--bit-depth 12 --offset 100"),
    "published": (SMALL, "mha", {"method": "published"}, "--method published"),
    "single-image": ("--size 256x192 --frames 20", "mha", {"method": "single-image"}, "--method single-image"),
}


@pytest.mark.parametrize("burst", BURSTS)
def test_report_is_that_of_the_tool(page, tool, tmp_path, burst):
    flags, ending, options, arguments = BURSTS[burst]
    stack = tmp_path / f"burst.{ending}"
    tool("simulate-sensor-noise", "--output", stack, *flags.split())
    page.set(**options)
    assert page.choose([stack]) == ""
    assert "20 frames of" in page.text("chosen") and "of memory" in page.text("chosen")
    require_same(page.measure(), by_tool(tool, stack, *arguments.split()))


def test_dark_frames_are_those_of_the_tool(page, tool, tmp_path):
    for name, flags in (("burst", SMALL), ("dark", "--size 96x64 --frames 8 --dark")):
        tool("simulate-sensor-noise", "--output", tmp_path / f"{name}.mha", *flags.split())
    assert page.choose([tmp_path / "burst.mha"]) == ""
    assert page.choose([tmp_path / "dark.mha"], "dark") == ""
    require_same(page.measure(), by_tool(tool, tmp_path / "burst.mha", "--dark", tmp_path / "dark.mha"))


# The stacks of test/reports: options of the simulator ("": flat), type of pixels, options of the page and of the tool,
# and whether the stack is the stack of the report. Stacks of float have fractions there, and the page takes no error of
# an offset.
STORED_SIZE = "--size 96x80 --frames 30 --seed 7"
BYTES = f"{STORED_SIZE} --reference texture --camera C --gain 0.01875 --offset 2.5 --read-noise 0.1875 --bit-depth 8"
STORED = {
    "RefinedTarget": (f"{STORED_SIZE} --camera B --condition 3", "uint16", {}, "", True),
    "RefinedTextureOfBytes": (f"{BYTES} --condition 1", "uint8", {}, "", True),
    "RefinedKnownOffset": (
        f"{STORED_SIZE} --reference texture --camera C --condition 2",
        "int16",
        {"offset": "40"},
        "--offset 40",
        False,
    ),
    "RefinedDarkFrames": (f"{STORED_SIZE} --camera A --condition 1", "float32", {}, "", False),
    "RefinedRollingShutter": (f"{STORED_SIZE} --condition 3 --rolling-shutter 40", "uint16", {}, "", True),
    "RefinedFlat": ("", "int16", {}, "", True),
    "PublishedTarget": (f"{STORED_SIZE} --condition 1", "uint16", {"method": "published"}, "--method published", True),
    "PublishedTextureOfBytes": (
        f"{BYTES} --condition 3",
        "uint8",
        {"method": "published"},
        "--method published",
        True,
    ),
    "PublishedRollingShutter": (
        f"{STORED_SIZE} --reference bars --camera A --condition 1 --rolling-shutter 40",
        "float32",
        {"method": "published"},
        "--method published",
        False,
    ),
    "PublishedFlat": ("", "uint8", {"method": "published"}, "--method published", True),
}


def test_all_stored_reports_are_looked_at():
    assert {file.stem for file in (ROOT / "test" / "reports").glob("*.json")} == set(STORED)


def stored_part(record: dict) -> dict:
    """Returns what test/reports has of a record: see StoredReportTestHelper.h."""
    kept = {name: value for name, value in record.items() if name not in ("version", "input", "camera")}
    kept["scatter"] = {name: values and values[::16] for name, values in record["scatter"].items()}
    kept["flicker_rows"] = record["flicker_rows"] and [frame and frame[::16] for frame in record["flicker_rows"]]
    return kept


@pytest.mark.parametrize("name", STORED)
def test_stored_reports_are_found(page, tool, tmp_path, name):
    flags, pixel, options, arguments, is_stored = STORED[name]
    stack = tmp_path / "stack.mha"
    if flags:
        tool("simulate-sensor-noise", "--output", stack, *flags.split())
        frames = read_frames(stack)[0]
    else:
        frames = np.full((30, 80, 96), -3 if pixel == "int16" else 255)
    write_stack(stack, frames.astype(pixel))
    dark = tmp_path / "dark.mha"
    if "Dark" in name:
        tool("simulate-sensor-noise", "--output", dark, *flags.replace("30", "12").split(), "--dark")
        write_stack(dark, read_frames(dark)[0].astype(pixel))
    page.set(**options)
    assert page.choose([stack]) == ""
    assert not dark.exists() or page.choose([dark], "dark") == ""
    found = page.measure()
    require_same(found, by_tool(tool, stack, *arguments.split(), *(("--dark", dark) if dark.exists() else ())))
    if is_stored:
        require_same(stored_part(found), json.loads((ROOT / "test" / "reports" / f"{name}.json").read_text()))


def cases_of(tool, folder: Path, size: tuple[int, int], frames: int, *flags: str) -> list:
    """Returns undamaged files of all formats with the frames of a simulated burst."""
    stack = folder / "frames.mha"
    tool("simulate-sensor-noise", "--output", stack, "--size", "x".join(map(str, size)), "--frames", frames, *flags)
    pixels = [frame.tobytes() for frame in read_frames(stack)[0]]
    before = frame_parts.WIDTH, frame_parts.HEIGHT
    frame_parts.WIDTH, frame_parts.HEIGHT = size
    try:
        return all_cases(pixels)
    finally:
        frame_parts.WIDTH, frame_parts.HEIGHT = before


@pytest.fixture(scope="module")
def cases(tool, tmp_path_factory):
    """Returns undamaged small files of all formats."""
    return cases_of(tool, tmp_path_factory.mktemp("frames"), (48, 32), 8)


def written(case, folder: Path) -> list[Path]:
    folder.mkdir(exist_ok=True)
    for file in case.files:
        (folder / file.name).write_bytes(file.data)
    return [folder / file.name for file in case.files]


def test_every_format_is_read_as_by_the_tool(page, tool, tmp_path):
    """The frames are the frames of the stored report RefinedTarget, in every format that fits them."""
    gains = []
    for number, case in enumerate(cases_of(tool, tmp_path, (96, 80), 30, "--seed", "7")):
        files = written(case, tmp_path / str(number))
        page.set(raw=case.raw)
        error = page.choose(files)
        options = ("--raw", case.raw) if case.raw else ()
        expected = by_tool(tool, *(tmp_path / str(number) / name for name in case.frames), *options)
        found = page.measure() if error == "" else None
        assert (found is None) == isinstance(expected, str), (case.name, error, expected)
        if found is not None:
            require_same(found, expected)
            gains.append((case.name.split()[0], found.get("gain", {}).get("value")))
    stored = json.loads((ROOT / "test" / "reports" / "RefinedTarget.json").read_text())["gain"]["value"]
    whole = {name for name, gain in gains if gain is not None and math.isclose(gain, stored, rel_tol=1e-9)}
    assert whole >= {"mha", "mhd", "nrrd", "nhdr", "tiff", "bigtiff", "png"}
    assert whole >= {"ser", "fits", "npy", "pgm", "mraw", "raw", "dng"}


@pytest.mark.parametrize("cfa", [(0, 1, 1, 2), (1, 2, 0, 1)])
def test_settings_of_a_raw_file_reach_the_estimate(page, tool, tmp_path, cfa):
    """The page reads the same pattern, black and white level, ISO speed and exposure from a mosaic as DNG as the tool
    does."""
    flags = "--size 192x128 --frames 20 --bayer RGGB"
    tool("simulate-sensor-noise", "--output", tmp_path / "b.mha", *flags.split())
    frames, _ = read_frames(tmp_path / "b.mha")
    files = [tmp_path / f"IMG_{number}.dng" for number in range(len(frames))]
    for name, grey_values in zip(files, frames, strict=True):
        exif = [(33434, RATIONAL, [1, 50]), (34855, SHORT, [400])]
        write_dng(name, grey_values, black=100, white=3500, cfa=cfa, model=b"Model 5", exif=exif)
    assert page.choose(files) == ""
    pattern = "".join("RGB"[colour] for colour in cfa)
    assert "20 frames of 192 x 128" in page.text("chosen")
    assert f"Maker Model 5, {pattern}, 12 bits, black level 100 DN, white level 3500 DN." in page.text("chosen")
    found = page.measure()
    require_same(found, by_tool(tool, *files))
    assert found["bayer"] == {"pattern": pattern, "source": "file"}
    page.set(bayer="none")
    assert page.choose(files) == ""
    require_same(page.measure(), by_tool(tool, *files, "--bayer", "none"))


def test_program_is_small():
    files = [SITE / name for name in ("sensor-noise.wasm", "sensor-noise.js")]
    assert sum(len(gzip.compress(file.read_bytes(), 9)) for file in files) <= 1.5e6


def as_on_the_page(error: str, folder: Path) -> str:
    """Returns an error of the tool in the words of the page, which knows no folder and ends each sentence."""
    text = error.strip().splitlines()[-1].removeprefix("error: ").replace(f"{folder}/", "")
    return text[0].upper() + text[1:] + ("" if text.endswith((".", "!", "?")) else ".")


def test_damaged_files_end_in_the_sentence_of_the_tool(page, tool, cases, tmp_path):
    """Files behind a page are of another kind, and its numbers of bytes have 32 bits: few sentences differ."""
    random = Random(45)
    differ = []
    for number in range(100):
        case = random.choice(cases)
        files = written(case, tmp_path / str(number))
        damaged = random.choice(files)
        change, data = mutate(damaged.read_bytes(), random)
        damaged.write_bytes(data)
        page.set(raw=case.raw)
        error = page.choose(files)
        record = page.measure() if error == "" else None
        error = page.text("error")
        assert record is not None or error.endswith("."), (number, case.name, change)
        assert "the program of the page" not in error.lower(), (number, case.name, change, error)
        options = ("--raw", case.raw) if case.raw else ()
        expected = by_tool(tool, *(tmp_path / str(number) / name for name in case.frames), *options)
        if record is not None and not isinstance(expected, str):
            require_same(record, expected, 1e-6)  # these few pixels and frames determine little
        elif (
            record is not None
            or not isinstance(expected, str)
            or error != as_on_the_page(expected, tmp_path / str(number))
        ):
            differ.append((number, case.name, change, error, expected))
    assert len(differ) <= 3, differ
    assert complaints(page.browser) == []
    assert page.measure("example")["gain"]["status"] == "identified"


def test_dropped_files_are_measured_and_saved(page, chrome, tool, tmp_path):
    stack = tmp_path / "burst.mha"
    tool("simulate-sensor-noise", "--output", stack, *SMALL.split())
    assert page.drop(stack) == ""
    record = page.measure()
    saved = tmp_path / "saved"
    chrome.send("Page.setDownloadBehavior", behavior="allow", downloadPath=str(saved))
    chrome.run("part('format').value = 'fits'")
    for button, pattern in (("save-json", "*.json"), ("save-page", "*.html"), ("save-export", "*")):
        before = len(list(saved.glob("*")))
        page.click(button)
        end = time.monotonic() + SECONDS
        while len([one for one in saved.glob("*") if one.suffix != ".crdownload"]) == before:
            assert time.monotonic() < end, f"{button}: nothing saved"
            time.sleep(0.05)
        assert list(saved.glob(pattern))
    assert json.loads((saved / "report.json").read_text()) == record
    assert "Noise of burst.mha" in (saved / "report.html").read_text()
    exported = next(one for one in saved.glob("*") if one.suffix not in (".json", ".html"))
    assert exported.read_text() == tool("export-noise-model", saved / "report.json", "--format", "fits")


def test_noise_models_are_those_of_the_tool(page, tool, tmp_path):
    """Every format that the page offers has the bytes of the tool, or its error."""
    tool("simulate-sensor-noise", "--output", tmp_path / "burst.mha", *SMALL.split())
    for number, grey_values in enumerate(read_frames(tmp_path / "burst.mha")[0]):
        write_dng(tmp_path / f"f_{number:02}.dng", grey_values, black=100, white=4095)
    page.set(bayer="none")
    assert page.choose(sorted(tmp_path.glob("f_*.dng"))) == ""
    record = page.measure()
    (tmp_path / "report.json").write_text(page.browser.run("result.json"))
    formats = page.browser.run("[...part('format').options].map((one) => one.value)")
    assert len(formats) > 12
    made = 0
    for name in formats:
        ask = f"library.ask({{what: 'export', report: result.json, format: {json.dumps(name)}}})"
        files = "(answer.files || []).map((file) => [file.name, [...file.bytes]])"
        answer = page.browser.run(f"{ask}.then((answer) => ({{error: answer.error || '', files: {files}}}))")
        try:
            tool("export-noise-model", tmp_path / "report.json", "--format", name, "--output", tmp_path / "out.bin")
        except subprocess.CalledProcessError as error:
            assert answer["error"], (name, error.stderr)
            assert as_on_the_page(error.stderr, tmp_path)[:-1].lower() in answer["error"].lower() + ".", name
            continue
        assert answer["error"] == "", name
        out = tmp_path / "out.bin"
        expected = {file.name: file.read_bytes() for file in ([out] if out.is_file() else out.iterdir())}
        found = {file_name: bytes(content) for file_name, content in answer["files"]}
        assert list(found.values()) == list(expected.values()) if out.is_file() else found == expected, name
        shutil.rmtree(out, ignore_errors=True)
        out.unlink(missing_ok=True)
        made += 1
    assert made > 8
    assert record["camera"]["white_level"] == 4095


def test_folder_is_one_burst(page, tool, tmp_path):
    """Frames are in the order of the numbers in their names, and other files are left out."""
    tool("simulate-sensor-noise", "--output", tmp_path / "burst.mha", *SMALL.split())
    data = (tmp_path / "burst.mha").read_bytes()[-20 * 96 * 64 * 2 :]
    folder = tmp_path / "frames"
    folder.mkdir()
    names = [folder / f"frame_{number}.pgm" for number in range(20)]
    for number, name in enumerate(names):
        frame = array.array("H", data[number * 96 * 64 * 2 : (number + 1) * 96 * 64 * 2])
        frame.byteswap()
        name.write_bytes(b"P5\n96 64\n65535\n" + frame.tobytes())
    (folder / "notes.txt").write_text("no frame")
    assert page.drop(folder) == ""
    require_same(page.measure(), by_tool(tool, *names))
    assert "Noise of frame_0.pgm to frame_19.pgm" in page.browser.run("part('report').srcdoc")


def test_files_that_change_or_vanish_are_refused(page, tool, tmp_path):
    stack = tmp_path / "burst.mha"
    tool("simulate-sensor-noise", "--output", stack, *SMALL.split())
    assert page.choose([stack]) == ""
    os.utime(stack, (0, 0))
    assert page.measure() is None and "was changed, moved or removed" in page.text("error")
    stack.unlink()
    assert page.measure() is None and "was changed, moved or removed" in page.text("error")
    assert page.measure("example") is not None


def test_measurement_can_be_stopped(page, chrome, tool, tmp_path):
    stack = tmp_path / "burst.mha"
    tool("simulate-sensor-noise", "--output", stack, "--size", "768x768", "--frames", "60")
    assert page.choose([stack]) == ""
    page.click("measure")
    page.wait("part('bar').value > 0 && part('pass').textContent.startsWith('Pass')")
    page.click("stop")
    assert page.text("error") == "The measurement was stopped."
    assert chrome.run("part('result').hidden && part('stop').hidden && !part('measure').disabled")
    assert page.measure("example") is not None


def test_check_of_files_can_be_stopped(page, chrome, tool, tmp_path):
    """A compressed stack is inflated for the check, which takes a while."""
    size = 1024
    header = struct.pack(">IIBBBBB", size, size, 16, 0, 0, 0, 0)
    data = zlib.compress(bytes(size * (1 + 2 * size)), 1)
    chunks = [(b"IHDR", header), (b"IDAT", data), (b"IEND", b"")]
    content = b"\x89PNG\r\n\x1a\n" + b"".join(png_chunk(*chunk) for chunk in chunks)
    files = [tmp_path / f"frame_{number}.png" for number in range(300)]
    for file in files:
        file.write_bytes(content)
    root = chrome.send("DOM.getDocument")["root"]["nodeId"]
    node = chrome.send("DOM.querySelector", nodeId=root, selector="#files")["nodeId"]
    chrome.send("DOM.setFileInputFiles", nodeId=node, files=[str(file) for file in files])
    page.wait("!part('stop').hidden")
    page.click("stop")
    assert page.text("error") == "The check of the files was stopped. Choose the files again."
    assert chrome.run("part('stop').hidden && part('measure').disabled")
    assert page.choose(files[:20]) == ""
    assert page.measure("example") is not None


def test_frames_that_need_too_much_memory_are_refused(page, tmp_path):
    sparse = tmp_path / "large.pgm"
    header = b"P5\n8000 8000\n65535\n"
    with sparse.open("wb") as file:
        file.write(header)
        file.truncate(len(header) + 8000 * 8000 * 2)
    error = page.choose([sparse])
    assert "a page can use 2 GB" in error and f"estimate-sensor-noise {sparse.name} --plot report.html" in error


def test_plan_is_that_of_the_cramer_rao_bound(page):
    """The error of the gain falls with the root of the frames less one, and without flicker there is no offset."""

    def plan(frames: int, flicker: float) -> dict:
        burst = {"megapixels": 1, "electrons": 3000, "contrast": 10, "gain": 2, "read_noise": 3}
        request = {"what": "plan", "frames": frames, "flicker": flicker, **burst}
        return page.browser.run(f"library.ask({json.dumps(request)})")

    few, many = (plan(frames, 0.02) for frames in (26, 101))
    assert math.isclose(few["gain_percent"], 2.0 * many["gain_percent"], rel_tol=1e-12)
    assert math.isclose(few["offset_dn"], 2.0 * many["offset_dn"], rel_tol=1e-12)
    assert plan(20, 0.0)["offset_dn"] is None
    assert math.isclose(plan(26, few["flicker_for_offset"])["offset_dn"], 1.0, rel_tol=1e-6)
    assert "; with 50 frames a contrast of 1." in page.text("planned")
    assert ", or a flicker of " in page.text("planned")
    page.set(flicker="0")
    page.browser.run("part('flicker').dispatchEvent(new Event('input', { bubbles: true }))")
    page.wait("part('planned').textContent.includes('record dark frames')")


def test_error_of_options_is_a_sentence(page, tool, tmp_path):
    stack = tmp_path / "burst.mha"
    tool("simulate-sensor-noise", "--output", stack, *SMALL.split())
    page.set(method="published", offset="100")
    assert page.choose([stack]) == ""
    assert page.measure() is None
    assert "cannot be used by the method published" in page.text("error")


def test_page_survives_the_failure_of_its_program(page):
    ask = "library.ask({{ what: {!r} }}, {}).then((answer) => answer.error)"
    assert "expected one that the page has" in page.browser.run(ask.format("nonsense", "[]"))
    assert "the program of the page failed" in page.browser.run(ask.format("inspect", "['no file']"))
    assert page.measure("example") is not None
