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
#ifndef sensornoise_published_FlickerSums_h
#define sensornoise_published_FlickerSums_h

#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/published/IsoIntensitySet.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class FlickerSums
 * \brief Sums of each frame over the bright and the dark set, all that flicker and offset are estimated from.
 *
 * Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035. For every frame t, with v = u / ubar (3.2) and the weights
 * of Remark 1:
 * - v^*(t), (3.8), and v_*(t), (3.14), with the spread of the pixels about them;
 * - if asked for, the sum of w v over the line set in each line y, for (3.28).
 *
 * Frames are independent: each is added once, whole, by one thread, so that chunks and threads change no bit.
 * Memory: 32 bytes a frame, 8 bytes a frame and line, plus the sets.
 */
class FlickerSums
{
public:
  /** \a mean is the frame-sized map of temporal means [DN]. Without a \a lineSet there are no sums by line. */
  FlickerSums(const IsoIntensitySet & bright,
              const IsoIntensitySet & dark,
              const double *          mean,
              const FrameGeometry &   geometry,
              std::size_t             frames,
              const IsoIntensitySet & lineSet = {})
    : m_Frames(frames)
    , m_Lines(lineSet.pixels.empty() ? 0 : geometry.Rows())
    , m_BrightRatios(frames, 0.0)
    , m_DarkResiduals(frames, 0.0)
    , m_BrightSpreads(frames, 0.0)
    , m_DarkSpreads(frames, 0.0)
    , m_LineSums(frames * m_Lines, 0.0)
    , m_LineWeights(m_Lines, 0.0)
    , m_Bright(bright, mean)
    , m_Dark(dark, mean)
    , m_LineSet(lineSet, mean)
  {
    for (std::size_t i = 0; i < lineSet.pixels.size(); ++i)
    {
      m_LineOf.push_back(static_cast<std::uint32_t>(geometry.RowOf(lineSet.pixels[i])));
      m_LineWeights[m_LineOf[i]] += lineSet.weights[i];
    }
  }

  /** Adds frame \a t. Different frames may be added at the same time. */
  template <typename TPixel>
  void
  AddFrame(const TPixel * frame, std::size_t t)
  {
    const auto ratio = [](double u, double mean) { return u / mean; };
    m_Bright.Average(frame, ratio, m_BrightRatios[t], m_BrightSpreads[t]);
    const double brightness = m_BrightRatios[t];
    const auto   residual = [brightness](double u, double mean) { return u - brightness * mean; };
    m_Dark.Average(frame, residual, m_DarkResiduals[t], m_DarkSpreads[t]);

    double * const lines = m_LineSums.data() + t * m_Lines;
    for (std::size_t i = 0; i < m_LineSet.pixels.size(); ++i)
    {
      lines[m_LineOf[i]] +=
        m_LineSet.weights[i] * ratio(static_cast<double>(frame[m_LineSet.pixels[i]]), m_LineSet.means[i]);
    }
  }

  std::size_t
  GetNumberOfFrames() const
  {
    return m_Frames;
  }

  /** v^*(t), (3.8): the mean of u / ubar over S^*. */
  double
  GetBrightRatio(std::size_t t) const
  {
    return m_BrightRatios[t];
  }

  /** v_*(t), (3.14): the mean of u - v^*(t) ubar over S_* [DN]. */
  double
  GetDarkResidualDn(std::size_t t) const
  {
    return m_DarkResiduals[t];
  }

  /** Variance that pixel noise gives to v^*(t) [1], and to v_*(t) with v^*(t) held [DN^2].
   *
   * From the spread of the pixels within each frame, which flicker, being common to them, does not touch. */
  double
  GetBrightRatioNoise() const
  {
    return m_Bright.NoiseOfAverage(m_BrightSpreads);
  }
  double
  GetDarkResidualNoiseDn2() const
  {
    return m_Dark.NoiseOfAverage(m_DarkSpreads);
  }

  /** 0 without a line set. */
  std::size_t
  GetNumberOfLines() const
  {
    return m_Lines;
  }

  /** Sum of the weights of the line set in \a line; over all lines it is 1. */
  double
  GetLineWeight(std::size_t line) const
  {
    return m_LineWeights[line];
  }

  /** Sum of w v over the line set in \a line of frame \a t. */
  double
  GetLineSum(std::size_t t, std::size_t line) const
  {
    return m_LineSums[t * m_Lines + line];
  }

private:
  /** A set with the means of its pixels. */
  struct WeightedPixels
  {
    WeightedPixels(const IsoIntensitySet & set, const double * mean)
      : pixels(set.pixels)
      , weights(set.weights)
      , effectivePixels(set.EffectivePixels())
    {
      for (const std::uint32_t p : pixels)
      {
        means.push_back(mean[p]);
      }
    }

    /** Weighted average and variance over the set of \a value(u, mean). */
    template <typename TPixel, typename TValue>
    void
    Average(const TPixel * frame, TValue value, double & average, double & spread) const
    {
      average = 0.0;
      double squares = 0.0;
      for (std::size_t i = 0; i < pixels.size(); ++i)
      {
        const double v = value(static_cast<double>(frame[pixels[i]]), means[i]);
        average += weights[i] * v;
        squares += weights[i] * v * v;
      }
      spread = squares - average * average;
    }

    /** With q = sum w^2 the spread has the expectation (1 - q) N, and the average the variance q N. */
    double
    NoiseOfAverage(const std::vector<double> & spreads) const
    {
      double sum = 0.0;
      for (const double spread : spreads)
      {
        sum += spread;
      }
      return std::max(0.0, sum / static_cast<double>(spreads.size()) / (effectivePixels - 1.0));
    }

    std::vector<std::uint32_t> pixels;
    std::vector<double>        weights;
    std::vector<double>        means;
    double                     effectivePixels;
  };

  std::size_t                m_Frames;
  std::size_t                m_Lines;
  std::vector<double>        m_BrightRatios;
  std::vector<double>        m_DarkResiduals;
  std::vector<double>        m_BrightSpreads;
  std::vector<double>        m_DarkSpreads;
  std::vector<double>        m_LineSums;
  std::vector<double>        m_LineWeights;
  WeightedPixels             m_Bright;
  WeightedPixels             m_Dark;
  WeightedPixels             m_LineSet;
  std::vector<std::uint32_t> m_LineOf; // of each pixel of the line set
};

} // namespace sensornoise

#endif
