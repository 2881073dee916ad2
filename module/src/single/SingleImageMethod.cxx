// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/SingleImageMethod.h"

#include "base/NothingToMeasure.h"
#include "report/StackReport.h"
#include "single/ImageNoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{
namespace
{
std::vector<MeasuredPlane>
PlanesOf(const SingleImageSettings & settings, const FrameGeometry & frame)
{
  std::vector<MeasuredPlane> planes(settings.bayerPattern ? BayerPlanes.size() : 1);
  planes.front().layout = PixelLayout::OfFrames(frame);
  planes.front().geometry = frame;
  for (std::size_t k = 0; k < planes.size() && settings.bayerPattern; ++k)
  {
    const auto corner = CornerOf(*settings.bayerPattern, BayerPlanes[k]);
    planes[k].geometry = { frame.width / 2, frame.height / 2, frame.shutterAxis };
    planes[k].layout = { corner[1] * frame.width + corner[0], 2, 2 * frame.width, frame.Pixels(), frame.width / 2 };
  }
  return planes;
}

/** Counts the masked pixels of a plane, and the other pixels that are not finite or at a clip level. */
template <typename TPixel>
void
CountPixels(const PlaneOfFrame<TPixel> & pixels, MeasuredPlane & plane, const ParallelFor & parallelFor)
{
  const std::size_t width = plane.geometry.width;
  const ClipLevels  clip = LimitsOf(plane.dnRange).clip;
  const auto        counts =
    SumBlocks<3>(plane.geometry.height, parallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
      for (std::size_t y = begin; y < end; ++y)
      {
        std::array<std::size_t, 3> ofRow{}; // whole numbers, which the compiler counts several at a time
        for (std::size_t x = 0; x < width; ++x)
        {
          const std::size_t p = pixels.layout.At(x, y);
          const auto        value = static_cast<double>(pixels.pixels[p]);
          const bool        isMasked = pixels.mask != nullptr && pixels.mask[p] == 0;
          const bool        isFinite = std::isfinite(value);
          const bool        isClipped = (value <= clip.lowDn) | (value >= clip.highDn);
          ofRow[0] += static_cast<std::size_t>(!isMasked & isFinite & isClipped);
          ofRow[1] += static_cast<std::size_t>(!isMasked & !isFinite);
          ofRow[2] += static_cast<std::size_t>(isMasked);
        }
        std::transform(ofRow.begin(), ofRow.end(), sums.begin(), sums.begin(), [](std::size_t count, double sum) {
          return sum + static_cast<double>(count);
        });
      }
    });
  plane.clipped = static_cast<std::size_t>(counts[0]);
  plane.notFinite = static_cast<std::size_t>(counts[1]);
  plane.masked = static_cast<std::size_t>(counts[2]);
}

/** The line of the mean image of \a frames frames, times their number. Level sets within three standard deviations of a
 * clip level are left out: their frames are clipped, and their mean is not. */
std::optional<NoiseLine>
LineOfMean(const PlaneOfFrame<double> & mean,
           const NoiseLine &            ofFrames,
           const LevelLimits &          limits,
           double                       frames,
           const ParallelFor &          parallelFor)
{
  ImageNoise noise = MeasureFrame(mean, LevelLimits{}, parallelFor);
  for (LevelSet & set : noise.diagonal)
  {
    constexpr double farFromClip = 3.0;
    const double     margin = farFromClip * std::sqrt(std::max(0.0, ofFrames.line.At(set.levelDn)));
    const bool       isFar = set.levelDn - limits.clip.lowDn > margin && limits.clip.highDn - set.levelDn > margin;
    set.details = isFar ? set.details : 0.0;
  }
  constexpr double least = 1e-300; // above 0
  NoiseLine        line = FitNoiseLine(noise.diagonal, ClipLevels{}, least, noise.line.line);
  line.line.slopeDn *= frames;
  line.line.atCentreDn2 *= frames;
  line.slopeVariance *= frames * frames;
  line.centreVariance *= frames * frames;
  line.slopeCovariance *= frames * frames;
  return line;
}
} // namespace

void
SingleImageSettings::Validate() const
{
  ValidateDnSettings(dnSettings);
  ValidateExcessNoiseFactor(excessNoiseFactor);
}

template <typename TPixel>
struct SingleImageMethod<TPixel>::Planes
{
  SingleImageSettings        settings;
  FrameGeometry              frame;
  std::size_t                frames{ 0 };
  std::vector<std::uint8_t>  mask;
  ParallelFor                parallelFor;
  std::vector<MeasuredPlane> planes;
  std::vector<double>        sum; ///< sum of the frames [DN]; empty: there is one frame
  std::size_t                added{ 0 };
  std::vector<Report>        reports;

  template <typename TValue>
  PlaneOfFrame<TValue>
  PixelsOf(const MeasuredPlane & plane, const TValue * pixels) const
  {
    return { pixels, plane.layout, plane.geometry.height, mask.empty() ? nullptr : mask.data() };
  }

  void
  AddFrame(const TPixel * pixels)
  {
    for (MeasuredPlane & plane : planes)
    {
      const PlaneOfFrame<TPixel> ofPlane = this->PixelsOf(plane, pixels);
      try
      {
        if (added == 0 || !plane.reason.empty())
        {
          plane.dnRange = FindDnRangeOfFrame(ofPlane, settings.dnSettings, parallelFor);
          plane.reason.clear();
          CountPixels(ofPlane, plane, parallelFor);
        }
        plane.frames.emplace_back(MeasureFrame(ofPlane, LimitsOf(plane.dnRange), parallelFor));
      }
      catch (const NothingToMeasure & reason)
      {
        plane.frames.emplace_back(std::nullopt);
        plane.reason =
          std::none_of(plane.frames.begin(), plane.frames.end(), [](const auto & f) { return f.has_value(); })
            ? reason.what()
            : "";
      }
    }
    ForPixels(sum.size(), parallelFor, [&](std::size_t p) { sum[p] += static_cast<double>(pixels[p]); });
    ++added;
  }

  void
  Finish()
  {
    const auto count = static_cast<double>(frames);
    ForPixels(sum.size(), parallelFor, [&](std::size_t p) { sum[p] /= count; });
    for (MeasuredPlane & plane : planes)
    {
      SingleImageFindings found{ settings,     plane.geometry, plane.dnRange,   std::move(plane.frames),
                                 std::nullopt, plane.clipped,  plane.notFinite, plane.masked,
                                 plane.reason };
      const LevelLimits   limits = LimitsOf(plane.dnRange);
      if (const NoiseLine line = FitAllFrames(found.frames, limits); !sum.empty() && line.isDetermined)
      {
        try
        {
          found.meanImage = LineOfMean(this->PixelsOf(plane, sum.data()), line, limits, count, parallelFor);
        }
        catch (const NothingToMeasure &)
        {
          found.meanImage.reset(); // the frames have their own line
        }
      }
      reports.push_back(MakeSingleImageReport(found));
      NoteMask(reports.back(), frame, mask);
    }
    sum.clear();
    sum.shrink_to_fit();
  }
};

template <typename TPixel>
SingleImageMethod<TPixel>::SingleImageMethod(const SingleImageSettings &       settings,
                                             const FrameGeometry &             geometry,
                                             std::size_t                       frames,
                                             const std::vector<std::uint8_t> & mask,
                                             ParallelFor                       parallelFor)
{
  settings.Validate();
  if (frames == 0)
  {
    throw std::invalid_argument("the stack has no frame; expected at least 1");
  }
  if (!mask.empty() && mask.size() != geometry.Pixels())
  {
    throw std::invalid_argument("the mask has " + std::to_string(mask.size()) + " pixels, but a frame has " +
                                std::to_string(geometry.Pixels()) + "; expected a mask of the frame's size");
  }
  m_Planes = std::make_unique<Planes>(
    Planes{ settings, geometry, frames, mask, std::move(parallelFor), PlanesOf(settings, geometry), {}, 0, {} });
  m_Planes->sum.resize(frames > 1 ? geometry.Pixels() : 0);
}

template <typename TPixel>
SingleImageMethod<TPixel>::SingleImageMethod(SingleImageMethod && other) noexcept = default;

template <typename TPixel>
SingleImageMethod<TPixel> &
SingleImageMethod<TPixel>::operator=(SingleImageMethod && other) noexcept = default;

template <typename TPixel>
SingleImageMethod<TPixel>::~SingleImageMethod() = default;

template <typename TPixel>
void
SingleImageMethod<TPixel>::AddFrames(const TPixel * frames, std::size_t count)
{
  if (count > m_Planes->frames - m_Planes->added)
  {
    throw std::logic_error(std::to_string(count) + " frames were added after " + std::to_string(m_Planes->added) +
                           " of " + std::to_string(m_Planes->frames));
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    m_Planes->AddFrame(frames + k * m_Planes->frame.Pixels());
  }
  if (this->IsDone() && m_Planes->reports.empty())
  {
    m_Planes->Finish();
  }
}

template <typename TPixel>
bool
SingleImageMethod<TPixel>::IsDone() const
{
  return m_Planes->added == m_Planes->frames;
}

template <typename TPixel>
std::vector<Report>
SingleImageMethod<TPixel>::GetReports() const
{
  if (!this->IsDone())
  {
    throw std::logic_error("only " + std::to_string(m_Planes->added) + " of " + std::to_string(m_Planes->frames) +
                           " frames have been added; the report is of all");
  }
  return m_Planes->reports;
}

#define SensorNoise_INSTANTIATE(TPixel) template class SingleImageMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
