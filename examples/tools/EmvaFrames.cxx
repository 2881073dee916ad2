// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EmvaFrames.h"

#include "base/PixelLayout.h"
#include "files/FrameReader.h"
#include "mosaic/MosaicGeometry.h"
#include "tools/EmvaSources.h"
#include "tools/EstimateOptions.h"
#include "itkSensorNoiseFrameFiles.h"
#include "itkSensorNoiseThreads.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Pixels that are evaluated together: of a region, or of each plane of a region. */
struct EmvaParts
{
  FrameGeometry               size; ///< size of each part
  std::vector<PixelLayout>    layouts;
  std::optional<BayerPattern> pattern; ///< pattern of the region; null: monochrome
};

/** Returns the pattern of the whole frame; null: it is monochrome. */
std::optional<BayerPattern>
PatternOf(const EstimateOptions & options, const FrameList & list)
{
  const std::string name = options.bayer == "auto" ? list.camera.bayerPattern : options.bayer;
  return name.empty() || name == "none" ? std::nullopt : std::optional<BayerPattern>(BayerPatternOf(name));
}

EmvaParts
PartsOf(const EstimateOptions & options, const FrameList & list)
{
  const auto        whole = std::array<long, 4>{ 0, 0, static_cast<long>(list.width), static_cast<long>(list.height) };
  const auto        roi = options.roi.value_or(whole);
  const std::size_t x = static_cast<std::size_t>(roi[0]);
  const std::size_t y = static_cast<std::size_t>(roi[1]);
  const FrameGeometry region{ static_cast<std::size_t>(roi[2]), static_cast<std::size_t>(roi[3]) };
  if (x + region.width > list.width || y + region.height > list.height)
  {
    throw std::invalid_argument("--roi asks for " + options.DescribeRegion() + ", but the frames have " +
                                std::to_string(list.width) + " x " + std::to_string(list.height) +
                                " pixels; expected a part of them");
  }
  const auto layoutAt = [&](std::size_t column, std::size_t row, std::size_t step, std::size_t width) {
    return PixelLayout{ row * list.width + column, step, step * list.width, list.width * list.height, width };
  };
  const std::optional<BayerPattern> pattern = PatternOf(options, list);
  if (!pattern)
  {
    return { region, { layoutAt(x, y, 1, region.width) }, std::nullopt };
  }
  EmvaParts parts;
  parts.pattern = CutPattern(*pattern, x, y);
  parts.size = MosaicGeometry{ region, *parts.pattern }.Plane();
  for (const BayerPlane plane : BayerPlanes)
  {
    const auto corner = CornerOf(*parts.pattern, plane);
    parts.layouts.push_back(layoutAt(x + corner[0], y + corner[1], 2, parts.size.width));
  }
  return parts;
}

/** Throws if the frames contradict the list, or if there is only one frame. */
void
RequireFrames(const FrameList & list, const EmvaSource & source, const EmvaSourceList & all)
{
  if (all.width > 0 && (list.width != all.width || list.height != all.height))
  {
    throw std::runtime_error(source.files.front() + " has " + DescribeFrame(list) + ", and the list says " +
                             std::to_string(all.width) + " x " + std::to_string(all.height) + "; expected one size");
  }
  const std::size_t frames = source.frames.empty() ? list.frames : source.frames.size();
  if (frames < 2)
  {
    throw std::runtime_error(source.where + " has one frame; expected two or more frames of each exposure");
  }
}

/** Returns the statistics of each part. */
template <typename TPixel>
std::vector<EmvaSeries>
AddUp(const FrameList & list, const std::vector<std::size_t> & frames, const EmvaParts & parts)
{
  const ParallelFor           parallelFor = itk::SensorNoiseThreads();
  std::vector<EmvaSeriesSums> sums(parts.layouts.size(), EmvaSeriesSums(parts.size.width, parts.size.height));
  std::vector<TPixel>         frame(list.width * list.height);
  std::vector<TPixel>         part(parts.size.Pixels());
  for (const std::size_t t : frames)
  {
    ReadFrames(list, t, 1, frame.data());
    for (std::size_t k = 0; k < sums.size(); ++k)
    {
      sums[k].AddFrame(parts.layouts[k].SideBySide(frame.data(), 0, part.size(), part.data()), parallelFor);
    }
  }
  std::vector<EmvaSeries> series;
  series.reserve(sums.size());
  for (const EmvaSeriesSums & each : sums)
  {
    series.push_back(each.Measure(parallelFor));
  }
  return series;
}

std::vector<EmvaSeries>
AddUp(const FrameList & list, const EmvaSource & source, const EmvaParts & parts)
{
  std::vector<std::size_t> frames = source.frames;
  if (frames.empty())
  {
    frames.resize(list.frames);
    std::iota(frames.begin(), frames.end(), std::size_t{ 0 });
  }
  std::vector<EmvaSeries> series =
    CallWithPixelType(list.pixel, [&](auto pixel) { return AddUp<decltype(pixel)>(list, frames, parts); });
  for (EmvaSeries & each : series)
  {
    each.exposure = source.exposure;
    each.photons = source.photons;
    each.isDark = source.isDark;
  }
  return series;
}

/** Files of the series that were opened. */
class FilesOfSeries
{
public:
  void
  Add(const FrameList & list, bool isDark)
  {
    for (const FrameFile & file : list.files)
    {
      if (m_Known.insert(file.name).second)
      {
        m_Files.push_back(file);
      }
      if (!isDark)
      {
        m_OfFlats.insert(file.name);
      }
    }
  }

  /** Returns the files with flat fields, or those without. */
  FrameList
  Get(bool hasFlats) const
  {
    FrameList list;
    std::copy_if(m_Files.begin(), m_Files.end(), std::back_inserter(list.files), [&](const FrameFile & file) {
      return (m_OfFlats.count(file.name) > 0) == hasFlats;
    });
    return list;
  }

private:
  std::vector<FrameFile> m_Files; // each once
  std::set<std::string>  m_Known;
  std::set<std::string>  m_OfFlats;
};
} // namespace

EmvaMeasured
EvaluateFrames(const EstimateOptions & options, const EmvaSourceList & all)
{
  std::vector<std::vector<EmvaSeries>> series; // series of each part
  std::vector<std::string>             opened;
  FrameList                            list;
  EmvaParts                            parts;
  FilesOfSeries                        files;
  for (const EmvaSource & source : all.sources)
  {
    if (source.files != opened)
    {
      list = OpenFrames(source.files, {}, options.raw, options.choice);
      opened = source.files;
    }
    files.Add(list, source.isDark);
    RequireFrames(list, source, all);
    const EmvaParts here = PartsOf(options, list);
    if (!series.empty() && here.pattern != parts.pattern)
    {
      throw std::runtime_error(source.files.front() +
                               " has other colour filters than the frames before it; expected frames of one camera, or "
                               "--bayer with the pattern");
    }
    parts = here;
    series.resize(parts.layouts.size());
    const std::vector<EmvaSeries> measured = AddUp(list, source, parts);
    for (std::size_t k = 0; k < series.size(); ++k)
    {
      series[k].push_back(measured[k]);
    }
  }
  EmvaSettings settings;
  settings.quantizationStepDn = options.step > 0.0 ? options.step : 1.0;
  settings.bitDepth = options.bitDepth > 0 ? options.bitDepth : all.bitDepth > 0 ? all.bitDepth : list.camera.bitDepth;
  settings.exposureUnit = all.exposureUnit;
  if (!parts.pattern)
  {
    return { EvaluateEmva1288(series.front(), settings), files.Get(true), files.Get(false) };
  }
  EmvaMosaicReport mosaic;
  mosaic.pattern = *parts.pattern;
  std::transform(series.begin(), series.end(), mosaic.planes.begin(), [&settings](const auto & ofPlane) {
    return EvaluateEmva1288(ofPlane, settings);
  });
  return { mosaic, files.Get(true), files.Get(false) };
}

} // namespace sensornoise::tools
