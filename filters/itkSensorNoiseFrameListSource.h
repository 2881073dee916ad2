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
#ifndef itkSensorNoiseFrameListSource_h
#define itkSensorNoiseFrameListSource_h

#include "SensorNoiseExport.h"
#include "itkSensorNoiseFrameFiles.h"
#include "itkImage.h"
#include "itkImageIOBase.h"
#include "itkImageSource.h"
#include "sensornoise/FrameGeometry.h"

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class SensorNoiseFrameListSource
 * \brief Reads frames from files as a stack, an image whose last axis is time.
 *
 * The files are one or several stacks, or a list of single frames. Every file is checked before a pixel is read
 * (sensornoise::OpenFrames()): it must be complete, have one grey value for each pixel, and have the size and type of
 * the other files. ITK's own readers fill up or guess the content of a damaged file, or end the process. This source
 * throws an error instead: one sentence that begins with the name of the file. No value is converted: the pixel type is
 * the component type of the files. A program that does not know this type calls ReadComponentType() first.
 *
 * All formats stream: only the requested frames are held in memory. A frame is always read completely, even if only a
 * part is requested. Several threads read at once, except from a compressed MetaImage or NRRD stack: it is one stream,
 * which is decompressed from its beginning when an earlier frame is requested.
 *
 * A file that has changed since the check, in its size, time or place on the disk, is also an error. The error is
 * thrown when the file is read. After an error the next Update() checks the files again and uses their new state.
 *
 * The region starts at index 0. Spacing, origin and direction are taken from the file of the stack. For a list of
 * frames, the first file gives them for x and y, and time has spacing 1 and origin 0. The output's MetaDataDictionary
 * has the camera settings of the file, or of the first file of a list (itkSensorNoiseMetaData.h).
 *
 * ImageSeriesReader does not replace this source. It stacks images of height 1 along y instead of time. It converts a
 * file whose component type has changed, and accepts a file that has been truncated since the check.
 *
 * \tparam TOutputStack itk::Image of 3 dimensions, x, y and time, of unsigned char, unsigned short, short, float or
 * double.
 * \ingroup SensorNoise
 */
template <typename TOutputStack>
class ITK_TEMPLATE_EXPORT SensorNoiseFrameListSource : public ImageSource<TOutputStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseFrameListSource);

  using Self = SensorNoiseFrameListSource;
  using Superclass = ImageSource<TOutputStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using OutputStackType = TOutputStack;
  using OutputPixelType = typename OutputStackType::PixelType;
  using OutputRegionType = typename OutputStackType::RegionType;

  static_assert(TOutputStack::ImageDimension == 3, "a stack has two dimensions of space and one of time");

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseFrameListSource";
  }

  /** Names of the files in time order: 2-D images, 3-D images of one slice, or stacks. Required. Update() and
   * UpdateOutputInformation() throw if there is no file or if OpenFrames() rejects a file. */
  void
  SetFileNames(const std::vector<std::string> & names);
  const std::vector<std::string> &
  GetFileNames() const
  {
    return m_FileNames;
  }
  /** Adds one file after the others. */
  void
  AddFileName(const std::string & name);
  /** Sets one file, a stack or a single frame, in place of all others. */
  void
  SetFileName(const std::string & name);

  /** Layout of the frames in files that do not give it themselves. Examples are "640x480:uint16le", and
   * "1920x1080:Mono12p:64" for packed pixels after 64 other bytes; see sensornoise::ReadRawLayout(). Default: empty,
   * the files give their layout. */
  void
  SetRawLayout(const std::string & layout);
  const std::string &
  GetRawLayout() const
  {
    return m_RawLayout;
  }

  /** Sets files that are open already. They are not checked a second time. */
  void
  SetFrameList(const sensornoise::FrameList & list);
  /** Returns the properties of the files, for example their type. Checks the files first if they are not yet checked.
   * The pixel type of this source is not compared with the files. A source of any type can therefore inspect the files
   * and hand the list on to another source by SetFrameList(). */
  const sensornoise::FrameList &
  GetFrameList();

  /** Returns the names of all files that are read, in the order of the frames. The pixel files of a header follow the
   * header. Checks the files first if they are not yet checked. */
  std::vector<std::string>
  GetFilesRead();

  /** Returns the component type of the files: UCHAR, USHORT, SHORT, FLOAT or DOUBLE. Checks the files first if they are
   * not yet checked. */
  IOComponentEnum
  GetComponentType();
  /** Returns the component type of the named files, for a program that has to choose the pixel type of the source.
   * Throws the same errors as Update(). */
  static IOComponentEnum
  ReadComponentType(const std::vector<std::string> & names);

  /** Returns a warning about the files as one sentence, or an empty text, for example if a file is listed twice. A
   * warning is not an error. Checks the files first if they are not yet checked. */
  std::string
  GetWarning();

  /** Returns true: in every format, a part of the frames can be read without the other frames. Checks the files first
   * if they are not yet checked. */
  bool
  CanStream();

protected:
  SensorNoiseFrameListSource() = default;
  ~SensorNoiseFrameListSource() override = default;

  void
  GenerateOutputInformation() override;
  /** Enlarges the requested region to whole frames. */
  void
  EnlargeOutputRequestedRegion(DataObject * output) override;
  void
  GenerateData() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Reads the frames from \a first up to, but not including, \a end in parts of \a partFrames frames, in parallel. If
   * several parts fail, the error of the earliest part is thrown. */
  void
  ReadSideBySide(std::size_t first, std::size_t end, std::size_t partFrames, OutputPixelType * buffer);

  std::vector<std::string> m_FileNames;
  std::string              m_RawLayout;
  sensornoise::FrameList   m_FrameList;
  bool                     m_IsOpen{ false };
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseFrameListSource<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
