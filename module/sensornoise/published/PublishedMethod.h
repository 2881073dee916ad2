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
#ifndef sensornoise_published_PublishedMethod_h
#define sensornoise_published_PublishedMethod_h

#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/moments/StackMaps.h"
#include "sensornoise/moments/TemporalMoments.h"
#include "sensornoise/published/CorrectedVariance.h"
#include "sensornoise/published/FlickerEstimate.h"
#include "sensornoise/published/FlickerSums.h"
#include "sensornoise/published/IsoIntensitySet.h"
#include "sensornoise/published/PublishedReport.h"
#include "sensornoise/published/PublishedSettings.h"
#include "sensornoise/published/VibrationMask.h"
#include "sensornoise/report/Report.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class PublishedMethod
 * \brief The algorithm of Figure 2 of Sur & Gredi\'ac 2015 in three passes over the stack.
 *
 * https://doi.org/10.1137/140977035. Pass 1 gathers the temporal moments, which give mean, variance, clip levels, the
 * vibration mask and the iso-intensity sets; pass 2 each frame's sums over the sets, which give flicker and offset;
 * pass 3 the sums of the corrected variance, which gives gain and intercept. Usage:
 *
 *     PublishedMethod<unsigned short> method(settings, geometry, frames);
 *     for (pass = 0; pass < NumberOfPasses; ++pass) { for (each chunk, in order) method.AddFrames(chunk, n);
 * method.EndPass(); } method.GetReport();
 *
 * Same bits for any number of threads and any chunks. Memory: about 70 bytes a pixel, 8 bytes a frame and line.
 * A stack that cannot be measured ends in a report whose quantities are `failed`, with a warning that says why; wrong
 * use throws std::invalid_argument.
 */
template <typename TPixel>
class PublishedMethod
{
public:
  static constexpr unsigned int NumberOfPasses = 3;
  static constexpr std::size_t  MinimumFrames = 5;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work. */
  PublishedMethod(const PublishedSettings &         settings,
                  const FrameGeometry &             geometry,
                  std::size_t                       frames,
                  const std::vector<std::uint8_t> & mask = {},
                  ParallelFor                       parallelFor = SerialFor)
    : m_Settings(settings)
    , m_Geometry(geometry)
    , m_Frames(frames)
    , m_UserMask(mask)
    , m_ParallelFor(std::move(parallelFor))
    , m_Moments(geometry.Pixels())
  {
    if (frames < MinimumFrames)
    {
      throw std::invalid_argument("the stack has " + std::to_string(frames) + " frames; expected at least " +
                                  std::to_string(MinimumFrames));
    }
    if (geometry.width < 3 || geometry.height < 3)
    {
      throw std::invalid_argument("the frames have " + std::to_string(geometry.width) + " x " +
                                  std::to_string(geometry.height) + " pixels; expected at least 3 x 3");
    }
    if (!mask.empty() && mask.size() != geometry.Pixels())
    {
      throw std::invalid_argument("the mask has " + std::to_string(mask.size()) + " pixels, but the frames have " +
                                  std::to_string(geometry.Pixels()));
    }
    settings.Validate();
  }

  /** Adds the next \a frames frames of the current pass, stored one after the other. */
  void
  AddFrames(const TPixel * chunk, std::size_t frames)
  {
    const std::size_t pixels = m_Geometry.Pixels();
    const std::size_t width = m_Geometry.width;
    if (frames > m_Frames - m_FramesInPass)
    {
      throw std::logic_error("pass " + std::to_string(m_Pass + 1) + " was given " +
                             std::to_string(m_FramesInPass + frames) + " frames; expected " + std::to_string(m_Frames));
    }
    if (m_Pass == 0)
    {
      m_ParallelFor(m_Geometry.height,
                    [&](std::size_t y) { m_Moments.AddFrames(chunk, pixels, frames, y * width, (y + 1) * width); });
      m_Moments.AdvanceFrames(frames);
    }
    else if (m_Pass == 1 && m_Sums)
    {
      m_ParallelFor(frames, [&](std::size_t k) { m_Sums->AddFrame(chunk + k * pixels, m_FramesInPass + k); });
    }
    else if (m_Pass == 2 && m_Correction)
    {
      m_ParallelFor(m_Geometry.height,
                    [&](std::size_t y) { m_Correction->AddRow(chunk, pixels, frames, m_FramesInPass, y); });
    }
    m_FramesInPass += frames;
  }

  /** Ends the current pass. */
  void
  EndPass()
  {
    if (m_FramesInPass != m_Frames)
    {
      throw std::logic_error("pass " + std::to_string(m_Pass + 1) + " held " + std::to_string(m_FramesInPass) +
                             " frames; expected " + std::to_string(m_Frames));
    }
    m_FramesInPass = 0;
    switch (m_Pass++)
    {
      case 0:
        this->EndMoments();
        break;
      case 1:
        if (m_Sums)
        {
          m_Flicker = EstimateFlicker(*m_Sums, m_Bright, m_Dark, m_Settings.rollingShutter, m_Settings.sigmaLines);
          m_Correction = std::make_unique<CorrectedVariance>(m_Flicker, m_Geometry, m_Frames);
        }
        break;
      default:
        this->EndCorrection();
    }
  }

  const Report &
  GetReport() const
  {
    return m_Report;
  }
  const std::vector<double> &
  GetMean() const
  {
    return m_Mean;
  }
  const std::vector<double> &
  GetVariance() const
  {
    return m_Variance;
  }
  /** NaN where the flicker is not known; empty if the stack cannot be measured. */
  const std::vector<double> &
  GetCorrectedVariance() const
  {
    return m_CorrectedVariance;
  }
  /** Values of PixelUse. */
  const std::vector<std::uint8_t> &
  GetPixelUse() const
  {
    return m_PixelUse;
  }

private:
  void
  EndMoments()
  {
    const std::size_t pixels = m_Geometry.Pixels();
    m_Mean.resize(pixels);
    m_Variance.resize(pixels);
    m_Valid.resize(pixels);
    m_Summary = MakeStackMaps<TPixel>(
      m_Moments, m_Settings.codes, m_ParallelFor, m_Mean.data(), m_Variance.data(), m_Valid.data());
    for (std::size_t p = 0; p < m_UserMask.size(); ++p)
    {
      m_Valid[p] = m_UserMask[p] != 0 ? m_Valid[p] : 0;
    }
    m_Kept = VibrationMask(m_Mean.data(),
                           m_Variance.data(),
                           m_Valid.data(),
                           m_Geometry.width,
                           m_Geometry.height,
                           m_Frames,
                           m_Settings.level);
    m_Moments = TemporalMoments<TPixel>(0);
    m_PixelUse.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      m_PixelUse[p] = static_cast<std::uint8_t>(this->UseOf(p));
    }
    try
    {
      const IsoIntensitySetFinder finder(m_Mean.data(), m_Variance.data(), m_Kept.data(), pixels, m_Frames);
      m_Bright = finder.Find(m_Settings.brightQuantile);
      m_Dark = finder.Find(m_Settings.darkQuantile);
      const bool byLine = m_Settings.rollingShutter != RollingShutter::Off;
      m_Sums = std::make_unique<FlickerSums>(m_Bright,
                                             m_Dark,
                                             m_Mean.data(),
                                             m_Geometry,
                                             m_Frames,
                                             byLine ? finder.FindLineSet(m_Bright) : IsoIntensitySet());
    }
    catch (const std::runtime_error & error)
    {
      m_Failure = error.what();
    }
  }

  PixelUse
  UseOf(std::size_t p) const
  {
    const std::size_t x = p % m_Geometry.width;
    const std::size_t y = p / m_Geometry.width;
    if (!m_UserMask.empty() && m_UserMask[p] == 0)
    {
      return PixelUse::Masked;
    }
    if (m_Valid[p] == 0)
    {
      return std::isfinite(m_Variance[p]) ? PixelUse::Clipped : PixelUse::NotFinite;
    }
    if (x == 0 || y == 0 || x + 1 == m_Geometry.width || y + 1 == m_Geometry.height)
    {
      return PixelUse::Border;
    }
    if (m_Kept[p] != 0)
    {
      return PixelUse::Used;
    }
    return m_Variance[p] > 0.0 ? PixelUse::Vibration : PixelUse::Constant;
  }

  void
  EndCorrection()
  {
    if (m_Correction)
    {
      const double dof = static_cast<double>(m_Frames - 1);
      m_CorrectedVariance.resize(m_Geometry.Pixels());
      m_ParallelFor(m_Geometry.height, [&](std::size_t y) {
        for (std::size_t p = y * m_Geometry.width; p < (y + 1) * m_Geometry.width; ++p)
        {
          m_CorrectedVariance[p] = m_Correction->GetVariance(p, m_Mean[p], m_Variance[p] * dof);
          if (m_Kept[p] != 0 && !std::isfinite(m_CorrectedVariance[p]))
          {
            m_PixelUse[p] = static_cast<std::uint8_t>(PixelUse::FlickerUnknown);
          }
        }
      });
    }
    m_Report = MakePublishedReport({ m_Settings,
                                     m_Geometry,
                                     m_Frames,
                                     m_Summary,
                                     m_Mean,
                                     m_Variance,
                                     m_CorrectedVariance,
                                     m_Valid,
                                     m_Kept,
                                     m_PixelUse,
                                     m_Bright,
                                     m_Dark,
                                     m_Flicker,
                                     m_Failure });
  }

  PublishedSettings         m_Settings;
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  std::vector<std::uint8_t> m_UserMask;
  ParallelFor               m_ParallelFor;
  unsigned int              m_Pass{ 0 };
  std::size_t               m_FramesInPass{ 0 };

  TemporalMoments<TPixel>            m_Moments;
  StackSummary                       m_Summary;
  std::vector<double>                m_Mean;
  std::vector<double>                m_Variance;
  std::vector<std::uint8_t>          m_Valid;
  std::vector<std::uint8_t>          m_Kept;
  std::vector<std::uint8_t>          m_PixelUse;
  IsoIntensitySet                    m_Bright;
  IsoIntensitySet                    m_Dark;
  std::unique_ptr<FlickerSums>       m_Sums;
  FlickerEstimate                    m_Flicker;
  std::unique_ptr<CorrectedVariance> m_Correction;
  std::vector<double>                m_CorrectedVariance;
  std::string                        m_Failure;
  Report                             m_Report;
};

} // namespace sensornoise

#endif
