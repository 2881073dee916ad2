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
"""Frames from files: their headers, checked, and a reader of ITK that reads a few frames at a time."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ._arrays import PIXEL_NAMES, PIXEL_TYPES
from ._errors import itk_errors


@dataclass(frozen=True)
class Header:
    """What the header of an image file says."""

    name: str
    width: int  # pixels
    height: int  # pixels
    frames: int
    pixel: str  # a key of PIXEL_TYPES

    @property
    def size(self) -> str:
        return f"{self.width} x {self.height} pixels"


def _open(name: str) -> Any:
    """ITK's ImageIO for a file, its header read."""
    import itk

    if os.path.isdir(name):
        raise ValueError(f"{name}: is a folder; expected an image file")
    if not os.path.exists(name):
        raise ValueError(f"{name}: does not exist; expected an image file")
    if os.path.getsize(name) == 0:
        raise ValueError(f"{name}: has 0 bytes; expected an image file")
    with itk_errors(f"{name}: its header cannot be read; "):
        io = itk.ImageIOFactory.CreateImageIO(name, itk.CommonEnums.IOFileMode_ReadMode)
        if io is None:
            raise ValueError(f"{name}: not an image of a format that ITK reads; expected TIFF, PNG, MetaImage or NRRD")
        io.SetFileName(name)
        io.ReadImageInformation()
    return io


def read_header(name: str) -> Header:
    """The header of one file. Reads no pixel.

    ITK's readers would make grey of colour and cut 70000 down to 4464 without a word; the header tells. Raises
    ValueError where the file is no image of 2 or 3 dimensions with one grey value, of a supported type, a pixel.
    """
    io = _open(name)
    dimensions = [io.GetDimensions(axis) for axis in range(io.GetNumberOfDimensions())]
    while len(dimensions) > 3 and dimensions[-1] == 1:
        dimensions.pop()
    if not 2 <= len(dimensions) <= 3 or 0 in dimensions:
        raise ValueError(f"{name}: has size {dimensions}; expected 2 dimensions (a frame) or 3 (a stack)")
    if io.GetNumberOfComponents() != 1:
        raise ValueError(f"{name}: has {io.GetNumberOfComponents()} components a pixel; expected 1 grey value")
    component = io.GetComponentTypeAsString(io.GetComponentType())
    for pixel, (_, header_name) in PIXEL_TYPES.items():
        if component == header_name:
            return Header(name, dimensions[0], dimensions[1], dimensions[2] if len(dimensions) == 3 else 1, pixel)
    raise ValueError(f"{name}: has pixels of type {component.replace('_', ' ')}; expected {PIXEL_NAMES}")


def check_headers(names: Sequence[str]) -> list[Header]:
    """The headers of files in time order, all alike: one stack, or 2-D files of one size and type."""
    headers = [read_header(name) for name in names]
    first = headers[0]
    for header in headers:
        if header.frames > 1 and len(headers) > 1:
            raise ValueError(
                f"{header.name}: holds {header.frames} frames, and {len(headers)} files were given; "
                "expected one stack alone, or one frame a file"
            )
        if header.size != first.size:
            raise ValueError(
                f"{header.name}: has {header.size}, but {first.name} has {first.size}; expected one size for all"
            )
        if header.pixel != first.pixel:
            raise ValueError(
                f"{header.name}: has pixels of type {header.pixel}, but {first.name} has {first.pixel}; "
                "expected one type for all"
            )
    # ITK's series reader would stack lines along y instead of time.
    if min(first.width, first.height) < 3:
        raise ValueError(f"{first.name}: has {first.size}; expected at least 3 x 3")
    return headers


def make_reader(headers: Sequence[Header]) -> Any:
    """ITK's reader of these files, with the stack (x, y, time) as output. Formats that ITK cannot read in parts (NRRD,
    multi-page TIFF) are read whole."""
    import itk

    stack_type = itk.Image[getattr(itk, PIXEL_TYPES[headers[0].pixel][0]), 3]
    if headers[0].frames > 1:
        reader = itk.ImageFileReader[stack_type].New()
        reader.SetFileName(headers[0].name)
        return reader
    reader = itk.ImageSeriesReader[stack_type].New()
    reader.SetFileNames([header.name for header in headers])
    # Else its first chunk would open every file.
    reader.MetaDataDictionaryArrayUpdateOff()
    return reader


def read_frame(header: Header) -> Any:
    """The pixels (y, x) of one 2-D file."""
    import itk

    image_type = itk.Image[getattr(itk, PIXEL_TYPES[header.pixel][0]), 2]
    reader = itk.ImageFileReader[image_type].New()
    reader.SetFileName(header.name)
    reader.Update()
    return itk.array_from_image(reader.GetOutput())
