/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef FileCompleteness_h
#define FileCompleteness_h

#include "itkImageIOBase.h"

namespace sensornoise::tools
{

/** Throws InputError unless the file that `io` has described (after ReadImageInformation()) holds all of its pixels.
 *
 * ITK's readers do not see to that: a MetaImage that was cut off is filled up with zeros, a multi-page TIFF loses its
 * last pages, and neither is an error. What is looked at, without reading a pixel:
 *
 * - MetaImage: bytes after the header or in each data file; CompressedDataSize if the pixels are compressed;
 * - NRRD with raw encoding: bytes after the header or in the data file (the reader itself notices the end of the
 *   other encodings, and of several data files);
 * - TIFF: the chain of directories up to its end, the place and number of bytes of each strip, and whether all
 *   pages have the same layout, one that ITK reads without conversion;
 * - PNG: the chain of chunks up to IEND (needs no ReadImageInformation());
 * - any other format: the file has at least as many bytes as its pixels. That refuses files that are compressed,
 *   too, because nothing tells the two apart; HDF5 and MINC are left to their libraries, which know. */
void
CheckFileIsComplete(itk::ImageIOBase & io);

} // namespace sensornoise::tools

#endif
