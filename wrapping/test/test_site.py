# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the pages of the documentation's site in a browser, at two widths, light and dark.

documentation/build.sh builds the site. SENSORNOISE_SITE_FOLDER is its folder, default build/site. `--screenshots DIR`
keeps the first screens.
"""

import os
from pathlib import Path

import pytest

SITE = Path(os.environ.get("SENSORNOISE_SITE_FOLDER", Path(__file__).resolve().parents[2] / "build" / "site"))
PAGES = sorted(
    page.relative_to(SITE).as_posix()
    for page in SITE.rglob("*.html")
    if page.relative_to(SITE).parts[0] not in ("_static", "cpp")  # Doxygen has its own layout
)
FAULTS = """({
    wide: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    broken: [...document.images].filter(image => !image.naturalWidth).map(image => image.src),
    ground: getComputedStyle(document.body).backgroundColor,
    foreign: performance.getEntriesByType("resource").map(each => each.name).filter(name => !name.startsWith("file:")),
})"""


@pytest.fixture(autouse=True)
def _built():
    if not PAGES:
        pytest.skip(f"no site in {SITE}; documentation/build.sh builds it")


def test_there_are_pages():
    assert len(PAGES) > 40


@pytest.mark.parametrize("page", PAGES)
def test_page_fits_the_screen(chrome, screenshots, page):
    """The page does not scroll sideways, every picture is there, and nothing is loaded from elsewhere."""
    chrome.open(SITE / page, 390, "light")
    for width in (390, 1280):
        chrome.send("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=1, mobile=False)
        for scheme in ("light", "dark"):
            chrome.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            found = chrome.run(FAULTS)
            assert found["wide"] <= 0, f"{page} is {found['wide']} px wider than {width}"
            assert not found["broken"]
            assert not [name for name in found["foreign"] if not name.startswith("data:")]
            assert (found["ground"] == "rgb(255, 255, 255)") == (scheme == "light"), found["ground"]
            if screenshots:
                name = page.removesuffix(".html").replace("/", "-")
                chrome.picture(screenshots / f"site-{name}-{width}-{scheme}.png", 0, 800)
