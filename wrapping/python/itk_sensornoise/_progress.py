# ==========================================================================
#
#   Copyright the ITKSensorNoise contributors
#
#   Licensed under the Apache License, Version 2.0 (the "License");
#   you may not use this file except in compliance with the License.
#   You may obtain a copy of the License at
#
#          https://www.apache.org/licenses/LICENSE-2.0.txt
#
#   Unless required by applicable law or agreed to in writing, software
#   distributed under the License is distributed on an "AS IS" BASIS,
#   WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
#   See the License for the specific language governing permissions and
#   limitations under the License.
#
# ==========================================================================*/
"""Progress of an ITK filter, for a person."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class _PlainBar:
    """One line on standard error, where there is no tqdm."""

    def __init__(self) -> None:
        self.n = 0

    def update(self, percent: int) -> None:
        self.n += percent
        sys.stderr.write(f"\restimate_sensor_noise: {self.n:3d} %")
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\n")


def _make_bar() -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _PlainBar()
    return tqdm(total=100, unit="%", desc="estimate_sensor_noise")


@contextmanager
def shown_progress(instance: Any, wanted: bool) -> Iterator[None]:
    """Shows the progress of `instance`, a process object, while the context lasts: with tqdm if that is installed."""
    if not wanted:
        yield
        return
    import itk

    bar = _make_bar()

    def show() -> None:
        bar.update(max(int(100 * instance.GetProgress()) - int(bar.n), 0))

    tag = instance.AddObserver(itk.ProgressEvent(), show)
    try:
        yield
        bar.update(100 - int(bar.n))
    finally:
        # The observer holds the filter that holds it.
        instance.RemoveObserver(tag)
        bar.close()
