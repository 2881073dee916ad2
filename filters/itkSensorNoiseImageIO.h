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
 * \brief Reads bursts that ITK has no reader for, or none that reads them in parts: SER, Photron's MRAW, stacks on
 * multi-page TIFF, raw files of cameras (with LibRaw), and, if their layout is given, raw frames without a header.
 *
 * Each file is checked whole before a pixel is read (sensornoise::InspectFrameFile()), so that a damaged one is an
 * error of one sentence. Codes stand as the sensor gave them: those of 10 and 12 bits that are packed in the file come
 * as unsigned short. What the file says of the camera is in the MetaDataDictionary (itkSensorNoiseMetaData.h).
 *
 * An image of several frames has three dimensions, the last of which is time; one frame has two. Frames are read whole,
 * no more of them than are asked for.
 *
 * CanReadFile() takes of TIFFs only those of several pages of one grey value a pixel; others are left to ITK. Raw files
 * of cameras it takes always, DNG among them, of which ITK's reader of TIFF would read the preview: what is wrong with
 * one, or that this build has no LibRaw, is then an error. Nothing is written.
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

  /** How frames lie in a file that does not say so itself, "640x480:uint16le" for instance; see
   * sensornoise::ReadRawLayout(). Empty, the default: the file says so. Throws where it is read, if it is no layout. */
  void
  SetRawLayout(const std::string & layout);
  const std::string &
  GetRawLayout() const
  {
    return m_RawLayout;
  }

  /** Throws unless all codes of a raw file that is a TIFF, a DNG above all, are in the file, whole numbers without
   * loss: for readers that do not look. \a width, \a height: of the codes that LibRaw finds, margins too [pixels]. */
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
  /** Whole frames. */
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
  /** Throws FileError, or std::invalid_argument for a layout that is none. */
  void
  Inspect(const std::string & name);

  std::string            m_RawLayout;
  sensornoise::FrameFile m_File; // what was inspected last; without a name: nothing
};

} // namespace itk

#endif
