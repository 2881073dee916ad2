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
#ifndef itkSensorNoiseImageIO_h
#define itkSensorNoiseImageIO_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameFile.h"
#include "itkImageIOBase.h"

#include <ostream>
#include <string>

namespace itk
{

/** \class SensorNoiseImageIO
 * \brief Reads bursts that ITK does not read, or does not read in parts.
 *
 * The formats are SER, Photron's MRAW, stacks in multi-page TIFF files, raw files of cameras (with LibRaw), and, if
 * their layout is given, raw frames without a header.
 *
 * Each file is checked completely before a pixel is read (sensornoise::InspectFrameFile()). A damaged file is therefore
 * an error, reported in one sentence. Digital numbers are returned as the sensor gave them. Packed values of 10 and 12
 * bits are returned as unsigned short. The camera settings of the file are in the MetaDataDictionary
 * (itkSensorNoiseMetaData.h).
 *
 * An image of several frames has three dimensions, and the last dimension is time. A single frame has two dimensions.
 * Frames are read completely, and only the requested frames are read.
 *
 * CanReadFile() accepts only TIFF files with several pages and one grey value for each pixel; other TIFF files are left
 * to ITK. It always accepts raw files of cameras. These include DNG, because ITK's TIFF reader would read the preview.
 * A defect of a raw file, or a build without LibRaw, is then an error. The class writes no files.
 * \ingroup SensorNoise
 */
class SensorNoise_EXPORT SensorNoiseImageIO : public ImageIOBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseImageIO);

  using Self = SensorNoiseImageIO;
  using Superclass = ImageIOBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseImageIO";
  }

  /** Layout of the frames in a file that does not give it itself, for example "640x480:uint16le"; see
   * sensornoise::ReadRawLayout(). Default: empty, the file gives its layout. Text that is not a layout throws when the
   * file is read. */
  void
  SetRawLayout(const std::string & layout);
  const std::string &
  GetRawLayout() const
  {
    return m_RawLayout;
  }

  /** Throws unless a raw file in TIFF format, in most cases a DNG, holds all digital numbers as integers, stored
   * without loss. Some readers do not check this. \a width and \a height are the size of the raw image that LibRaw
   * finds, including the margins [pixels]. */
  static void
  RequireWholeRawTiff(const std::string & name, unsigned int width, unsigned int height);

  bool
  CanReadFile(const char * name) override;
  bool
  CanStreamRead() override
  {
    return true;
  }
  void
  ReadImageInformation() override;
  void
  Read(void * buffer) override;
  /** Returns a region of whole frames. */
  ImageIORegion
  GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const override;

  bool
  CanWriteFile(const char *) override
  {
    return false;
  }
  void
  WriteImageInformation() override
  {}
  void
  Write(const void *) override;

protected:
  SensorNoiseImageIO();
  ~SensorNoiseImageIO() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Inspects a file. Throws FileError, or std::invalid_argument if the text of the layout is not a layout. */
  void
  Inspect(const std::string & name);

  std::string            m_RawLayout;
  sensornoise::FrameFile m_File; // the file that was inspected last; without a name: no file
};

} // namespace itk

#endif
