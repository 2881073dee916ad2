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
#ifndef SensorNoiseFlickerSums_h
#define SensorNoiseFlickerSums_h

#include "SensorNoiseIsoIntensitySet.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Size of a frame and the axis along which its lines are exposed one after the other. */
struct FrameGeometry
{
  std::size_t  width{ 0 };
  std::size_t  height{ 0 };
  unsigned int shutterAxis{ 1 }; ///< 1: lines are rows, the shutter travels along y; 0: columns, along x

  std::size_t
  Pixels() const
  {
    return width * height;
  }
  std::size_t
  Lines() const
  {
    return shutterAxis == 0 ? width : height;
  }
  std::size_t
  LineOf(std::size_t p) const
  {
    return shutterAxis == 0 ? p % width : p / width;
  }
};

/** \class FlickerSums
 * \brief Sums of each frame over the bright and the dark set, all that flicker and offset are estimated from.
 *
 * Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035. For every frame t and line y (or for whole frames):
 * - bright: sum of w v over S^* in the line, with v = u / ubar (3.2) and the weights of Remark 1, for (3.8) and (3.28);
 * - dark: sum of w u over S_*, for (3.14).
 *
 * Frames are independent: each is added once, whole, by one thread, so that chunks and threads change no bit.
 * Memory: 8 bytes a frame and line, plus the sets.
 */
class FlickerSums
{
public:
  /** \a mean is the frame-sized map of temporal means [DN]. With \a byLine false the sums are over whole frames. */
  FlickerSums(const IsoIntensitySet & bright,
              const IsoIntensitySet & dark,
              const double *          mean,
              const FrameGeometry &   geometry,
              std::size_t             frames,
              bool                    byLine)
    : m_Frames(frames)
    , m_Lines(byLine ? geometry.Lines() : 1)
    , m_Bright(frames * m_Lines, 0.0)
    , m_Dark(frames, 0.0)
    , m_LineWeights(m_Lines, 0.0)
    , m_DarkPixels(dark.pixels)
    , m_DarkWeights(dark.weights)
    , m_BrightPixels(bright.pixels)
  {
    for (std::size_t i = 0; i < bright.pixels.size(); ++i)
    {
      const std::size_t line = byLine ? geometry.LineOf(bright.pixels[i]) : 0;
      m_BrightLines.push_back(static_cast<std::uint32_t>(line));
      m_BrightWeights.push_back(bright.weights[i] / mean[bright.pixels[i]]);
      m_LineWeights[line] += bright.weights[i];
    }
    for (std::size_t i = 0; i < dark.pixels.size(); ++i)
    {
      m_DarkMeanDn += dark.weights[i] * mean[dark.pixels[i]];
    }
  }

  /** Adds frame \a t. Different frames may be added at the same time. */
  template <typename TPixel>
  void
  AddFrame(const TPixel * frame, std::size_t t)
  {
    double * const bright = m_Bright.data() + t * m_Lines;
    for (std::size_t i = 0; i < m_BrightPixels.size(); ++i)
    {
      bright[m_BrightLines[i]] += m_BrightWeights[i] * static_cast<double>(frame[m_BrightPixels[i]]);
    }
    double dark = 0.0;
    for (std::size_t i = 0; i < m_DarkPixels.size(); ++i)
    {
      dark += m_DarkWeights[i] * static_cast<double>(frame[m_DarkPixels[i]]);
    }
    m_Dark[t] = dark;
  }

  std::size_t
  GetNumberOfFrames() const
  {
    return m_Frames;
  }
  std::size_t
  GetNumberOfLines() const
  {
    return m_Lines;
  }

  /** Sum of the weights of S^* in \a line; over all lines it is 1. */
  double
  GetLineWeight(std::size_t line) const
  {
    return m_LineWeights[line];
  }

  /** Sum of w v over S^* in \a line of frame \a t. */
  double
  GetBright(std::size_t t, std::size_t line) const
  {
    return m_Bright[t * m_Lines + line];
  }

  /** v^*(t), (3.8): the mean of u / ubar over S^*. */
  double
  GetBrightRatio(std::size_t t) const
  {
    double sum = 0.0;
    for (std::size_t line = 0; line < m_Lines; ++line)
    {
      sum += this->GetBright(t, line);
    }
    return sum;
  }

  /** v_*(t), (3.14): the mean of u - v^*(t) ubar over S_* [DN]. */
  double
  GetDarkResidualDn(std::size_t t) const
  {
    return m_Dark[t] - this->GetBrightRatio(t) * m_DarkMeanDn;
  }

private:
  std::size_t                m_Frames;
  std::size_t                m_Lines;
  std::vector<double>        m_Bright;
  std::vector<double>        m_Dark;
  std::vector<double>        m_LineWeights;
  double                     m_DarkMeanDn{ 0.0 };
  std::vector<std::uint32_t> m_DarkPixels;
  std::vector<double>        m_DarkWeights;
  std::vector<std::uint32_t> m_BrightPixels;
  std::vector<std::uint32_t> m_BrightLines;
  std::vector<double>        m_BrightWeights;
};

} // namespace sensornoise

#endif
