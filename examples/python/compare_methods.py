# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the same frames by every method, and by programs of other authors, and writes one comparison.

    python examples/python/compare_methods.py --bin build/bin --output comparison [--peers FOLDER] [--real FOLDER]

Needs the built tools and the standard library only. Writes comparison.md and comparison.html. The settings are
Tables 2 and 3 of Sur & Grédiac 2015, mosaics like the mosaics of the cameras in its Table 5, and real frames
(compare_settings.py). --peers FOLDER runs programs of other authors in environments of their own, which are made in the
folder with venv and pip (compare_peers.py). --real FOLDER names a folder with real frames. --settings chooses settings
by patterns of their names, for example 'B3/*' 'EOS 6D/target/*'. --quick measures one simulated setting of each kind, 6
of 38, and the real frames of --real. The last line has the processor time of each part.

The times are processor times: of estimate-sensor-noise with its start and the reading of the file.
"""

import argparse
import fnmatch
import math
import os
import sys
import tempfile
from pathlib import Path
from statistics import fmean

from compare_peers import install_all, rows_by_peers
from compare_rows import QUANTITIES, Estimate, Row, motion_rows, rows_by_tool
from compare_settings import make_frames, mosaic_settings, paper_settings, real_settings
from compare_tables import NONE, Table, as_html, as_markdown, percent, text_of
from paper_tables import CANON_GAINS, SINGLE_IMAGE

TITLE = "Methods side by side"
GAIN, OFFSET, READ_NOISE, INTERCEPT = "gain g [DN/e⁻]", "offset μ [DN]", "read noise σ [DN]", "σ² − gμ [DN²]"
COLUMNS = ("setting", "method", GAIN, "error of g [%]", OFFSET, READ_NOISE, INTERCEPT, "time [s]", "needs", "remark")
GROUPS = {
    "paper": (
        "Simulations of the paper, as its Tables 2 and 3",
        "Frames as in section 4.2 of the paper; its scenes are not public. One stack of each setting. The row of the "
        "paper is the mean and twice the standard deviation of 50 stacks of the paper. Its rows of cameras A and B in "
        "Table 3 are missing: they are not readable in the available text of the paper.",
    ),
    "mosaic": (
        "Mosaics like the mosaics of Table 5, red channel",
        "The truth is the gain, offset and read noise that the paper measured by photon transfer. The light is a neon "
        "lamp, which a rolling shutter shows as bands from ISO 800 on. EMVA 1288 has flats under steady light instead.",
    ),
    "real": ("Real frames", "Frames of two cameras."),
}
MOTION_COLUMNS = (
    "setting",
    "channel",
    "vibration σ_α [pixel]",
    "vibration σ_β [pixel]",
    "covariance [pixel²]",
    "flicker σ_γ",
)
# One setting of each kind: camera and scene of the paper, and each mosaic camera at its middle speed.
QUICK = ("B3/*", "EOS 350D/*/ISO 400", "EOS 6D/*/ISO 1600")
PARTS = ("simulation", "methods of this project", "other programs")
OF_PAPER = "program of Foi et al. (paper)"


def paper_row(setting):
    """Returns the row of the column "Foi et al." of the paper; None: the setting has none."""
    figures = SINGLE_IMAGE.get(setting.scene, {}).get(setting.name.split("/")[0]) if setting.group == "paper" else None
    if figures is None:
        return None
    found = {name: Estimate(*figure) for name, figure in zip(("gain", "intercept"), figures, strict=True)}
    return Row(OF_PAPER, "burst", found, None, "mean ± twice the standard deviation of 50 stacks")


def processor_seconds():
    """Returns the processor time of this program and of those that it has run [s]."""
    return sum(os.times()[:4])


def measure_setting(options, setting, installed, shared, seconds):
    """Returns the rows of a setting, and the rows of the motion of a mosaic. Adds the processor time [s] of each of
    PARTS to `seconds`."""
    times = [processor_seconds()]
    with tempfile.TemporaryDirectory(dir=shared) as folder:
        frames = make_frames(setting, options.bin, Path(folder), shared)
        times.append(processor_seconds())
        rows = rows_by_tool(options.bin, setting, frames)
        motion = motion_rows(options.bin, setting, frames) if frames.mosaic else []
        times.append(processor_seconds())
        rows += rows_by_peers(installed, setting, frames)
        times.append(processor_seconds())
        of_paper = paper_row(setting)
    for part, start, end in zip(PARTS, times, times[1:], strict=False):
        seconds[part] += end - start
    return rows + ([of_paper] if of_paper else []), motion


def text_of_times(seconds):
    """Returns a sentence with the processor time [s], and the fraction of each part."""
    total = sum(seconds.values())
    fractions = ", ".join(f"{part} {100 * of_part / max(total, 1e-9):.0f} %" for part, of_part in seconds.items())
    return f"processor time: {total:.0f} s ({fractions})"


def truth_cells(setting):
    truth = setting.truth
    values = [text_of(Estimate(getattr(truth, name), None)) if truth else NONE for name in QUANTITIES]
    return (setting.name, "truth", values[0], NONE, *values[1:], NONE, NONE, setting.note)


def gain_error(setting, row):
    """Returns the relative error of a gain [1]; None without a gain or a truth."""
    return row.found["gain"].value / setting.truth.gain - 1 if "gain" in row.found and setting.truth else None


def cells_of(setting, row):
    texts = [text_of(row.found.get(name)) for name in QUANTITIES]
    time = NONE if row.seconds is None else f"{row.seconds:.2f}"
    error = percent(gain_error(setting, row))
    return (setting.name, row.method, texts[0], error, *texts[1:], time, row.needs, row.remark)


def rms_cell(measured, method, group, scene):
    """Returns the rms error of the gains of a method in % over the settings of a group with a scene, and how many
    settings have a gain."""
    errors = [
        gain_error(setting, row)
        for setting, rows, _ in measured
        for row in rows
        if (row.method, setting.group, setting.scene) == (method, group, scene)
    ]
    found = [100 * error for error in errors if error is not None]
    rms = math.sqrt(fmean(error**2 for error in found)) if found else None
    text = NONE if rms is None else f"{rms:.0f}" if rms >= 100 else f"{rms:#.2g}".rstrip(".")
    return f"{text} ({len(found)} of {len(errors)})" if errors else NONE


def summary(measured):
    """Returns the table of all methods over the simulated settings; None without any."""
    kinds = list(dict.fromkeys((setting.group, setting.scene) for setting, _, _ in measured if setting.scene))
    if not kinds:
        return None
    table = []
    methods = {row.method: row.needs for _, rows, _ in measured for row in rows if row.method != OF_PAPER}
    for method, needs in methods.items():
        times = [row.seconds for _, rows, _ in measured for row in rows if row.method == method and row.seconds]
        cells = [rms_cell(measured, method, *kind) for kind in kinds]
        table.append((method, *cells, f"{fmean(times):.2f}" if times else NONE, needs))
    columns = ("method", *(f"{group}, {scene} [%]" for group, scene in kinds), "mean time [s]", "needs")
    text = "Rms errors of the gain over the settings, one stack each. In brackets: settings with a gain."
    return Table("Simulated settings", text, columns, table)


def table_5(measured):
    """Returns the errors of the gain next to the errors in the paper's Table 5; None without mosaics."""
    methods = ("refined", "published", "single image, all frames", "affine fit, no correction")
    table = []
    for setting, rows, _ in measured:
        if not setting.is_mosaic:
            continue
        body, scene, speed = setting.name.split("/")
        of_paper = CANON_GAINS[body, scene][int(speed.removeprefix("ISO "))]
        found = {row.method: row.found["gain"].value for row in rows if "gain" in row.found}
        gains = (*map(found.get, methods), *of_paper)
        errors = (None if gain is None else gain / setting.truth.gain - 1 for gain in gains)
        table.append((setting.name, f"{setting.truth.gain:g}", *map(percent, errors)))
    columns = ("setting", GAIN, *methods, "paper: Foi et al.", "paper: proposed", "paper: affine")
    text = (
        "Errors of the gain in %. The columns of the paper are from the real cameras, whose photon transfer has errors "
        "of its own; the others are from simulated frames with the same gains, offsets and read noises."
    )
    return Table("Errors of the gain, as Table 5", text, columns, table) if table else None


def tables_of(measured):
    tables = [one for one in [summary(measured)] if one]
    for group, (heading, text) in GROUPS.items():
        table = []
        for setting, rows, _ in measured:
            if setting.group == group:
                table += [truth_cells(setting), *(cells_of(setting, row) for row in rows)]
        if table:
            tables.append(Table(heading, text, COLUMNS, table))
    tables += [one for one in [table_5(measured)] if one]
    motion = [(*row[:2], *map(text_of, row[2:])) for _, _, rows in measured for row in rows]
    if motion:
        text = "Refined method on whole mosaics, in pixels of the channel; the truth is of the simulated stack."
        tables.append(Table("Vibration and flicker by channel, as Table 6", text, MOTION_COLUMNS, motion))
    return tables


def chosen_settings(options, parser):
    """Returns the chosen settings, and a sentence about those that are left out."""
    settings = [*paper_settings(options.size, options.frames), *mosaic_settings(options.size, options.frames)]
    note = "Real frames are left out: --real names no folder."
    if options.real:
        real = list(real_settings(options.real))
        absent = [setting.name for setting in real if not setting.source.exists()]
        note = f"Left out, as {options.real} does not have the frames: {', '.join(absent)}." if absent else ""
        settings += [setting for setting in real if setting.source.exists()]
    patterns = options.settings or (QUICK if options.quick else ["*"])

    def is_chosen(one):
        is_named = any(fnmatch.fnmatch(one.name, pattern) for pattern in patterns)
        return is_named or (options.quick and one.group == "real")

    chosen = [one for one in settings if is_chosen(one)]
    unnamed = [one.name for one in settings if one.group == "real" and not is_chosen(one)]
    if unnamed:
        note = f"{note} Left out by --settings, as real frames that it does not name: {', '.join(unnamed)}.".strip()
    if not chosen:
        parser.error(f"no setting is named {patterns}; known: {', '.join(one.name for one in settings)}")
    return chosen, note


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of the built tools")
    parser.add_argument("--output", default="comparison", help="name of the files, without .md and .html")
    parser.add_argument("--peers", type=Path, help="folder of the environments of other programs; else they do not run")
    parser.add_argument("--real", type=Path, help="folder of emccd_50x30x180.npy and saz_75x40x640_u8.npy")
    chosen = parser.add_mutually_exclusive_group()
    chosen.add_argument("--settings", nargs="+", help="patterns of names (default: all)")
    chosen.add_argument("--quick", action="store_true", help=f"the settings {', '.join(QUICK)}, and real frames")
    parser.add_argument(
        "--size", type=int, help="width and height of simulated frames, instead of the setting's [pixels]"
    )
    parser.add_argument("--frames", type=int, help="frames of a simulated burst (default: 100)")
    parser.add_argument("--folder", help="for the frames, 100 MB (default: the folder of temporary files)")
    options = parser.parse_args(arguments)
    options.bin = options.bin.resolve()
    for tool in ("estimate-sensor-noise", "simulate-sensor-noise"):
        if not (options.bin / tool).exists():
            parser.error(f"{options.bin} has no {tool}; build it, and name its folder with --bin")
    return options, *chosen_settings(options, parser)


def main(arguments=None) -> int:
    options, settings, note = parse(arguments)
    installed = install_all(options.peers) if options.peers else None
    measured = []
    seconds = dict.fromkeys(PARTS, 0.0)
    with tempfile.TemporaryDirectory(dir=options.folder) as shared:
        for place, setting in enumerate(settings, 1):
            print(f"{place}/{len(settings)} {setting.name}", file=sys.stderr, flush=True)
            measured.append((setting, *measure_setting(options, setting, installed, Path(shared), seconds)))
    text = (
        "Every method measures the same frames; EMVA 1288 and its programs measure flats of the same simulated camera. "
        f"± is one standard error. Times are processor times. {note}"
    )
    for ending, make in ((".md", as_markdown), (".html", as_html)):
        Path(options.output + ending).write_text(make(TITLE, text.strip(), tables_of(measured)), encoding="utf-8")
    print(f"{options.output}.md, {options.output}.html")
    if note:
        print(note)
    print(text_of_times(seconds))
    return 0


if __name__ == "__main__":
    sys.exit(main())
