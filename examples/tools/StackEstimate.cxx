// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/StackEstimate.h"

#include "files/FrameReader.h"
#include "tools/CompanionFiles.h"
#include "tools/EstimateOptions.h"
#include "tools/FilesHash.h"
#include "tools/FramesTitle.h"
#include "tools/MapFiles.h"
#include "tools/SvgAsPng.h"
#include "base/FreeMemory.h"
#include "moments/StackFrames.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/ReportPage.h"
#include "report/StackReport.h"
#include "refined/PixelProjections.h"
#include "itkCommand.h"
#include "itkExtractImageFilter.h"
#include "itkSensorNoiseEstimator.h"
#include "itkSensorNoiseFrameListSource.h"
#include "itkSensorNoiseMetaData.h"
#include "itkSensorNoisePageMaps.h"
#include "itkSingleImageNoiseEstimator.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <variant>

namespace sensornoise::tools
{
namespace
{
using MaskType = itk::Image<unsigned char, 2>;

void
ShowProgressOn(itk::ProcessObject & filter)
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
  filter.AddObserver(itk::ProgressEvent(), command);
}

/** Returns a filter that cuts a region out of an image, chunk by chunk. Its output is valid as long as the filter
 * exists. */
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

/** Returns the part of the stack that --roi and --frames select. Throws std::invalid_argument if the stack does not
 * contain it. */
itk::ImageRegion<3>
SelectRegion(const EstimateOptions & options, const FrameList & list, const itk::ImageRegion<3> & whole)
{
  itk::ImageRegion<3> region = whole;
  if (options.roi)
  {
    for (unsigned int d = 0; d < 2; ++d)
    {
      region.SetIndex(d, (*options.roi)[d]);
      region.SetSize(d, static_cast<itk::SizeValueType>((*options.roi)[d + 2]));
    }
  }
  if (list.isStack && options.cut)
  {
    region.SetIndex(2, static_cast<itk::IndexValueType>(options.cut->first));
    region.SetSize(2, options.cut->second - options.cut->first);
  }
  if (!whole.IsInside(region))
  {
    const std::string names = options.roi && options.cut ? "--roi and --frames ask"
                              : options.roi              ? "--roi asks"
                                                         : "--frames asks";
    throw std::invalid_argument(names + " for " + options.DescribeRegion() + ", but the stack has " +
                                std::to_string(list.width) + " x " + std::to_string(list.height) + " pixels and " +
                                std::to_string(list.frames) + " frames, counted from 0; expected a part of it");
  }
  return region;
}

/** Returns the part of the mask that lies in the region. */
MaskType::Pointer
SelectMask(const std::string & file, const FrameList & list, const itk::ImageRegion<3> & region)
{
  const MaskType::Pointer mask = ReadMask(file, list);
  MaskType::RegionType    frame = mask->GetLargestPossibleRegion();
  for (unsigned int d = 0; d < 2; ++d)
  {
    frame.SetIndex(d, region.GetIndex(d));
    frame.SetSize(d, region.GetSize(d));
  }
  const auto crop = Crop<MaskType>(mask, frame);
  crop->Update();
  return crop->GetOutput();
}

template <typename TStack>
typename itk::SensorNoiseFrameListSource<TStack>::Pointer
MakeReader(const FrameList & list)
{
  auto reader = itk::SensorNoiseFrameListSource<TStack>::New();
  reader->SetFrameList(list);
  return reader;
}

/** Returns the numbers of columns and rows that --roi cuts off before the region [pixel]. */
std::array<std::size_t, 2>
CutOff(const EstimateOptions & options)
{
  const auto number = [&options](std::size_t i) { return static_cast<std::size_t>((*options.roi)[i]); };
  return options.roi ? std::array<std::size_t, 2>{ number(0), number(1) } : std::array<std::size_t, 2>{ 0, 0 };
}

/** Sets the Bayer pattern, from --bayer or from the file, shifted to the corner of the region. A cropped image has
 * no metadata. */
template <typename TStack, typename TEstimator>
void
SetPattern(const EstimateOptions & options, const TStack & whole, TStack & cut, TEstimator & estimator)
{
  const auto [columns, rows] = CutOff(options);
  const auto cutPattern = [columns = columns, rows = rows](const std::string & name) {
    return NameOf(CutPattern(BayerPatternOf(name), columns, rows));
  };
  const bool isName = options.bayer != "none" && options.bayer != "auto";
  estimator.SetBayerPattern(isName ? cutPattern(options.bayer) : options.bayer);
  CameraSettings camera = CameraSettingsOf(whole.GetMetaDataDictionary());
  if (&whole != &cut)
  {
    camera.bayerPattern = camera.bayerPattern.empty() ? "" : cutPattern(camera.bayerPattern);
    SetCameraSettings(cut.GetMetaDataDictionary(), camera);
  }
}

template <typename TStack>
MeasuredStack
ResultOf(const itk::SensorNoiseEstimator<TStack> & estimator)
{
  if (estimator.HasChannelReports())
  {
    return estimator.GetChannelReports();
  }
  return estimator.GetReport();
}

/** Returns the text of the file that --plot selects. Only a page needs \a maps. The figure of a mosaic shows the
 * channel G1. */
std::string
MakePlot(PlotKind kind, const MeasuredStack & measured, const PageTitle & title, const PageMaps & maps)
{
  if (kind == PlotKind::Page)
  {
    return std::visit([&](const auto & report) { return ToHtml(report, maps, title); }, measured);
  }
  const auto * const report = std::get_if<Report>(&measured);
  const std::string  svg = ToSvg(report != nullptr ? *report : std::get<ChannelReports>(measured).Of(BayerPlane::G1));
  return kind == PlotKind::Png ? SvgAsPng(svg) : svg;
}

/** Prints the memory that the estimate of a large frame needs, before it starts. */
void
NoteMemory(const EstimateOptions & options, const itk::ImageRegion<3> & region)
{
  constexpr double leastNoted = 1e9; // bytes. Chosen empirically: computers have more memory than twice this limit
  const MemoryNeed need{ region.GetSize(0) * region.GetSize(1), region.GetSize(2) };
  if (options.quiet || options.method != "refined" || need.Least() < leastNoted)
  {
    return;
  }
  std::cerr << "note: frames of " << region.GetSize(0) << " x " << region.GetSize(1) << " pixels need "
            << TextOfBytes(need.Least()) << " of memory";
  if (options.memoryLimit == 0)
  {
    std::cerr << ", or " << TextOfBytes(need.BesideProjections()) << " and "
              << TextOfBytes(need.OfProjections(1, SumWidth::Narrow))
              << " for each temporal component of illumination and motion (2 to 20), if that is more; --memory-limit "
                 "reads the stack more often instead";
  }
  std::cerr << '\n';
}

/** Adds the hash of the frame files, and of the dark frame files, to the reports. */
void
AddHash(const EstimateOptions & options, const FrameList & list, const FrameList & dark, MeasuredStack & measured)
{
  if (options.WantsHash())
  {
    const InputRecord input{ HashOf(list),
                             options.dark.empty() ? std::nullopt : std::optional<InputFiles>(HashOf(dark)) };
    std::visit([&input](auto & report) { report.input = input; }, measured);
  }
}

/** Measures the frames with the single-image method. */
template <typename TStack>
MeasuredStack
EstimateSingleImages(const EstimateOptions &     options,
                     const FrameList &           list,
                     const itk::ImageRegion<3> & region,
                     const TStack &              stack,
                     TStack &                    selected,
                     std::string *               plot)
{
  const auto estimator = itk::SingleImageNoiseEstimator<TStack>::New();
  estimator->SetInput(&selected);
  options.ApplyCommonTo(*estimator);
  SetPattern(options, stack, selected, *estimator);
  if (!options.mask.empty())
  {
    estimator->SetMask(SelectMask(options.mask, list, region));
  }
  if (!options.quiet && isatty(STDERR_FILENO) != 0)
  {
    ShowProgressOn(*estimator);
  }
  estimator->Update();
  MeasuredStack measured = estimator->GetResult();
  AddHash(options, list, {}, measured);
  if (plot != nullptr)
  {
    *plot = MakePlot(options.Plot(), measured, TitleOf(list), {});
  }
  return measured;
}

template <typename TPixel>
MeasuredStack
Estimate(const EstimateOptions & options, const FrameList & list, MapFiles * maps, std::string * plot)
{
  using StackType = itk::Image<TPixel, 3>;
  const auto reader = MakeReader<StackType>(list);
  reader->UpdateOutputInformation();
  StackType * const         stack = reader->GetOutput();
  const itk::ImageRegion<3> whole = stack->GetLargestPossibleRegion();
  const itk::ImageRegion<3> region = SelectRegion(options, list, whole);
  const auto                crop = Crop<StackType>(stack, region);

  StackType * const selected = region == whole ? stack : crop->GetOutput();
  if (options.method == "single-image")
  {
    return EstimateSingleImages(options, list, region, *stack, *selected, plot);
  }
  const auto estimator = itk::SensorNoiseEstimator<StackType>::New();
  estimator->SetInput(selected);
  options.ApplyTo(*estimator);
  SetPattern(options, *stack, *selected, *estimator);
  if (!options.mask.empty())
  {
    estimator->SetMask(SelectMask(options.mask, list, region));
  }
  // the filters must exist as long as their output images: an image does not own its filter
  FrameList                                                       darkList;
  typename itk::SensorNoiseFrameListSource<StackType>::Pointer    darkReader;
  typename itk::ExtractImageFilter<StackType, StackType>::Pointer darkCrop;
  if (!options.dark.empty())
  {
    darkList = OpenDark(options.dark, list, options.raw, options.choice);
    darkReader = MakeReader<StackType>(darkList);
    darkReader->UpdateOutputInformation();
    itk::ImageRegion<3> dark = region;
    dark.SetIndex(2, 0);
    dark.SetSize(2, darkReader->GetOutput()->GetLargestPossibleRegion().GetSize(2));
    darkCrop = Crop<StackType>(darkReader->GetOutput(), dark);
    estimator->SetDark(darkCrop->GetOutput());
  }
  NoteMemory(options, region);
  if (!options.quiet && isatty(STDERR_FILENO) != 0)
  {
    ShowProgressOn(*estimator);
  }
  estimator->Update();
  if (maps != nullptr)
  {
    if (estimator->GetPixelOffset()->GetLargestPossibleRegion().GetNumberOfPixels() > 0)
    {
      maps->WriteCalibration(
        { estimator->GetPixelOffset(), estimator->GetPixelOffsetLow(), estimator->GetPixelOffsetHigh() },
        { estimator->GetPixelReadNoise(), estimator->GetPixelReadNoiseLow(), estimator->GetPixelReadNoiseHigh() });
    }
    maps->Write(
      estimator->GetMean(), estimator->GetVariance(), estimator->GetCorrectedVariance(), estimator->GetPixelUse());
  }
  MeasuredStack measured = ResultOf(*estimator);
  AddHash(options, list, darkList, measured);
  if (plot != nullptr)
  {
    const bool isPage = options.Plot() == PlotKind::Page;
    *plot = MakePlot(options.Plot(),
                     measured,
                     TitleOf(list),
                     isPage ? itk::PageMapsOf(estimator->GetMean(), estimator->GetPixelUse()) : PageMaps{});
  }
  return measured;
}
} // namespace

void
RequireSelection(const EstimateOptions & options, const FrameList & list)
{
  itk::ImageRegion<3> whole;
  whole.SetSize({ { list.width, list.height, list.frames } });
  const itk::ImageRegion<3> region = SelectRegion(options, list, whole);
  RequireStack({ region.GetSize(0), region.GetSize(1) }, region.GetSize(2), 0);
  if (!options.mask.empty())
  {
    ReadMask(options.mask, list);
  }
}

std::string
PatternOf(const EstimateOptions & options, const MeasuredStack & measured)
{
  const auto * const channels = std::get_if<ChannelReports>(&measured);
  const auto         cut = CutOff(options); // the same shift again gives the pattern of the frame
  return channels == nullptr ? "none" : NameOf(CutPattern(channels->pattern, cut[0], cut[1]));
}

MeasuredStack
EstimateStack(const EstimateOptions & options, const FrameList & list, MapFiles * maps, std::string * plot)
{
  return CallWithPixelType(list.pixel,
                           [&](auto pixel) { return Estimate<decltype(pixel)>(options, list, maps, plot); });
}

} // namespace sensornoise::tools
