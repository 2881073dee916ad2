# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Checks the stored chunks of lazy frames (zarr, dask, h5py): none may be missing.

Those packages give fill values, mostly zeros, for what was never written: half of a recording looks whole."""

import math
import os
from collections.abc import Iterator
from typing import Any


def frames_of_chunk(frames: Any) -> int:
    """Returns the number of frames that are stored together; 1 if it is not known."""
    chunks: Any = getattr(frames, "chunks", None)
    try:
        along_time = chunks[0]
        longest = max(along_time) if isinstance(along_time, (tuple, list)) else along_time
        return max(1, int(longest))
    except (TypeError, ValueError, IndexError, KeyError):
        return 1


def arrays_of_graph(frames: Any) -> list[Any]:
    """Returns the arrays of a graph of dask that only slices them. The list is empty for a graph that computes, and for
    other objects."""
    graph = getattr(frames, "dask", None)
    if len(getattr(graph, "layers", {}).values()) not in (1, 2):
        return []
    return list(_of_graph(graph))


def is_closed(frames: Any) -> bool:
    """Returns whether it is a dataset of h5py's whose file was closed: it has not even a shape."""
    return type(frames).__module__.startswith("h5py.") and not frames


def require_chunks(frames: Any, name: str) -> None:
    """Raises ValueError if stored chunks are missing, as far as the store shows it.

    They are found for zarr (versions 2 and 3) on stores of zarr's own that list what they hold, for h5py, and for both
    inside of dask and xarray. Chunks that are missing in a shard, or in other stores, are not found."""
    for stored in _stored(frames):
        module = type(stored).__module__
        if module.startswith("zarr.") and hasattr(stored, "nchunks_initialized"):
            _require_of_zarr(stored, name)
        elif module.startswith("h5py.") and hasattr(stored, "id"):
            _require_of_h5py(stored, name)


def _refuse(name: str, kind: str, missing: int, total: int, advice: str = "") -> ValueError:
    return ValueError(
        f"{name}: {missing} of the {total} chunks of the {kind} were never written, and would be read as fill values; "
        f"expected all{advice}"
    )


def _require_of_zarr(array: Any, name: str) -> None:
    store = array.store
    if not type(store).__module__.startswith("zarr.") or getattr(store, "supports_listing", True) is False:
        return
    total, written = int(array.nchunks), int(array.nchunks_initialized)
    if written < total:
        advice = ". Chunks of nothing but the fill value are left out, too, unless written with write_empty_chunks=True"
        raise _refuse(name, "Zarr array", total - written, total, advice)


def _require_of_h5py(dataset: Any, name: str) -> None:
    if dataset.is_virtual:
        folder = os.path.dirname(dataset.file.filename)
        for source in dataset.virtual_sources():
            if source.file_name != "." and not os.path.exists(os.path.join(folder, source.file_name)):
                raise ValueError(f"{name}: {source.file_name}, a part of the virtual dataset, is missing")
    elif dataset.chunks is not None:
        total = math.prod(-(-size // chunk) for size, chunk in zip(dataset.shape, dataset.chunks, strict=True))
        written = int(dataset.id.get_num_chunks())
        if written < total:
            raise _refuse(name, "HDF5 dataset", total - written, total)
    elif dataset.external is None and dataset.id.get_space_status() == _not_allocated():
        raise ValueError(f"{name}: the HDF5 dataset was never written, and would be read as fill values")


def _not_allocated() -> int:
    import h5py

    return int(h5py.h5d.SPACE_STATUS_NOT_ALLOCATED)


def _stored(frames: Any) -> Iterator[Any]:
    """Yields the objects that the frames are read from, through the wrappers of xarray and the graphs of dask."""
    for _ in range(12):  # no wrapper is in more
        yield frames
        graph = getattr(frames, "dask", None)
        if graph is not None:
            yield from _of_graph(graph)
            return
        inside = [getattr(frames, name, None) for name in ("variable", "_data", "array", "_array")]
        frames = next((inner for inner in inside if hasattr(inner, "shape")), None)
        if frames is None:
            return


def _of_graph(graph: Any) -> Iterator[Any]:
    """Yields the arrays of a graph of dask: each is a layer of the graph, or a value among the tasks of a layer."""
    for layer in getattr(graph, "layers", {}).values():
        if type(layer).__name__ == "MaterializedLayer":
            for task in layer.values():
                task = getattr(task, "value", task)  # noqa: PLW2901 - a node that holds it
                if hasattr(task, "shape") and hasattr(task, "dtype"):
                    yield from _stored(task)
