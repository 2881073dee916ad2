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
 * \brief Reads frames from files as a stack, an image whose last axis is time: one stack file or several, or a list of
 * frames.
 *
 * Every file is checked before a pixel is read (sensornoise::OpenFrames()): whether it is complete, of one grey value a
 * pixel, and as all others in size and type. Whatever a damaged file would make of ITK's own readers, which fill up,
 * guess or end the process, is an error here, one sentence that begins with the name of the file. Nothing is converted:
 * the pixel type is the component type of the files, and a program that does not know that asks ReadComponentType()
 * before it chooses.
 *
 * A list streams: no more frames than were asked for are held. So do multi-page TIFF, SER, MRAW, raw frames without a
 * header, an uncompressed MetaImage, and whatever else ITK reads in parts. Other stacks (NRRD, compressed MetaImage)
 * are read whole, at each reading again. A frame is read whole, whatever part of it is wanted. Formats that this
 * library reads itself, TIFF for one, are read by several threads at once, those that ITK reads by one.
 *
 * A file that has changed since it was checked, by size, time or place on the disk, is an error as well, at the reading
 * that meets it. After an error the next Update() checks the files anew and starts from them as they are then.
 *
 * The region starts at index 0. Spacing, origin and direction are those of the stack's file, or for x and y those of
 * the list's first; time has spacing 1 and origin 0 there. What the file, or the list's first, says of the camera is in
 * the output's MetaDataDictionary (itkSensorNoiseMetaData.h).
 *
 * Not ImageSeriesReader: that stacks images of height 1 along y instead of time, converts a file whose component type
 * has changed, and believes files that have been cut off since.
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

  /** Files in time order: 2-D images, or 3-D ones of one slice; or stacks. Required: without one, or with
   * files that OpenFrames() refuses, Update() and UpdateOutputInformation() throw. */
  void
  SetFileNames(const std::vector<std::string> & names);
  const std::vector<std::string> &
  GetFileNames() const
  {
    return m_FileNames;
  }
  /** One more file, after the others. */
  void
  AddFileName(const std::string & name);
  /** One file alone: a stack, or a single frame. */
  void
  SetFileName(const std::string & name);

  /** How frames lie in files that do not say so themselves, "640x480:uint16le" for instance, "1920x1080:Mono12p:64" for
   * packed ones behind 64 other bytes; see sensornoise::ReadRawLayout(). Default: empty, the files say so. */
  void
  SetRawLayout(const std::string & layout);
  const std::string &
  GetRawLayout() const
  {
    return m_RawLayout;
  }

  /** Files that are open already, and are not checked a second time. */
  void
  SetFrameList(const sensornoise::FrameList & list);
  /** What the files hold, checked first if they are not yet, for instance their type. Does not ask whether this source
   * has the right one, so that a source of any type can be asked, and what it found handed on to another by
   * SetFrameList(). */
  const sensornoise::FrameList &
  GetFrameList();

  /** Every file that is read, in the order of the frames, each header's files of pixels behind it. Checks them first if
   * they are not yet. */
  std::vector<std::string>
  GetFilesRead();

  /** Component type of the files, UCHAR, USHORT, SHORT, FLOAT or DOUBLE. Checks them first if they are not yet. */
  IOComponentEnum
  GetComponentType();
  /** Component type of some files, for a program that has to choose the source's type. Throws as Update() would. */
  static IOComponentEnum
  ReadComponentType(const std::vector<std::string> & names);

  /** What is odd about the files and no error, as a sentence, or nothing: that one is there twice, for instance. Checks
   * the files first if they are not yet. */
  std::string
  GetWarning();

  /** Whether fewer frames than all can be read. Checks the files first if they are not yet. */
  bool
  CanStream();

protected:
  SensorNoiseFrameListSource() = default;
  ~SensorNoiseFrameListSource() override = default;

  void
  GenerateOutputInformation() override;
  /** Whole frames; all of them where the files do not stream. */
  void
  EnlargeOutputRequestedRegion(DataObject * output) override;
  void
  GenerateData() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Reads the frames from \a first up to \a end in parts of so many frames, at the same time. Of several errors, that
   * of the earliest part is thrown. */
  void
  ReadSideBySide(std::size_t first, std::size_t end, std::size_t partFrames, OutputPixelType * buffer);

  std::vector<std::string> m_FileNames;
  std::string              m_RawLayout;
  sensornoise::FrameList   m_FrameList;
  bool                     m_IsOpen{ false };
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseFrameListSource<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#ifdef ITK_IO_FACTORY_REGISTER_MANAGER
#  include "itkImageIOFactoryRegisterManager.h" // as ImageFileReader: registers the formats that the program links
#endif

#endif
