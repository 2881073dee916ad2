# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""ITK filters at work: their progress, for a person, and a person's Ctrl-C."""

import sys
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from typing import Protocol

from . import _options
from ._types import ItkObject, Progress


class Bar(Protocol):
    """A progress bar. `n` of 100 % are done."""

    n: int

    def update(self, percent: int) -> object: ...

    def close(self) -> None: ...


class _PlainBar:
    """Shows the progress in one line on standard error, without tqdm."""

    def __init__(self) -> None:
        self.n = 0

    def update(self, percent: int) -> None:
        self.n += percent
        sys.stderr.write(f"\restimate_sensor_noise: {self.n:3d} %")
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\n")


class _Called:
    """Calls a function with the fraction of the work that is done, once for each per cent."""

    def __init__(self, function: Callable[[float], object]) -> None:
        self.n = 0
        self._function = function

    def update(self, percent: int) -> None:
        if percent > 0:
            self.n += percent
            self._function(self.n / 100)

    def close(self) -> None:
        """Closes nothing: a function needs no end."""


def bar_of(progress: Progress) -> Bar | None:
    """Returns the requested bar; None without a bar. Raises TypeError if `progress` is neither a bool nor a
    function."""
    if callable(progress):
        return _Called(progress)
    expected = "True, False or a function of the fraction that is done"
    return make_bar() if _options.true_or_false("progress", progress, expected) else None


def make_bar() -> Bar:
    """Returns a bar of tqdm if tqdm is installed, else a line on standard error."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _PlainBar()
    bar: Bar = tqdm(total=100, unit="%", desc="estimate_sensor_noise")
    return bar


class _Reads(Protocol):
    """A stack with the exceptions that were raised while its frames were read."""

    failed: list[BaseException]


def _watch(
    instance: ItkObject, bar: Bar | None, caught: list[BaseException], stacks: tuple[_Reads, ...]
) -> Generator[None, None, None]:
    """Handles pending signals and advances the bar at each turn. ITK requests turns during its work.

    ITK would replace an exception by the text of its own exception. The exception is therefore appended to `caught`,
    and `instance` is stopped. A generator waits inside its `try`; a function could be interrupted before its `try`.
    """
    while True:
        try:
            yield
            if any(stack.failed for stack in stacks):
                instance.AbortGenerateDataOn()
            if bar is not None and not caught:
                bar.update(max(int(100 * instance.GetProgress()) - int(bar.n), 0))
        except GeneratorExit:
            return
        except BaseException as error:  # noqa: BLE001 - of signals and bars; at_work() raises it again
            caught.append(error)
            instance.AbortGenerateDataOn()


@contextmanager
def at_work(instance: ItkObject, progress: Progress = False, *stacks: _Reads) -> Iterator[None]:
    """Lets Ctrl-C stop the update of `instance`, a filter that reads a stack, within the time of a chunk, and raises
    KeyboardInterrupt. `progress` shows a bar, by tqdm if it is installed, or calls a function. An exception of the
    reader of `stacks` also stops the update, and is raised again: nothing was measured.
    """
    import itk

    bar = bar_of(progress)
    caught: list[BaseException] = []
    watch = _watch(instance, bar, caught, stacks)
    next(watch)
    tag = instance.AddObserver(itk.ProgressEvent(), watch.__next__)
    try:
        yield
        if bar is not None and not caught:
            bar.update(100 - int(bar.n))
    except (RuntimeError, ValueError):  # ITK's "aborted", if _watch() stopped the filter
        if not caught and not any(stack.failed for stack in stacks):
            raise
    finally:
        # The observer holds the filter that holds it.
        instance.RemoveObserver(tag)
        watch.close()
        if bar is not None:
            bar.close()
    for error in [*caught, *(error for stack in stacks for error in stack.failed)]:
        raise error
