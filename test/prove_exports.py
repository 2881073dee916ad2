#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Proves the exports of a noise model by the programs' own code, by hand.

    prove_exports.py --bin build/bin [--torch-free FOLDER]

Simulates a burst, measures it, exports the report, and lets each program read its export. The variance by the program
is compared with the report's at several levels. Programs that are not installed are left out. Packages:
anscombe-transform, ccdproc, emva1288, ndsafir (pre-release), PiDNG, tifffile. A program: darktable-cli.

CAREamics and deepinv need PyTorch. --torch-free FOLDER names their unpacked wheels: the files of their noise models
then run on NumPy, with the same arithmetic. Functions of picassosr and python-microscopy are run from the same folder;
they need PyYAML. Programs that the folder lacks are left out. python-microscopy has wheels for Windows and macOS alone,
whose Python files are run: pip download --platform win_amd64.
"""

import argparse
import ast
import functools
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import types
from unittest import mock

import numpy as np

BLACK, WHITE = 90.0, 4095.0
LEVELS = np.array([150.0, 500.0, 1500.0, 4000.0])


class Bench:
    """A folder with a report, and the exports of it."""

    def __init__(self, tools: pathlib.Path, folder: pathlib.Path) -> None:
        self.tools, self.folder = tools, folder
        self.run("simulate-sensor-noise", "--output", "burst.mha", "--frames", "60", "--seed", "1")
        self.run("estimate-sensor-noise", "burst.mha", "--json", "report.json", "--quiet")
        report = json.loads((folder / "report.json").read_text())
        names = ("variance_slope", "total_intercept", "gain", "offset", "read_noise")
        self.slope, self.intercept, self.gain, self.offset, self.noise = (report[name]["value"] for name in names)

    def run(self, tool: str, *arguments: str) -> None:
        subprocess.run([self.tools / tool, *arguments], cwd=self.folder, check=True, stderr=subprocess.DEVNULL)

    def export(self, name: str, *options: str) -> pathlib.Path:
        levels = ("--black", str(BLACK), "--white", str(WHITE))
        self.run("export-noise-model", "report.json", "--format", name, "--output", f"{name}.out", *levels, *options)
        return self.folder / f"{name}.out"

    def line(self) -> np.ndarray:
        return self.slope * LEVELS + self.intercept

    def sensor(self) -> np.ndarray:
        return self.gain * (LEVELS - self.offset) + self.noise**2


def worst(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.max(np.abs(np.asarray(found) / expected - 1)))


def dng(bench: Bench) -> tuple[str, float]:
    """PiDNG writes a DNG, the program writes the tag into its copy, and tifffile reads it."""
    import tifffile
    from pidng.core import RAW2DNG, DNGTags, Tag

    tags = DNGTags()
    for tag, value in (
        (Tag.ImageWidth, 64),
        (Tag.ImageLength, 48),
        (Tag.BitsPerSample, 16),
        (Tag.BlackLevel, int(BLACK)),
        (Tag.WhiteLevel, int(WHITE)),
        (Tag.PhotometricInterpretation, 34892),
        (Tag.SamplesPerPixel, 1),
        (Tag.DNGVersion, [1, 4, 0, 0]),
        (Tag.DNGBackwardVersion, [1, 2, 0, 0]),
    ):
        tags.set(tag, value)
    pixels = np.arange(64 * 48, dtype=np.uint16).reshape(48, 64)
    writer = RAW2DNG()
    writer.options(tags, path=f"{bench.folder}/", compress=False)
    writer.convert(pixels, filename="photo")
    copy = bench.export("dng", "--into", "photo.dng")
    with tifffile.TiffFile(copy) as file, tifffile.TiffFile(bench.folder / "photo.dng") as before:
        page = file.pages[0]
        scale, offset = page.tags[51041].value
        others = {tag.code: tag.value for tag in page.tags if tag.code != 51041}
        assert others == {tag.code: tag.value for tag in before.pages[0].tags}
        assert np.array_equal(page.asarray(), pixels)
    return "PiDNG, tifffile", worst(
        (scale * (LEVELS - BLACK) / (WHITE - BLACK) + offset) * (WHITE - BLACK) ** 2, bench.line()
    )


def dng_below_preview(bench: Bench) -> tuple[str, float]:
    """tifffile writes a preview with the main image in its SubIFDs, and reads the tag of both."""
    import tifffile

    pixels = np.arange(64 * 48, dtype=np.uint16).reshape(48, 64)
    with tifffile.TiffWriter(bench.folder / "preview.dng") as writer:
        version = [(50706, "B", 4, (1, 4, 0, 0), True)]
        levels = [(50714, "I", 1, int(BLACK), True), (50717, "I", 1, int(WHITE), True)]
        preview = np.zeros((8, 8, 3), np.uint8)
        writer.write(preview, photometric="rgb", subifds=2, subfiletype=1, extratags=version)
        writer.write(np.zeros((16, 16, 3), np.uint8), photometric="rgb", subfiletype=1)
        writer.write(pixels, photometric="minisblack", subfiletype=0, extratags=levels)
    with tifffile.TiffFile(bench.export("dng", "--into", "preview.dng")) as file:
        first = file.pages[0]
        other, raw = first.pages
        assert 51041 not in other.tags and np.array_equal(raw.asarray(), pixels)
        assert first.tags[51041].value == raw.tags[51041].value
        scale, offset = raw.tags[51041].value
    return "tifffile", worst((scale * (LEVELS - BLACK) / (WHITE - BLACK) + offset) * (WHITE - BLACK) ** 2, bench.line())


def anscombe_transform(bench: Bench) -> tuple[str, float]:
    """Reads the variance gain (x - zero_level) + 3/8 gain^2 from the lookup, whose slope is 1 over the standard
    deviation."""
    from anscombe_transform.codec import make_anscombe_lookup

    model = json.loads(bench.export("anscombe-transform").read_text())
    beta = 1e-7  # steps so small that rounding does not matter
    lookup = make_anscombe_lookup(**model, input_max=5000, beta=beta, output_type="float64")
    at = LEVELS.astype(int)
    deviation = 2 / (beta * (lookup[at + 1] - lookup[at - 1]))
    return "make_anscombe_lookup", worst(deviation**2 - 3 / 8 * model["conversion_gain"] ** 2, bench.line())


def ndsafir(bench: Bench) -> tuple[str, float]:
    """Finds the variance that the denoiser of Poisson-Gaussian noise of ndsafir takes for the numbers, in single
    precision.

    This denoiser is the denoiser of Gaussian noise between the Anscombe transform of the variance and the inverse. The
    line of the variance is fitted so that both results are the same. The fit begins at a gain that is 5 % too large.
    """
    import ndsafir as package

    model = json.loads(bench.export("ndsafir").read_text())
    gain, offset = model["gains"][0], model["offsets"][0]
    low = 150.0  # level whose variance is fitted [DN]
    frame = noisy_frame(gain, offset, np.linspace(low, 4000, 64)[None, :].repeat(64, 0))
    denoised = package.denoise_poisson_gaussian(frame, gains=[gain], offsets=[offset], max_iter=3, nthreads=1).astype(
        float
    )

    def line_of(parameters: np.ndarray) -> tuple[float, float]:
        a = gain * np.exp(parameters[0])
        return a, (gain * low + offset) * np.exp(parameters[1]) - a * low

    def between_transforms(parameters: np.ndarray) -> np.ndarray:
        a, b = line_of(parameters)
        stable = 2 / a * np.sqrt(a * frame.astype(float) + 3 / 8 * a**2 + b)
        smooth = package.denoise_gaussian(stable.astype(np.float32), noise_std=1.0, max_iter=3, nthreads=1).astype(
            float
        )
        return ((a * smooth / 2) ** 2 - b) / a - 3 / 8 * a + 1 / 4  # as ndsafir, which adds 1/4 DN

    weights = 1 / np.sqrt(gain * frame.astype(float) + offset)
    parameters = np.log([1.05, 0.95])
    for _ in range(12):  # Gauss-Newton
        steps = [
            between_transforms(parameters + step) - between_transforms(parameters - step) for step in 1e-3 * np.eye(2)
        ]
        slopes = np.stack([(weights * step).ravel() / 2e-3 for step in steps], axis=1)
        rest = (weights * (denoised - between_transforms(parameters))).ravel()
        parameters = parameters + np.linalg.lstsq(slopes, rest, rcond=None)[0]
    a, b = line_of(parameters)
    return "denoise_poisson_gaussian", worst(a * LEVELS + b, bench.line())


def ndsafir_calibration(bench: Bench) -> tuple[str, float]:
    """Calibrates a frame by ndsafir, which finds variances that are 8 % too large.

    It squares 1.4826 times the median absolute deviation of the residuals in windows of 7 x 6 pixels. The mean of this
    square is above the variance: the median of few pixels scatters, and neighbouring residuals are correlated.
    """
    import ndsafir as package

    model = json.loads(bench.export("ndsafir").read_text())
    levels = np.linspace(120, 3500, 1024)[None, :].repeat(1024, 0)
    gain, offset = np.ravel(
        package.calibrate_poisson_gaussian(noisy_frame(model["gains"][0], model["offsets"][0], levels))
    )
    return "calibrate_poisson_gaussian (estimated)", worst(gain * LEVELS + offset, bench.line())


def noisy_frame(gain: float, offset: float, levels: np.ndarray) -> np.ndarray:
    """Returns a frame of these levels, with Gaussian noise of the variance gain * level + offset."""
    random = np.random.default_rng(1)
    noise = random.standard_normal(levels.shape) * np.sqrt(gain * levels + offset)
    return (levels + noise).astype(np.float32)


def ccdproc(bench: Bench) -> tuple[str, float]:
    """Runs create_deviation() on frames without the offset."""
    import astropy.units as u
    import ccdproc as package
    from astropy.nddata import CCDData

    model = {
        name: each["value"] * u.Unit(each["unit"])
        for name, each in json.loads(bench.export("ccdproc").read_text()).items()
    }
    frame = CCDData(LEVELS - model["offset"].value, unit="adu")
    made = package.create_deviation(frame, gain=model["gain"], readnoise=model["readnoise"])
    return "create_deviation", worst(made.uncertainty.array**2, bench.sensor())


def fits(bench: Bench) -> tuple[str, float]:
    """astropy reads the cards."""
    from astropy.io import fits as package

    header = package.Header.fromstring(bench.export("fits").read_text(), sep="\n")
    electrons = (LEVELS - bench.offset) * header["EGAIN"]
    return "astropy.io.fits.Header", worst((electrons + header["RDNOISE"] ** 2) / header["EGAIN"] ** 2, bench.sensor())


def emva1288(bench: Bench) -> tuple[str, float]:
    """Reads the results by the package emva1288."""
    from emva1288.process.routines import xml_to_dict

    section = xml_to_dict(str(bench.export("emva1288")))["sensitivity"]
    gain, inverse, noise = (float(section[name.lower()]["value"]) for name in ("K", "inverse_K", "sigma_d"))
    assert abs(gain * inverse - 1) < 1e-12
    return "xml_to_dict", worst(gain * (LEVELS - bench.offset) + (gain * noise) ** 2, bench.sensor())


def darktable(bench: Bench) -> tuple[str, float]:
    """darktable exports flat mosaics of the camera; the preset has their variance, as its tool measures it.

    The preset's factor was calibrated to 1.5 %, so that the difference is of this size.
    """
    if shutil.which("darktable-cli") is None:
        raise ImportError(name="darktable-cli")
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "examples" / "python"))
    import calibrate_darktable as calibration

    gain, noise, electrons, side = 2.0, 20.0, 6000, 768  # [DN/e-], [DN], [e-], [pixels]
    black, white = calibration.BLACK, calibration.WHITE
    folder = bench.folder / "camera" / "iso100"
    (folder / "dark").mkdir(parents=True)
    camera = ("--gain", gain, "--read-noise", noise, "--offset", black, "--bit-depth", 14, "--bayer", "RGGB")
    camera = (*map(str, camera), "--frames", "60", "--size", "256x192")
    bench.run("simulate-sensor-noise", *camera, "--electrons", str(electrons), "--output", str(folder / "burst.mha"))
    bench.run("simulate-sensor-noise", *camera, "--dark", "--seed", "2", "--output", str(folder / "dark" / "dark.mha"))
    bench.run("estimate-sensor-noise", "--sweep", "camera", "--bayer", "RGGB", "--json", "passport.json", "--quiet")
    levels = ("--black", str(black), "--white", str(white))
    bench.run("export-noise-model", "passport.json", "--format", "darktable", "--output", "presets.json", *levels)
    presets = json.loads((bench.folder / "presets.json").read_text())
    preset = presets["noiseprofiles"][0]["models"][0]["profiles"][0]
    random = np.random.default_rng(1)
    scale, offset, green = gain / (white - black), (noise / (white - black)) ** 2, 1
    found = []
    for level in calibration.LEVELS:
        grey_values, variances = calibration.simulate(
            random, side, calibration.ILLUMINANTS["grey"], level, scale, offset
        )
        image = calibration.export("darktable-cli", bench.folder, grey_values, "rcd")
        found.append((calibration.factors(image, grey_values, variances) * variances)[green])
    expected = preset["a"][green] * np.array(calibration.LEVELS) + preset["b"][green]
    return "darktable-cli (calibrated)", worst(np.array(found), expected)


class Module:
    """Stands for torch.nn.Module, with the members that the noise models use."""

    def register_buffer(self, name: str, value: object) -> None:
        setattr(self, name, value)

    register_parameter = register_buffer


class Tensor(np.ndarray):
    """Stands for a tensor, with the members that the noise models use."""

    device = None

    def dim(self) -> int:
        return self.ndim

    def to(self, _: object) -> "Tensor":
        return self


def tensor_of(values: object) -> Tensor:
    return np.asarray(values, dtype=float).view(Tensor)


class Noise:
    """The variance of random numbers, instead of the numbers: of Poisson's their mean, of Gauss' 1."""

    def __init__(self, variance: np.ndarray | float) -> None:
        self.variance = variance

    def __mul__(self, factor: np.ndarray) -> "Noise":
        return Noise(self.variance * np.asarray(factor) ** 2)

    def __add__(self, other: "Noise") -> "Noise":
        return Noise(self.variance + other.variance)


def run_on_numpy(file: pathlib.Path) -> dict[str, object]:
    """Runs a file of a package with NumPy under the names of PyTorch; other names are mocks."""
    torch, nn = mock.MagicMock(), types.ModuleType("torch.nn")
    nn.Module, nn.Parameter = Module, lambda value: value
    torch.nn, torch.exp, torch.sqrt, torch.any = nn, np.exp, np.sqrt, np.any
    torch.tensor, torch.zeros_like = tensor_of, np.zeros_like
    torch.clamp = torch.clip = lambda values, min: np.maximum(values, min)
    torch.poisson = lambda rate, generator: Noise(np.asarray(rate))
    others = ("careamics", "careamics.config", "careamics.utils", "deepinv")
    modules = {"torch": torch, "torch.nn": nn, **{name: mock.MagicMock() for name in others}}
    names: dict[str, object] = {"__name__": file.stem}
    with mock.patch.dict(sys.modules, modules):
        exec(compile(file.read_text(), file.name, "exec"), names)
    return names


def careamics(bench: Bench, folder: pathlib.Path) -> tuple[str, float]:
    """Runs CAREamics' file of the model on NumPy."""
    names = run_on_numpy(folder / "careamics/models/lvae/noise_models.py")
    config = types.SimpleNamespace(path=bench.export("careamics"))
    _, deviation, weight = names["GaussianMixtureNoiseModel"](config).get_gaussian_parameters(tensor_of(LEVELS))
    assert np.allclose(weight, 1)
    return "GaussianMixtureNoiseModel, on NumPy", worst(deviation**2, bench.line())


def deepinv(bench: Bench, folder: pathlib.Path) -> tuple[str, float]:
    """Runs deepinv's file of the noise on NumPy, with the variance of the random numbers."""
    model = json.loads(bench.export("deepinv").read_text())
    physics = mock.MagicMock(
        gain=np.asarray(model["gain"]), sigma=np.asarray(model["sigma"]), clip_positive=False, min_gain=1e-12
    )
    physics.randn_like = lambda _: Noise(1.0)
    images = tensor_of((LEVELS - model["black_level"]) / (model["white_level"] - model["black_level"]))
    names = run_on_numpy(folder / "deepinv/physics/noise.py")
    noisy = names["PoissonGaussianNoise"].forward(physics, images)
    return "PoissonGaussianNoise, on NumPy", worst(noisy.variance * (WHITE - BLACK) ** 2, bench.line())


def functions_of(file: pathlib.Path, names: tuple[str, ...], globals_: dict[str, object]) -> dict[str, object]:
    """Runs functions of a file by themselves, without their decorators and annotations."""
    future = ast.parse("from __future__ import annotations").body
    found = [node for node in ast.walk(ast.parse(file.read_text())) if isinstance(node, ast.FunctionDef)]
    found = [node for node in found if node.name in names]
    for node in found:
        node.decorator_list = []
    exec(compile(ast.Module([*future, *found], []), file.name, "exec"), globals_)
    return globals_


def picasso(bench: Bench, folder: pathlib.Path) -> tuple[str, float]:
    """Runs picasso's conversion to photons. The variance of photons is their number; the record has no read noise."""
    import yaml

    (camera,) = yaml.safe_load(bench.export("picasso").read_text())["Cameras"].values()
    names = functions_of(folder / "picasso/localize.py", ("_sensitivity", "_to_photons"), {"np": np})
    photons = names["_to_photons"](LEVELS, {"Gain": 1, **camera})
    return "_to_photons", worst(photons / camera["Sensitivity"] ** 2 + bench.noise**2, bench.sensor())


def pyme(bench: Bench, folder: pathlib.Path) -> tuple[str, float]:
    """Runs PYME's standard deviation of a pixel, whose variance has one electron more than the sensor's."""
    import yaml

    (camera,) = yaml.safe_load(bench.export("pyme").read_text()).values()
    (mode,) = camera["noise_properties"].values()
    metadata = {f"Camera.{name}": value for name, value in {**mode, "NoiseFactor": 1, "TrueEMGain": 1}.items()}
    (file,) = folder.glob("**/PYME/localization/remFitBuf.py")
    maps = types.SimpleNamespace(getVarianceMap=lambda given: given["Camera.ReadNoise"] ** 2)
    names = functions_of(file, ("calcSigma",), {"np": np, "cameraMaps": maps})
    deviation = np.ravel(names["calcSigma"](None, metadata, LEVELS - mode["ADOffset"]))
    return "calcSigma", worst(deviation**2 - 1 / mode["ElectronsPerCount"] ** 2, bench.sensor())


PROOFS = {
    "dng": dng,
    "dng below preview": dng_below_preview,
    "ndsafir": ndsafir,
    "ndsafir calibration": ndsafir_calibration,
    "anscombe-transform": anscombe_transform,
    "fits": fits,
    "ccdproc": ccdproc,
    "emva1288": emva1288,
    "darktable": darktable,
}

# The file of the package that is run.
UNPACKED = {
    "careamics": ("careamics/models/lvae/noise_models.py", careamics),
    "deepinv": ("deepinv/physics/noise.py", deepinv),
    "picasso": ("picasso/localize.py", picasso),
    "pyme": ("PYME/localization/remFitBuf.py", pyme),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the built programs")
    parser.add_argument("--torch-free", type=pathlib.Path, help="folder of unpacked packages")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options.bin.resolve(), pathlib.Path(folder))
        proofs = dict(PROOFS)
        for name, (file, prove) in UNPACKED.items():
            if options.torch_free and any(options.torch_free.glob(f"**/{file}")):
                proofs[name] = functools.partial(prove, folder=options.torch_free)
        print(f"{'format':20}{'by':40}largest relative difference of the variance")
        for name, prove in proofs.items():
            try:
                by, difference = prove(bench)
                print(f"{name:20}{by:40}{difference:.1e}")
            except ImportError as error:
                print(f"{name:20}{'-':40}not installed: {error.name}, so that this format is not proved")


if __name__ == "__main__":
    main()
