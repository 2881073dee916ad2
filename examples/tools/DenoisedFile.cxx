// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/DenoisedFile.h"

#include "base/FreeMemory.h"
#include "sensornoise/NoiseModel.h"
#include "files/FrameReader.h"
#include "tools/ImageScale.h"
#include "tools/LowerCase.h"
#include "tools/PendingFile.h"
#include "tools/WriterErrors.h"
#include "itkImage.h"
#include "itkImageFileWriter.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Throws std::runtime_error if the format of the output cannot hold the pixels. It is called before the work
 * begins. */
template <typename TOutput>
void
RequireFormat(const std::string & output, bool isStack)
{
  const std::string ending = LowerCaseEnding(output);
  if (ending == ".png" && isStack)
  {
    throw std::runtime_error("the output is " + output +
                             " and the input a stack; PNG holds one frame, expected .mha, "
                             ".nrrd or .tif");
  }
  if (ending == ".png" && !std::is_same_v<TOutput, unsigned char> && !std::is_same_v<TOutput, unsigned short>)
  {
    throw std::runtime_error("the output is " + output +
                             "; PNG holds unsigned char and unsigned short only, expected .mha, .nrrd or .tif");
  }
  if ((ending == ".tif" || ending == ".tiff") && std::is_same_v<TOutput, double>)
  {
    throw std::runtime_error("the output is " + output +
                             "; ITK writes no TIFF of type double, expected .mha or .nrrd, or --pixel-type float");
  }
}

/** Returns an image with the size, spacing, origin and direction of the frame list. */
template <typename TImage>
typename TImage::Pointer
MakeLike(const FrameList & list)
{
  const auto                     image = TImage::New();
  typename TImage::SizeType      size;
  typename TImage::SpacingType   spacing;
  typename TImage::PointType     origin;
  typename TImage::DirectionType direction;
  const std::size_t              sizes[3] = { list.width, list.height, list.frames };
  for (unsigned int d = 0; d < TImage::ImageDimension; ++d)
  {
    size[d] = sizes[d];
    spacing[d] = list.geometry.spacing[d];
    origin[d] = list.geometry.origin[d];
    for (unsigned int e = 0; e < TImage::ImageDimension; ++e)
    {
      direction[d][e] = list.geometry.direction[d][e];
    }
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  image->Allocate();
  return image;
}

template <typename TPixel, typename TOutput>
void
DenoiseFrames(const FrameList & list, const NoiseModelFile & report, const Denoiser & denoise, TOutput * output)
{
  const GeneralizedAnscombe transform(report.model);
  std::vector<TPixel>       levels(list.width * list.height);
  bool                      isWarned = false;
  for (std::size_t t = 0; t < list.frames; ++t)
  {
    ReadFrames(list, t, 1, levels.data());
    const std::string name =
      list.files.front().name + (list.isStack ? ", frame " + std::to_string(t) + "," : std::string());
    const std::string odd = RequireScale(levels, report, name);
    if (!odd.empty() && !isWarned)
    {
      std::cerr << "warning: " << odd << '\n';
      isWarned = true;
    }
    RealFrame frame{ list.width, list.height, std::vector<float>(levels.size()) };
    transform.Stabilise(levels.data(), levels.size(), frame.pixels.data());
    denoise(frame);
    transform.Invert(frame.pixels.data(), levels.size(), output + t * levels.size(), AnscombeInverse::ExactUnbiased);
  }
}

template <typename TPixel, typename TOutput, unsigned int VDimension>
void
WriteAs(const FrameList & list, const NoiseModelFile & report, const Denoiser & denoise, const std::string & name)
{
  using ImageType = itk::Image<TOutput, VDimension>;
  RequireFormat<TOutput>(name, list.isStack);
  PendingFile  file(name); // throws before the work begins if the file cannot be written
  const double pixels =
    static_cast<double>(list.width) * static_cast<double>(list.height) * static_cast<double>(list.frames);
  file.RequireRoom(LowerCaseEnding(name) == ".png" ? 0.0 : pixels * sizeof(TOutput));
  RequireMemory(pixels * sizeof(TOutput), "the output " + name);
  const auto image = MakeLike<ImageType>(list);
  DenoiseFrames<TPixel>(list, report, denoise, image->GetBufferPointer());
  const auto writer = itk::ImageFileWriter<ImageType>::New();
  writer->SetInput(image);
  writer->SetFileName(file.Temporary().string());
  WriteNamed(file, [&] { writer->Update(); });
  if (LowerCaseEnding(name) != ".png") // the other formats are not compressed
  {
    file.RequireBytes(static_cast<std::uintmax_t>(pixels) * sizeof(TOutput));
  }
  file.Commit();
}

template <typename TPixel>
void
WriteOf(const FrameList &      list,
        const NoiseModelFile & report,
        const Denoiser &       denoise,
        const std::string &    name,
        bool                   asFloat)
{
  if (asFloat)
  {
    list.isStack ? WriteAs<TPixel, float, 3>(list, report, denoise, name)
                 : WriteAs<TPixel, float, 2>(list, report, denoise, name);
    return;
  }
  list.isStack ? WriteAs<TPixel, TPixel, 3>(list, report, denoise, name)
               : WriteAs<TPixel, TPixel, 2>(list, report, denoise, name);
}
} // namespace

void
WriteDenoised(const std::string &    input,
              const std::string &    output,
              const NoiseModelFile & report,
              const Denoiser &       denoise,
              bool                   asFloat,
              const std::string &    rawLayout)
{
  FrameChoice all;
  all.all = true;
  const FrameList list = OpenFrames({ input }, {}, rawLayout, all);
  return CallWithPixelType(
    list.pixel, [&](auto pixel) { return WriteOf<decltype(pixel)>(list, report, denoise, output, asFloat); });
}

} // namespace sensornoise::tools
