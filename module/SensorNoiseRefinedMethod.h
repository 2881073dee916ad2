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
#ifndef SensorNoiseRefinedMethod_h
#define SensorNoiseRefinedMethod_h

#include "SensorNoiseGuardBand.h"
#include "SensorNoiseRefinedReport.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

/** \class RefinedMethod
 * \brief Gain, offset and read noise at the theoretical limit, in three passes over the stack.
 *
 * Pass 1 gathers the temporal moments: the mean image, a rough noise model, what is clipped. Pass 2 regresses every
 * frame on the mean image and its derivatives: the series over time of flicker, local light and motion, and the
 * offset. Pass 3 projects every pixel's time series on these few series; what is left is sensor noise, whose
 * regression on the mean gives gain and intercept. Usage as PublishedMethod.
 *
 * Same bits for any number of threads and any chunks. Memory: about 90 bytes a pixel and 8 more a series (4 to 20), 20
 * kB a frame. A stack that cannot be measured ends in a report whose quantities are `failed`, with a warning that says
 * why; wrong use throws std::invalid_argument. */
template <typename TPixel>
class RefinedMethod
{
public:
  static constexpr unsigned int NumberOfPasses = 3;
  static constexpr std::size_t  MinimumFrames = 5;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work. */
  RefinedMethod(const RefinedSettings &           settings,
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
    , m_FrameMeans(frames, 0.0)
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
    if (frames > m_Frames - m_FramesInPass)
    {
      throw std::logic_error("pass " + std::to_string(m_Pass + 1) + " was given " +
                             std::to_string(m_FramesInPass + frames) + " frames; expected " + std::to_string(m_Frames));
    }
    if (m_Pass == 0)
    {
      ForBlocks(pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end) {
        m_Moments.AddFrames(chunk, pixels, frames, begin, end);
      });
      m_Moments.AdvanceFrames(frames);
      m_ParallelFor(frames, [&](std::size_t k) {
        double sum = 0.0;
        for (std::size_t p = k * pixels; p < (k + 1) * pixels; ++p)
        {
          sum += std::isfinite(static_cast<double>(chunk[p])) ? static_cast<double>(chunk[p]) : 0.0;
        }
        m_FrameMeans[m_FramesInPass + k] = sum / static_cast<double>(pixels);
      });
    }
    else if (m_Pass == 1 && m_FrameSums)
    {
      m_FrameSums->AddFrames(chunk, m_FramesInPass, frames, m_ParallelFor);
    }
    else if (m_Pass == 2 && m_FrameSums)
    {
      ForBlocks(pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end) {
        m_Projections.AddFrames(m_Basis, chunk, m_FramesInPass, frames, begin, end);
      });
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
    const unsigned int pass = m_Pass++;
    try
    {
      if (pass == 0)
      {
        this->EndMoments();
      }
      else if (m_FrameSums)
      {
        pass == 1 ? this->EndFrameSums() : this->EndProjections();
      }
    }
    catch (const std::runtime_error & error)
    {
      this->Fail("nothing-to-measure", error.what());
    }
    if (pass + 1 == NumberOfPasses)
    {
      m_Report = MakeRefinedReport({ m_Settings,
                                     m_Geometry,
                                     m_Frames,
                                     m_Summary,
                                     m_Mean,
                                     m_Variance,
                                     m_CorrectedVariance,
                                     m_Valid,
                                     m_PixelUse,
                                     m_Found });
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
  /** NaN where it was not computed; empty if the stack cannot be measured. */
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
  Fail(std::string code, std::string message)
  {
    m_Found.failureCode = std::move(code);
    m_Found.failure = std::move(message);
    m_FrameSums.reset();
  }

  void
  EndMoments()
  {
    const std::size_t pixels = m_Geometry.Pixels();
    m_Mean.resize(pixels);
    m_Variance.resize(pixels);
    m_Valid.resize(pixels);
    m_Summary = MakeStackMaps<TPixel>(
      m_Moments, m_Settings.codes, m_ParallelFor, m_Mean.data(), m_Variance.data(), m_Valid.data());
    m_Moments = TemporalMoments<TPixel>(0);
    m_Reference = MakeReferenceFrame(m_Mean, m_Variance, m_Valid, m_Geometry, m_Frames, m_ParallelFor);
    m_PixelUse.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const bool isMasked = !m_UserMask.empty() && m_UserMask[p] == 0;
      m_PixelUse[p] = static_cast<std::uint8_t>(isMasked ? PixelUse::Masked : this->UseOf(p));
      m_Valid[p] = isMasked ? 0 : m_Valid[p];
      m_Reference.usable[p] = isMasked ? 0 : m_Reference.usable[p];
    }
    m_Found.model = FitProvisionalModel(m_Reference);
    m_Found.centreDn = m_Found.model.averageDn;
    this->LeaveOutCoarseAndGuarded();
    if (!m_Found.failure.empty())
    {
      return;
    }
    std::vector<std::uint8_t> take = m_Reference.usable;
    const auto                unexplained = FindUnexplained(m_Reference, m_Found.model, m_ParallelFor);
    std::vector<double>       smoothWeight(pixels);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      take[p] = unexplained[p] != 0 ? 0 : take[p];
      smoothWeight[p] = m_Found.model.NoiseVariance(m_Reference.neighbourMean[p]);
    }
    // Smooth, or the instruments' weights would bring short wavelengths back.
    constexpr std::size_t radius = 8;
    smoothWeight = BoxSum(smoothWeight, m_Geometry.width, m_Geometry.height, radius, m_ParallelFor);
    for (double & weight : smoothWeight)
    {
      weight = std::pow(2.0 * radius + 1.0, 2) / weight;
    }
    m_FrameSums = std::make_unique<FrameSums>(m_Reference,
                                              m_Found.model,
                                              take,
                                              SmoothedDerivative(m_Reference, StencilX, m_ParallelFor),
                                              SmoothedDerivative(m_Reference, StencilY, m_ParallelFor),
                                              std::move(smoothWeight));
  }

  PixelUse
  UseOf(std::size_t p) const
  {
    if (m_Reference.usable[p] != 0)
    {
      return PixelUse::Used;
    }
    if (m_Valid[p] == 0)
    {
      return std::isfinite(m_Variance[p]) ? PixelUse::Clipped : PixelUse::NotFinite;
    }
    if (!(m_Variance[p] > 0.0))
    {
      return PixelUse::Constant;
    }
    const std::size_t x = p % m_Geometry.width;
    const std::size_t y = p / m_Geometry.width;
    const bool        isInner = x >= StencilMargin && x + StencilMargin < m_Geometry.width && y >= StencilMargin &&
                         y + StencilMargin < m_Geometry.height;
    return isInner ? PixelUse::NearClip : PixelUse::Border;
  }

  void
  LeaveOutCoarseAndGuarded()
  {
    const ProvisionalModel & model = m_Found.model;
    const double             step = m_Summary.codes.quantisationStepDn;
    const auto               usable =
      static_cast<double>(std::count(m_Reference.usable.begin(), m_Reference.usable.end(), std::uint8_t{ 1 }));
    // The brightness of a frame relative to the average, from its mean or from the model of the variance.
    const double average =
      std::accumulate(m_FrameMeans.begin(), m_FrameMeans.end(), 0.0) / static_cast<double>(m_Frames);
    const double flux = std::max(1e-3, model.averageDn - model.darkestDn);
    const auto [lowest, highest] = std::minmax_element(m_FrameMeans.begin(), m_FrameMeans.end());
    const double typical = 1.5 * std::sqrt(model.flickerVariance);
    const double brightest = std::max((*highest - average) / flux, typical);
    const double darkest = std::max(-1.0, std::min((*lowest - average) / flux, -typical));
    const auto   guarded = FindGuardBand(m_Reference, model, m_Summary.codes, brightest, darkest, m_ParallelFor);
    for (std::size_t p = 0; p < guarded.size(); ++p)
    {
      if (m_Reference.usable[p] != 0)
      {
        const bool isCoarse = step > 0.0 && model.NoiseVariance(m_Reference.neighbourMean[p]) < 0.25 * step * step;
        if (isCoarse || guarded[p] != 0)
        {
          m_PixelUse[p] = static_cast<std::uint8_t>(isCoarse ? PixelUse::CoarseCodes : PixelUse::NearClip);
          m_Reference.usable[p] = 0;
          ++(isCoarse ? m_Found.coarse : m_Found.nearClip);
        }
      }
    }
    if (static_cast<double>(m_Found.coarse) > 0.02 * usable)
    {
      this->Fail("codes-too-coarse",
                 "the noise of " + detail::Text(100.0 * static_cast<double>(m_Found.coarse) / usable) +
                   " % of the pixels, the darkest, is below half a code step of " + detail::Text(step) +
                   " DN, where the codes hide it: use more bits, or a higher analogue gain");
    }
  }

  void
  EndFrameSums()
  {
    RegressorNoise noise; // w V = 1 with the model's own variance
    for (std::size_t p = 0; p < m_Mean.size(); ++p)
    {
      if (m_FrameSums->ClassOf(p) != FrameSums::Unused)
      {
        noise.variance[m_FrameSums->ClassOf(p)] += 1.0;
      }
    }
    const std::optional<OffsetLine> line = FitOffsetLine(*m_FrameSums, noise);
    if (!line)
    {
      throw std::runtime_error("the pixels have one intensity; expected dark and bright areas");
    }
    m_Found.line = *line;
    const FrameEquations equations = MakeFrameEquations(*m_FrameSums, noise, GradientClasses - 1);
    const bool           isKnown = line->flickerZ > RequiredFlickerZ && std::isfinite(line->low);
    m_OffsetInUse = isKnown ? line->offset : m_Found.model.darkestDn - m_Found.centreDn;
    m_Found.motion = SolveMotion(equations, line->gamma, m_OffsetInUse);
    const Eigen::MatrixXd motion = MotionColumns(m_Found.motion, line->gamma);
    const std::size_t     most =
      m_Settings.rollingShutter == RollingShutter::Off ? 0 : std::min<std::size_t>(12, (m_Frames - 1) / 6);
    m_Found.local = FindLocalIllumination(*m_FrameSums, m_Found.motion, motion, line->gamma, m_OffsetInUse, most);
    m_Basis = TemporalBasis(line->gamma, m_Found.local.series, motion);
    m_Projections = ProjectionSums(m_Mean.size(), m_Basis.Size());
  }

  void
  EndProjections()
  {
    std::vector<std::uint8_t> mask = m_Reference.usable;
    ProjectedVariance         projected(
      m_Reference, m_Basis, m_Found.motion, m_Projections, m_Found.model, mask, m_ParallelFor);
    const auto fit = [&](std::optional<VarianceLine> start, int iterations) {
      const VarianceLine line = FitVarianceLine(projected.GetData(mask), m_ParallelFor, start, iterations);
      if (!line.isDetermined)
      {
        throw std::runtime_error("too few pixels, or pixels of one intensity only, are left to fit the variance");
      }
      return line;
    };
    // A first line with every series projected tells which the classes need, and with the flat classes which fit.
    projected.Compute(m_Found.model.slopeDn);
    VarianceLine line = fit(std::nullopt, 4);
    projected.Compute(line.gain);
    line = fit(line, 4);
    projected.ChooseSeries(line);
    projected.Compute(line.gain);
    const std::vector<std::uint8_t> all = mask;
    for (std::size_t p = 0; p < mask.size(); ++p)
    {
      mask[p] = all[p] != 0 && projected.ClassOf(p) <= 0.6 * ProjectedVariance::Classes ? 1 : 0;
    }
    line = fit(line, 4);
    m_Found.classes = JudgeClasses(projected, line, all, m_ParallelFor);
    const auto select = [&](const std::vector<std::uint8_t> & misfit) {
      for (std::size_t p = 0; p < mask.size(); ++p)
      {
        const bool isRough = projected.ClassOf(p) >= m_Found.classes.firstBad;
        const bool isMisfit = !misfit.empty() && misfit[p] != 0;
        mask[p] = all[p] != 0 && !isRough && !isMisfit ? 1 : 0;
        if (all[p] != 0)
        {
          m_PixelUse[p] = static_cast<std::uint8_t>(isMisfit  ? PixelUse::NotStatic
                                                    : isRough ? PixelUse::Vibration
                                                              : PixelUse::Used);
        }
      }
    };
    select({});
    line = fit(line, 4);
    for (int round = 0; round < 2; ++round)
    {
      select(FindLocalMisfit(projected, line, all, m_ParallelFor));
      line = fit(line, 4);
    }
    projected.Compute(line.gain);
    line = fit(line, 8);
    this->CorrectForNoisyMeans(line);
    m_Found.variance = line;
    m_Found.intensityChi2 = IntensityChi2(projected.GetData(mask), line, m_ParallelFor);
    m_Found.notStatic = static_cast<std::size_t>(
      std::count(m_PixelUse.begin(), m_PixelUse.end(), static_cast<std::uint8_t>(PixelUse::NotStatic)));
    m_CorrectedVariance = projected.GetVariance();
    for (std::size_t p = 0; p < all.size(); ++p)
    {
      m_CorrectedVariance[p] = all[p] != 0 ? m_CorrectedVariance[p] : std::nan("");
    }
    this->Polish(projected, line, mask);
  }

  /** The mean has noise of its own, and it is correlated with the variance as the noise is skewed. Both together bias
   * the slope's equation by -g sigma^2 / T a unit of weight. Estimator.md, 3.6. */
  void
  CorrectForNoisyMeans(VarianceLine & line) const
  {
    const double darkest = m_OffsetInUse + m_Found.centreDn;
    const double readVariance = std::max(0.0, line.intercept + line.gain * darkest);
    const double bias = -line.gain * readVariance / static_cast<double>(m_Frames) * line.weightSum / line.spreadDn2;
    line.gain -= bias;
    line.intercept += bias * line.centreDn;
  }

  /** Offset, flicker and shifts once more, with the noise that is now known. Needs no reading. */
  void
  Polish(const ProjectedVariance & projected, const VarianceLine & line, const std::vector<std::uint8_t> & mask)
  {
    RegressorNoise  noise;
    InstrumentNoise instruments;
    const double    offsetDn = m_OffsetInUse + m_Found.centreDn;
    for (std::size_t p = 0; p < m_Mean.size(); ++p)
    {
      const std::uint8_t c = m_FrameSums->ClassOf(p);
      if (c != FrameSums::Unused)
      {
        const double level = m_Reference.neighbourMean[p];
        const double variance = line.At(level);
        const double w = 1.0 / m_Found.model.NoiseVariance(level);
        noise.variance[c] += w * variance;
        noise.shot[c] += w * line.gain * std::max(0.0, level - offsetDn);
        const Eigen::Vector2d z(m_FrameSums->SmoothX(p), m_FrameSums->SmoothY(p));
        instruments.variance += m_FrameSums->SmoothWeight(p) * variance;
        instruments.squares += variance * z * z.transpose();
      }
    }
    const std::vector<double>       gamma = m_Found.line.gamma;
    const std::optional<OffsetLine> polished = FitOffsetLine(*m_FrameSums, noise, gamma);
    m_Found.line = polished ? *polished : m_Found.line;
    const FrameEquations            equations = MakeFrameEquations(*m_FrameSums, noise, GradientClasses - 1, gamma);
    const std::optional<OffsetLine> everywhere = FitOffsetLine(equations);
    m_Found.motionPhi = everywhere ? everywhere->Widening() : 1.0;
    m_Found.motion = SolveMotion(equations, m_Found.line.gamma, m_Found.line.offset);
    m_Found.shifts = SolveShifts(*m_FrameSums, m_Found.motion, instruments, m_Found.line.gamma, m_Found.line.offset);
    if (m_Found.local.series.cols() > 0)
    {
      const LocalOffsetData data{ projected,
                                  line,
                                  mask,
                                  m_Found.centreDn,
                                  m_Found.model.darkestDn,
                                  m_Found.model.brightestDn - m_Found.model.darkestDn };
      m_Found.isOffsetDrift = IsOffsetDrift(data);
      if (!m_Found.isOffsetDrift)
      {
        m_Found.localOffset = FindLocalOffset(data);
      }
      const double offset = m_Found.localOffset ? m_Found.localOffset->offset : m_OffsetInUse;
      m_Found.localFlickerSd = LocalFlickerSd(data, offset);
    }
  }

  RefinedSettings           m_Settings;
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  std::vector<std::uint8_t> m_UserMask;
  ParallelFor               m_ParallelFor;
  unsigned int              m_Pass{ 0 };
  std::size_t               m_FramesInPass{ 0 };

  TemporalMoments<TPixel>    m_Moments;
  std::vector<double>        m_FrameMeans;
  StackSummary               m_Summary;
  std::vector<double>        m_Mean;
  std::vector<double>        m_Variance;
  std::vector<double>        m_CorrectedVariance;
  std::vector<std::uint8_t>  m_Valid;
  std::vector<std::uint8_t>  m_PixelUse;
  ReferenceFrame             m_Reference;
  std::unique_ptr<FrameSums> m_FrameSums;
  double                     m_OffsetInUse{ 0.0 }; // minus the centre
  TemporalBasis              m_Basis;
  ProjectionSums             m_Projections;
  RefinedFindings            m_Found;
  Report                     m_Report;
};

} // namespace sensornoise

#endif
