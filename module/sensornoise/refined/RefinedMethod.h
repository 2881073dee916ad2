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
#ifndef sensornoise_refined_RefinedMethod_h
#define sensornoise_refined_RefinedMethod_h

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/moments/PassFrames.h"
#include "sensornoise/moments/StackMaps.h"
#include "sensornoise/moments/StackMoments.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/ProjectionSums.h"
#include "sensornoise/pixels/StaticVariance.h"
#include "sensornoise/refined/RefinedFindings.h"
#include "sensornoise/refined/RefinedReport.h"
#include "sensornoise/refined/RefinedSettings.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/scene/GuardBand.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/scene/UsablePixels.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/FrameRegressors.h"
#include "sensornoise/series/FrameSums.h"
#include "sensornoise/series/SceneSeries.h"
#include "sensornoise/series/ShiftInstruments.h"
#include "sensornoise/series/TemporalBasis.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
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
 * Same bits for any number of threads and any chunks. Memory: about 130 bytes a pixel and 8 more a series (4 to 20), 20
 * kB a frame. A stack that cannot be measured ends in a report whose quantities are `failed`, with a warning that says
 * why; wrong use throws std::invalid_argument.
 *
 * Several processes, each with a part of the frames, get the whole's report if they share the sums of every pass: the
 * whole's bits with integer pixels; with floating point the same bits in all of them, equal to the whole's to rounding.
   \code
   RefinedMethod<unsigned short> method(settings, geometry, frames); // alike in every process
   for (unsigned int pass = 0; pass < method.NumberOfPasses; ++pass)
   {
     method.SkipFrames(first); // this process reads the frames first ... first + count - 1
     method.AddFrames(part, count);
     method.SaveSums(toOthers);
     for (std::istream * other : fromOthers)
     {
       method.MergeSums(*other);
     }
     method.EndPass();
   }
   \endcode
 */
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
    , m_InPass(frames)
    , m_Moments(geometry.Pixels(), frames)
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
    const std::size_t  pixels = m_Geometry.Pixels();
    const std::size_t  first = m_InPass.Add(frames);
    const unsigned int pass = m_InPass.GetPass();
    if (pass == 0)
    {
      m_Moments.AddFrames(chunk, first, frames, m_ParallelFor);
    }
    else if (pass == 1 && m_FrameSums)
    {
      m_FrameSums->AddFrames(chunk, first, frames, m_ParallelFor);
    }
    else if (pass == 2 && m_FrameSums)
    {
      ForBlocks(pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end) {
        m_Projections.AddFrames(m_Basis, chunk, first, frames, begin, end);
      });
    }
  }

  /** The next \a frames frames of the current pass are added by other processes. */
  void
  SkipFrames(std::size_t frames)
  {
    m_InPass.Skip(frames);
  }

  /** Writes the sums over the frames of the current pass that have been added or merged so far, see BinaryStream: 20
   * (integers) or 32 bytes a pixel in pass 1, 16 kB a frame in pass 2, 8 bytes a pixel and series in pass 3. */
  void
  SaveSums(std::ostream & out) const
  {
    WriteSumsHeader(out, StreamName(), m_Geometry.Pixels(), m_Frames);
    m_InPass.Save(out);
    WriteCount(out, this->FingerprintOfPass());
    if (m_InPass.GetPass() == 0)
    {
      m_Moments.Save(out);
    }
    else if (m_FrameSums)
    {
      m_InPass.GetPass() == 1 ? m_FrameSums->Save(out) : m_Projections.Save(out);
    }
  }

  /** Adds the sums that another object, with the same arguments, saved in the same pass. Throws std::runtime_error, and
   * changes nothing, if the stream is no such sums, or holds a frame that is here, too. */
  void
  MergeSums(std::istream & in)
  {
    const std::size_t pixels = m_Geometry.Pixels();
    RequireCount("frames", ReadSumsHeader(in, StreamName(), pixels), m_Frames);
    const PassFrames frames = m_InPass.ReadOther(in);
    m_InPass.RequireApart(frames);
    if (ReadCount(in) != this->FingerprintOfPass())
    {
      throw std::runtime_error("sums cannot be merged: they are made with other settings, another mask or other sums "
                               "of the passes before");
    }
    if (m_InPass.GetPass() == 0)
    {
      m_Moments.Merge(in);
    }
    else if (m_FrameSums && m_InPass.GetPass() == 1)
    {
      FrameProducts others = m_FrameSums->GetProducts();
      others.Restore(in);
      m_FrameSums->Merge(others);
    }
    else if (m_FrameSums)
    {
      ProjectionSums others(pixels, m_Basis.Size());
      others.Restore(in);
      m_Projections.Merge(others);
    }
    m_InPass.Merge(frames);
  }

  /** Ends the current pass. */
  void
  EndPass()
  {
    const unsigned int pass = m_InPass.GetPass();
    m_InPass.EndPass();
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
      m_Found.Fail("nothing-to-measure", error.what());
      m_FrameSums.reset();
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
  static std::string
  StreamName()
  {
    return "RefinedMethod " + PixelName<TPixel>();
  }

  /** Of all that the sums of the current pass depend on beside the frames. */
  std::uint64_t
  FingerprintOfPass() const
  {
    Fingerprint       fingerprint;
    const std::size_t sizes[2] = { m_Geometry.width, m_FrameSums ? 1U : 0U };
    fingerprint.Add(sizes, 2);
    fingerprint.Add(m_UserMask.data(), m_UserMask.size());
    fingerprint.Add(m_Mean.data(), m_Mean.size());
    fingerprint.Add(m_Variance.data(), m_Variance.size());
    fingerprint.Add(m_PixelUse.data(), m_PixelUse.size());
    for (std::size_t j = 0; j < m_Basis.Size(); ++j)
    {
      for (std::size_t t = 0; t < m_Frames; ++t)
      {
        const double rounded = m_Basis.Rounded(t, j);
        fingerprint.Add(&rounded, 1);
      }
    }
    return fingerprint.GetValue();
  }

  void
  EndMoments()
  {
    const std::size_t pixels = m_Geometry.Pixels();
    m_Mean.resize(pixels);
    m_Variance.resize(pixels);
    m_Valid.resize(pixels);
    m_Summary = MakeStackMaps<TPixel>(
      m_Moments.Take(), m_Settings.codes, m_ParallelFor, m_Mean.data(), m_Variance.data(), m_Valid.data());
    m_Reference = MakeReferenceFrame(m_Mean, m_Variance, m_Valid, m_Geometry, m_Frames, m_ParallelFor);
    m_PixelUse.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const bool isMasked = !m_UserMask.empty() && m_UserMask[p] == 0;
      m_PixelUse[p] =
        static_cast<std::uint8_t>(isMasked ? PixelUse::Masked : UseOf(m_Reference, m_Variance, m_Valid, p));
      m_Valid[p] = isMasked ? 0 : m_Valid[p];
      m_Reference.usable[p] = isMasked ? 0 : m_Reference.usable[p];
    }
    m_Found.model = FitProvisionalModel(m_Reference);
    m_Found.centreDn = m_Found.model.averageDn;
    LeaveOutCoarseAndGuarded(
      m_Reference, m_PixelUse, m_Found, m_Summary.codes, m_Moments.GetFrameMeans(), m_ParallelFor);
    if (!m_Found.failure.empty())
    {
      return;
    }
    std::vector<std::uint8_t> take = m_Reference.usable;
    const auto                unexplained = FindUnexplained(m_Reference, m_Found.model, m_ParallelFor);
    std::vector<std::uint8_t> whole = take;
    for (std::size_t p = 0; p < pixels; ++p)
    {
      whole[p] = unexplained[p] == 2 ? 0 : whole[p];
      take[p] = unexplained[p] != 0 ? 0 : take[p];
    }
    ShiftInstruments instruments = MakeShiftInstruments(m_Reference, m_Found.model, whole, m_ParallelFor);
    FrameRegressors  regressors(m_Reference, m_Found.model, take, std::move(instruments), m_ParallelFor);
    m_FrameSums = std::make_unique<FrameSums>(std::move(regressors), m_ParallelFor);
  }

  void
  EndFrameSums()
  {
    m_Basis = FindSceneSeries(*m_FrameSums, m_Settings.rollingShutter, m_Found);
    m_Projections = ProjectionSums(m_Mean.size(), m_Basis.Size(), m_ParallelFor);
  }

  void
  EndProjections()
  {
    const std::vector<std::uint8_t> & all = m_Reference.usable;
    ProjectedVariance projected(m_Reference, m_Basis, m_Found.motion, m_Projections, m_Found.model, all, m_ParallelFor);
    const std::vector<std::uint8_t> mask = FitStaticVariance(projected, all, m_Found, m_PixelUse, m_ParallelFor);
    PolishSceneSeries(*m_FrameSums, projected, mask, m_Found, m_ParallelFor);
    m_CorrectedVariance = projected.TakeVariance();
    for (std::size_t p = 0; p < all.size(); ++p)
    {
      m_CorrectedVariance[p] = all[p] != 0 ? m_CorrectedVariance[p] : std::numeric_limits<double>::quiet_NaN();
    }
  }

  RefinedSettings            m_Settings;
  FrameGeometry              m_Geometry;
  std::size_t                m_Frames;
  std::vector<std::uint8_t>  m_UserMask;
  ParallelFor                m_ParallelFor;
  PassFrames                 m_InPass;
  StackMoments<TPixel>       m_Moments;
  StackSummary               m_Summary;
  std::vector<double>        m_Mean;
  std::vector<double>        m_Variance;
  std::vector<double>        m_CorrectedVariance;
  std::vector<std::uint8_t>  m_Valid;
  std::vector<std::uint8_t>  m_PixelUse;
  ReferenceFrame             m_Reference;
  std::unique_ptr<FrameSums> m_FrameSums;
  TemporalBasis              m_Basis;
  ProjectionSums             m_Projections;
  RefinedFindings            m_Found;
  Report                     m_Report;
};

} // namespace sensornoise

#endif
