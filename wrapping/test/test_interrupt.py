# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests Ctrl-C during the measurement of a stack."""

import sys

import pytest

CODE = """
import gc, os, signal, subprocess, sys, time
import itk, numpy as np

signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job ignores it
progress, estimate = sys.argv[1] == "bar", sys.argv[2]
if progress:
    import itk_sensornoise._progress
    bar = itk_sensornoise._progress._PlainBar()
    bar.update = lambda percent: None
    bar.close = lambda: None
    itk_sensornoise._progress.make_bar = lambda: bar


def megabytes():
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


small = itk.simulate_sensor_noise(frames=20, size=(64, 64), flicker_sd=0.1)[0]
expected = itk.estimate_sensor_noise(small).to_json()
itk.estimate_sensor_noise(list(small), dark=small)  # ITK loads its modules at their first use
random = np.random.default_rng(1)
level = np.linspace(200, 3000, 1024, dtype=np.float32)
noise = np.sqrt(level) * random.standard_normal((8, 1024, 1024), np.float32)
stack = np.stack([(level * (1 + 0.02 * np.sin(t)) + np.roll(noise[t % 8], t, 0)).astype(np.uint16) for t in range(240)])
del noise
dark = np.concatenate([stack] * 2) if estimate == "dark" else None
run = {
    "function": lambda: itk.estimate_sensor_noise(stack, progress=progress),
    "list": lambda: itk.estimate_sensor_noise(list(stack), progress=progress),
    "estimator": lambda: itk.sensor_noise_estimator(stack),
    "dark": lambda: itk.estimate_sensor_noise(stack[:20], dark=dark, progress=progress),
}[estimate]
before = megabytes()
kill = subprocess.Popen(["sh", "-c", f"sleep 0.3; kill -INT {os.getpid()}; date +%s.%N"], stdout=subprocess.PIPE)
try:
    run()
    print("not interrupted")
except KeyboardInterrupt:
    late = time.time() - float(kill.communicate()[0])
    print("interrupted" if late < 1.5 else f"interrupted {late:.1f} s late")
more = megabytes() - before
print("memory given back" if more < 60 else f"{more:.0f} MB more")
print("right" if itk.estimate_sensor_noise(small, progress=progress).to_json() == expected else "wrong")
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the memory in use is read as Linux tells it")
@pytest.mark.parametrize(
    "progress, estimate", [("quiet", "function"), ("bar", "list"), ("bar", "dark"), ("quiet", "estimator")]
)
def test_keyboard_interrupt_comes_at_once_and_leaves_nothing(fresh, progress, estimate):
    assert fresh(CODE, progress, estimate).split("\n")[:3] == ["interrupted", "memory given back", "right"]


def test_error_of_an_observer_is_raised_as_it_is(burst, monkeypatch):
    import itk
    import itk_sensornoise._progress as progress

    class Broken:
        n = 0

        def update(self, percent):
            raise ZeroDivisionError("the bar is broken")

        def close(self):
            pass

    monkeypatch.setattr(progress, "make_bar", Broken)
    with pytest.raises(ZeroDivisionError, match="the bar is broken"):
        itk.estimate_sensor_noise(burst, progress=True)


def test_maps_are_not_written_over_what_is_read(burst, tmp_path):
    import itk

    name = tmp_path / "mean.mha"
    itk.imwrite(itk.image_view_from_array(burst), str(name))
    before = name.read_bytes()
    with pytest.raises(ValueError, match=r"mean\.mha is the same file as .*mean\.mha of frames"):
        itk.estimate_sensor_noise(str(name), maps=tmp_path)
    link = tmp_path / "link.mha"
    link.symlink_to(name)
    with pytest.raises(ValueError, match="same file"):
        itk.estimate_sensor_noise(link, maps=tmp_path)
    assert name.read_bytes() == before
