// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "browser/BurstEstimate.h"

#include "browser/BurstChunks.h"
#include "browser/BurstMemory.h"
#include "files/FrameReader.h"
#include "moments/StackMaps.h"
#include "mosaic/MosaicGeometry.h"
#include "report/StackReport.h"
#include "sensornoise/MosaicMethod.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Settings.h"
#include "sensornoise/SingleImageMethod.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace sensornoise::browser
{
namespace
{
/** Returns the settings of the digital numbers. The bit depth of the options takes precedence over the bit depth of the
 * files, and the white level of the files is the upper clip level. The single-image method uses the options alone. */
DnSettings
DnSettingsOf(const Burst & burst, const BurstOptions & options)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (options.method == "single-image")
  {
    return MakeDnSettings(options.bitDepth, unknown, unknown, 0.0);
  }
  return MakeDnSettings(
    options.bitDepth > 0 ? options.bitDepth : burst.camera.bitDepth, unknown, burst.camera.whiteLevelDn, 0.0);
}

struct Mosaic
{
  BayerPattern pattern;
  BayerSource  source;
};

template <typename TPixel>
std::optional<Mosaic>
FindMosaic(const Burst & burst, const BurstOptions & options)
{
  if (options.bayer == "none")
  {
    return std::nullopt;
  }
  if (options.bayer != "auto")
  {
    return Mosaic{ BayerPatternOf(options.bayer), BayerSource::Given };
  }
  if (!burst.camera.bayerPattern.empty())
  {
    return Mosaic{ BayerPatternOf(burst.camera.bayerPattern), BayerSource::File };
  }
  std::vector<TPixel> frame(burst.geometry.Pixels());
  burst.read(0, 1, frame.data());
  const auto pattern = RecogniseMosaic(frame.data(), burst.geometry.width, burst.geometry.height);
  return pattern ? std::optional<Mosaic>(Mosaic{ *pattern, BayerSource::Levels }) : std::nullopt;
}

/** Returns the offset of each plane of a mosaic, or one offset of other frames; null: not known. */
template <typename TPixel>
std::vector<std::optional<KnownOffset>>
FindOffsets(const Burst &                 burst,
            const Burst *                 dark,
            const BurstOptions &          options,
            const std::optional<Mosaic> & mosaic,
            const BurstProgress &         progress)
{
  std::vector<std::optional<KnownOffset>> offsets(mosaic ? BayerPlanes.size() : 1);
  if (!std::isnan(options.offsetDn))
  {
    std::fill(offsets.begin(), offsets.end(), KnownOffset{ options.offsetDn });
  }
  else if (dark != nullptr)
  {
    auto sums = mosaic ? DarkFrameSums<TPixel>(MosaicGeometry{ dark->geometry, mosaic->pattern })
                       : DarkFrameSums<TPixel>(dark->geometry);
    ForChunks<TPixel>(*dark, 0, progress, [&sums](const TPixel * frames, std::size_t count) {
      sums.AddFrames(frames, count, SerialFor);
    });
    const auto measured = sums.Measure(DnSettingsOf(burst, options), SerialFor);
    std::copy(measured.begin(), measured.end(), offsets.begin());
  }
  else if (std::isfinite(burst.camera.opticalBlackDn + burst.camera.opticalBlackErrorDn))
  {
    const KnownOffset masked{ burst.camera.opticalBlackDn, burst.camera.opticalBlackErrorDn };
    std::fill(offsets.begin(), offsets.end(), masked);
  }
  return offsets;
}

/** Runs all passes of a method over the burst. */
template <typename TPixel, typename TMethod>
void
RunPasses(TMethod & method, const Burst & burst, const BurstProgress & progress)
{
  for (unsigned int pass = 0; !method.IsDone(); ++pass)
  {
    ForChunks<TPixel>(
      burst, pass, progress, [&](const TPixel * frames, std::size_t count) { method.AddFrames(frames, count); });
    method.EndPass();
  }
}

BurstResult
ResultOf(Report report, const Burst & burst)
{
  report.camera = burst.camera;
  BurstResult result;
  result.reports = std::move(report);
  return result;
}

BurstResult
ResultOf(std::array<Report, 4> reports, const Mosaic & mosaic, const Burst & burst)
{
  for (Report & report : reports)
  {
    report.camera = burst.camera;
  }
  BurstResult result;
  result.reports = MakeChannelReports(mosaic.pattern, mosaic.source, std::move(reports));
  return result;
}

/** Measures with the refined or the published method. settingsOf(part) returns the settings of the frames, or of the
 * plane with that number. */
template <typename TPixel, typename TMethod, typename TFunction>
BurstResult
RunMethod(const Burst &                 burst,
          const std::optional<Mosaic> & mosaic,
          const TFunction &             settingsOf,
          const BurstProgress &         progress)
{
  const auto withMaps = [](BurstResult result, auto & method) {
    result.mean = method.TakeMean();
    result.pixelUse = method.TakePixelUse();
    return result;
  };
  if (mosaic)
  {
    const std::array              settings{ settingsOf(0), settingsOf(1), settingsOf(2), settingsOf(3) };
    MosaicMethod<TPixel, TMethod> method(settings, burst.geometry, mosaic->pattern, burst.frames);
    RunPasses<TPixel>(method, burst, progress);
    return withMaps(ResultOf(method.GetReports(), *mosaic, burst), method);
  }
  TMethod method(settingsOf(0), burst.geometry, burst.frames);
  if constexpr (std::is_same_v<TMethod, RefinedMethod<TPixel>>)
  {
    method.DisableMerging();
  }
  RunPasses<TPixel>(method, burst, progress);
  return withMaps(ResultOf(method.GetReport(), burst), method);
}

template <typename TPixel>
BurstResult
RunSingleImages(const Burst &                 burst,
                const BurstOptions &          options,
                const std::optional<Mosaic> & mosaic,
                const BurstProgress &         progress)
{
  SingleImageSettings settings;
  settings.dnSettings = DnSettingsOf(burst, options);
  if (mosaic)
  {
    settings.bayerPattern = mosaic->pattern;
  }
  SingleImageMethod<TPixel> method(settings, burst.geometry, burst.frames);
  ForChunks<TPixel>(
    burst, 0, progress, [&](const TPixel * frames, std::size_t count) { method.AddFrames(frames, count); });
  std::vector<Report> reports = method.GetReports();
  if (!mosaic)
  {
    return ResultOf(std::move(reports.front()), burst);
  }
  std::array<Report, 4> channels;
  std::move(reports.begin(), reports.end(), channels.begin());
  return ResultOf(std::move(channels), *mosaic, burst);
}

template <typename TPixel>
BurstResult
Estimate(const Burst & burst, const Burst * dark, const BurstOptions & options, const BurstProgress & progress)
{
  const std::optional<Mosaic> mosaic = FindMosaic<TPixel>(burst, options);
  if (options.method == "single-image")
  {
    return RunSingleImages<TPixel>(burst, options, mosaic, progress);
  }
  if (options.method == "published")
  {
    PublishedSettings settings;
    settings.dnSettings = DnSettingsOf(burst, options);
    return RunMethod<TPixel, PublishedMethod<TPixel>>(
      burst, mosaic, [&settings](std::size_t) { return settings; }, progress);
  }
  const auto      offsets = FindOffsets<TPixel>(burst, dark, options, mosaic, progress);
  RefinedSettings settings;
  settings.dnSettings = DnSettingsOf(burst, options);
  settings.memoryLimitBytes = MemoryLimitOf(burst, options) / static_cast<double>(offsets.size());
  const auto settingsOf = [&](std::size_t part) {
    RefinedSettings ofPart = settings;
    ofPart.offset = offsets[part];
    return ofPart;
  };
  return RunMethod<TPixel, RefinedMethod<TPixel>>(burst, mosaic, settingsOf, progress);
}

/** Throws std::invalid_argument unless the options name a method that can use the given offset or dark frames. */
void
RequireMethod(const BurstOptions & options, bool hasDark)
{
  if (options.method != "refined" && options.method != "published" && options.method != "single-image")
  {
    throw std::invalid_argument("the method is \"" + options.method +
                                "\"; expected refined, published or single-image");
  }
  const bool hasOffset = !std::isnan(options.offsetDn);
  if (hasDark && hasOffset)
  {
    throw std::invalid_argument("an offset and dark frames were given; expected one of them");
  }
  if (hasOffset)
  {
    RequireUsed(options.method, "offset", "the offset");
  }
  if (hasDark)
  {
    RequireUsed(options.method, "dark", "dark frames");
  }
}
} // namespace

BurstResult
EstimateBurst(const Burst & burst, const Burst * dark, const BurstOptions & options, const BurstProgress & progress)
{
  RequireMethod(options, dark != nullptr);
  RequirePageMemory(burst, options);
  return CallWithPixelType(burst.pixel,
                           [&](auto pixel) { return Estimate<decltype(pixel)>(burst, dark, options, progress); });
}

} // namespace sensornoise::browser
