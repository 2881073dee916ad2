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
// Measures the noise of a camera from a burst of raw frames on files. See --help, and README.md.

#include "sensornoise/report/ReportJson.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/report/ReportTable.h"
#include "tools/EstimateOptions.h"
#include "input/FrameInput.h"
#include "tools/MapFiles.h"
#include "tools/PendingFile.h"
#include "itkCommand.h"
#include "itkExtractImageFilter.h"
#include "itkImageFileReader.h"
#include "itkMultiThreaderBase.h"
#include "itkSensorNoiseEstimator.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoise::tools;
using MaskType = itk::Image<unsigned char, 2>;

constexpr int ExitDone = 0;
constexpr int ExitWrongUse = 2;
constexpr int ExitNothingEstimated = 3;

/** What an ITK exception says, without the class and address in front of it and on one line. */
std::string
TextOf(const itk::ExceptionObject & error)
{
  std::string text = error.GetDescription();
  const auto  end = text.find("): ");
  text.erase(0, end == std::string::npos ? 0 : end + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

template <typename TFilter>
void
ShowProgressOn(TFilter * filter)
{
  auto command = itk::CStyleCommand::New();
  command->SetCallback([](itk::Object * object, const itk::EventObject &, void *) {
    const float progress = static_cast<itk::ProcessObject *>(object)->GetProgress();
    const int   done = static_cast<int>(40.0F * progress);
    std::fprintf(stderr,
                 "\r[%s%s] %3d %%%s",
                 std::string(static_cast<std::size_t>(done), '#').c_str(),
                 std::string(static_cast<std::size_t>(40 - done), '.').c_str(),
                 static_cast<int>(100.0F * progress),
                 progress < 1.0F ? "" : "\n");
    std::fflush(stderr);
  });
  filter->AddObserver(itk::ProgressEvent(), command);
}

/** Cuts a region out of an image, chunk by chunk; the output lives as long as the filter. */
template <typename TImage>
typename itk::ExtractImageFilter<TImage, TImage>::Pointer
Crop(TImage * image, const typename TImage::RegionType & region)
{
  auto extract = itk::ExtractImageFilter<TImage, TImage>::New();
  extract->SetInput(image);
  extract->SetExtractionRegion(region);
  extract->SetDirectionCollapseToSubmatrix();
  extract->UpdateOutputInformation();
  return extract;
}

MaskType::Pointer
ReadMask(const std::string & file, const FrameInput & input)
{
  const FrameInput header = OpenFrames({ file });
  if (header.isStack)
  {
    throw InputError("the mask " + file + " has " + std::to_string(header.frames) + " frames; expected one image");
  }
  if (header.width != input.width || header.height != input.height)
  {
    throw InputError("the mask " + file + " has " + std::to_string(header.width) + " x " +
                     std::to_string(header.height) + " pixels, but the frames have " + std::to_string(input.width) +
                     " x " + std::to_string(input.height));
  }
  // Nonzero means use, whatever the type: a double holds them all.
  auto reader = itk::ImageFileReader<itk::Image<double, 2>>::New();
  reader->SetFileName(file);
  try
  {
    reader->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    throw InputError("the mask " + PixelErrorOf(file, error));
  }
  auto mask = MaskType::New();
  mask->SetRegions(reader->GetOutput()->GetLargestPossibleRegion());
  mask->Allocate();
  const double * values = reader->GetOutput()->GetBufferPointer();
  std::transform(values, values + input.width * input.height, mask->GetBufferPointer(), [](double value) {
    return value != 0.0 ? 1 : 0;
  });
  return mask;
}

/** Opens the headers of dark frames, which must have the size and type of the others. */
FrameInput
OpenDark(const std::vector<std::string> & files, const FrameInput & input)
{
  const auto describe = [](const FrameInput & frames) {
    std::string type = itk::ImageIOBase::GetComponentTypeAsString(frames.component);
    std::replace(type.begin(), type.end(), '_', ' ');
    return std::to_string(frames.width) + " x " + std::to_string(frames.height) + " pixels of type " + type;
  };
  FrameInput dark = OpenFrames(files);
  if (describe(dark) != describe(input))
  {
    throw InputError("the dark frames have " + describe(dark) + " (" + files.front() + "), but the frames have " +
                     describe(input));
  }
  return dark;
}

template <typename TPixel>
sensornoise::Report
Estimate(const EstimateOptions & options, const FrameInput & input, MapFiles * maps)
{
  using StackType = itk::Image<TPixel, 3>;
  auto reader = MakeReader<TPixel>(input);
  reader->UpdateOutputInformation();
  typename StackType::Pointer    stack = reader->GetOutput();
  typename StackType::RegionType region = stack->GetLargestPossibleRegion();
  if (options.roi)
  {
    for (unsigned int d = 0; d < 2; ++d)
    {
      region.SetIndex(d, (*options.roi)[d]);
      region.SetSize(d, static_cast<itk::SizeValueType>((*options.roi)[d + 2]));
    }
  }
  if (input.isStack && options.frames)
  {
    region.SetIndex(2, static_cast<itk::IndexValueType>(options.frames->first));
    region.SetSize(2, options.frames->second - options.frames->first);
  }
  if (!stack->GetLargestPossibleRegion().IsInside(region))
  {
    throw InputError("--roi and --frames ask for " + options.DescribeRegion() + ", but the stack has " +
                     std::to_string(input.width) + " x " + std::to_string(input.height) + " pixels and " +
                     std::to_string(input.frames) + " frames");
  }
  const auto crop = Crop<StackType>(stack, region);
  if (region != stack->GetLargestPossibleRegion())
  {
    stack = crop->GetOutput();
  }

  auto estimator = itk::SensorNoiseEstimator<StackType>::New();
  estimator->SetInput(stack);
  options.ApplyTo(*estimator);
  if (!options.mask.empty())
  {
    MaskType::Pointer    mask = ReadMask(options.mask, input);
    MaskType::RegionType frame = mask->GetLargestPossibleRegion();
    for (unsigned int d = 0; d < 2; ++d)
    {
      frame.SetIndex(d, region.GetIndex(d));
      frame.SetSize(d, region.GetSize(d));
    }
    const auto maskCrop = Crop<MaskType>(mask, frame);
    maskCrop->Update();
    estimator->SetMask(maskCrop->GetOutput());
  }
  typename itk::ImageSource<StackType>::Pointer                   darkReader;
  typename itk::ExtractImageFilter<StackType, StackType>::Pointer darkCrop;
  if (!options.dark.empty())
  {
    darkReader = MakeReader<TPixel>(OpenDark(options.dark, input));
    darkReader->UpdateOutputInformation();
    typename StackType::RegionType dark = region;
    dark.SetIndex(2, 0);
    dark.SetSize(2, darkReader->GetOutput()->GetLargestPossibleRegion().GetSize(2));
    darkCrop = Crop<StackType>(darkReader->GetOutput(), dark);
    estimator->SetDark(darkCrop->GetOutput());
  }
  if (!options.quiet && isatty(STDERR_FILENO) != 0)
  {
    ShowProgressOn(estimator.GetPointer());
  }
  estimator->Update();
  if (maps != nullptr)
  {
    maps->Write(*estimator);
  }
  return estimator->GetReport();
}

sensornoise::Report
EstimateFor(const EstimateOptions & options, const FrameInput & input, MapFiles * maps)
{
  switch (input.component)
  {
    case itk::IOComponentEnum::UCHAR:
      return Estimate<unsigned char>(options, input, maps);
    case itk::IOComponentEnum::USHORT:
      return Estimate<unsigned short>(options, input, maps);
    case itk::IOComponentEnum::SHORT:
      return Estimate<short>(options, input, maps);
    case itk::IOComponentEnum::FLOAT:
      return Estimate<float>(options, input, maps);
    default:
      return Estimate<double>(options, input, maps);
  }
}

bool
IsWhyNothingIsEstimated(const sensornoise::Warning & warning)
{
  const auto codes = { "nothing-to-measure",
                       "too-little-to-measure",
                       "intensity-range-too-small",
                       "variance-not-affine",
                       "codes-too-coarse" };
  return std::find(codes.begin(), codes.end(), warning.code) != codes.end();
}

int
Run(EstimateOptions & options)
{
  if (options.threads > 0)
  {
    itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(options.threads);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(options.threads);
  }
  options.SelectFiles();
  const FrameInput input = OpenFrames(options.files);

  std::unique_ptr<PendingFile> json;
  if (!options.json.empty() && options.json != "-")
  {
    json = std::make_unique<PendingFile>(options.json);
  }
  std::unique_ptr<MapFiles> maps;
  if (!options.maps.empty())
  {
    std::error_code error;
    fs::create_directories(options.maps, error);
    maps = std::make_unique<MapFiles>(options.maps);
  }
  constexpr std::uint64_t gibibyte = std::uint64_t{ 1 } << 30;
  if (!input.streams && input.bytes > gibibyte)
  {
    std::cerr << "note: " << input.files.front() << " cannot be read in parts; all of its " << (input.bytes >> 20)
              << " MiB are held in memory (a .mha file, or a list of files, would not be)\n";
  }

  const sensornoise::Report report = EstimateFor(options, input, maps.get());
  if (!options.quiet)
  {
    std::cout << MakeTable(report);
  }
  const std::string text = sensornoise::ToJson(report);
  if (json)
  {
    json->Write(text);
    json->Commit();
  }
  else if (options.json == "-")
  {
    std::cout << text;
  }
  if (!std::cout.flush())
  {
    throw std::runtime_error("cannot write the result to standard output: it was not taken");
  }
  for (const sensornoise::Warning & warning : report.warnings)
  {
    std::cerr << (IsWhyNothingIsEstimated(warning) ? "error: " : "warning: ") << warning.message << " [" << warning.code
              << "]\n";
  }
  return report.IsUsable() ? ExitDone : ExitNothingEstimated;
}
} // namespace

int
main(int argc, char * argv[])
{
  EstimateOptions options;
  try
  {
    if (const auto finished = options.Parse(argc, argv))
    {
      return *finished;
    }
    return Run(options);
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << "error: " << TextOf(error) << '\n';
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
  }
  return ExitWrongUse;
}
