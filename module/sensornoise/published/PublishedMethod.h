// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedMethod_h
#define sensornoise_published_PublishedMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/moments/DistinctFrames.h"
#include "sensornoise/moments/FrameThumbnails.h"
#include "sensornoise/moments/PassFrames.h"
#include "sensornoise/moments/StackMoments.h"
#include "sensornoise/published/CorrectedVariance.h"
#include "sensornoise/published/FlickerEstimate.h"
#include "sensornoise/published/FlickerSums.h"
#include "sensornoise/published/PublishedReport.h"
#include "sensornoise/published/PublishedScene.h"
#include "sensornoise/published/PublishedSettings.h"
#include "sensornoise/report/Report.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class PublishedMethod
 * \brief The algorithm of Figure 2 of Sur & Gredi\'ac 2015 in three passes over the stack.
 *
 * https://doi.org/10.1137/140977035. Pass 1 gathers the temporal moments, which give mean, variance, clip levels, the
 * vibration mask and the iso-intensity sets; pass 2 each frame's sums over the sets, which give flicker and offset;
 * pass 3 the sums of the corrected variance, which gives gain and intercept. Usage:
   \code
   PublishedMethod<unsigned short> method(settings, geometry, frames);
   while (!method.IsDone())
   {
     for (const auto & chunk : chunks) // of consecutive frames, all of the stack in every pass
       method.AddFrames(chunk.pixels, chunk.frames);
     method.EndPass();
   }
   method.GetReport();
   \endcode
 *
 * Frames that are equal are counted once, see DistinctFrames; flicker is reported for all of them.
 *
 * Same bits for any number of threads and any chunks. Memory: 40 bytes a pixel, 8 bytes a frame and row.
 * A stack that cannot be measured ends in a report whose quantities are `failed`, with a warning that says why; wrong
 * use throws std::invalid_argument.
 */
template <typename TPixel>
class PublishedMethod
{
public:
  static constexpr unsigned int NumberOfPasses = 3;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work. Throws
   * std::invalid_argument for settings out of range, see PublishedSettings::Validate(), and for a stack or a mask that
   * RequireStack() refuses. */
  PublishedMethod(const PublishedSettings &         settings,
                  const FrameGeometry &             geometry,
                  std::size_t                       frames,
                  const std::vector<std::uint8_t> & mask = {},
                  ParallelFor                       parallelFor = SerialFor);

  /** Adds the next \a frames frames of the current pass, stored one after the other. Throws std::logic_error if there
   * are not so many left. */
  void
  AddFrames(const TPixel * chunk, std::size_t frames);

  /** Several processes, each with a part of the frames, share the sums of every pass: all of these as RefinedMethod's.
   * A process writes 20 (integers) or 32 bytes a pixel in pass 1, 32 bytes a frame and 8 a frame and row in pass 2, 8
   * bytes a pixel in pass 3. */
  void
  SkipFrames(std::size_t frames);
  void
  GoTo(std::size_t t);
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_InPass.GetHas();
  }
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere)
  {
    m_Moments.SetCountedElsewhere(areCountedElsewhere);
  }
  const FrameFingerprints &
  GetFingerprints() const
  {
    return m_Moments.GetFingerprints();
  }
  void
  ForgetSums();
  void
  FoldSums()
  {
    m_Moments.Fold();
  }
  void
  SaveSums(std::ostream & out) const;
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Whether the last pass has ended. */
  bool
  IsDone() const
  {
    return m_InPass.GetPass() >= NumberOfPasses;
  }
  /** The report and maps of a frame's size are there when the last pass has ended. */
  const Report &
  GetReport() const
  {
    return m_Report;
  }
  const std::vector<double> &
  GetMean() const
  {
    return m_Scene.mean;
  }
  const std::vector<double> &
  GetVariance() const
  {
    return m_Scene.variance;
  }
  /** NaN where the flicker is not known; empty if the stack cannot be measured. */
  const std::vector<double> &
  GetCorrectedVariance() const
  {
    return m_Corrected.variance;
  }
  /** Values of PixelUse. */
  const std::vector<std::uint8_t> &
  GetPixelUse() const
  {
    return m_Corrected.pixelUse;
  }

  /** Give the maps away, after which they are empty here. */
  std::vector<double>
  TakeMean()
  {
    return std::move(m_Scene.mean);
  }
  std::vector<double>
  TakeVariance()
  {
    return std::move(m_Scene.variance);
  }
  std::vector<double>
  TakeCorrectedVariance()
  {
    return std::move(m_Corrected.variance);
  }
  std::vector<std::uint8_t>
  TakePixelUse()
  {
    return std::move(m_Corrected.pixelUse);
  }

private:
  /** Of all that the sums of the current pass depend on beside the frames. */
  std::uint64_t
  FingerprintOfPass() const;
  PublishedScene
  EndMoments();
  CorrectedMaps
  EndCorrection() const;

  PublishedSettings         m_Settings;
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  std::vector<std::uint8_t> m_UserMask;
  ParallelFor               m_ParallelFor;
  PassFrames                m_InPass;

  // What the passes gather; there are no sums of passes 2 and 3 if the stack cannot be measured.
  StackMoments<TPixel>             m_Moments;
  FrameThumbnails                  m_Thumbnails;
  std::optional<FlickerSums>       m_Sums;
  std::optional<CorrectedVariance> m_Correction;

  // What the passes find, one after the other.
  DistinctFrames  m_Distinct;
  PublishedScene  m_Scene;
  FlickerEstimate m_Flicker;
  CorrectedMaps   m_Corrected;
  Report          m_Report;
};

extern template class SensorNoise_EXPORT PublishedMethod<unsigned char>;
extern template class SensorNoise_EXPORT PublishedMethod<unsigned short>;
extern template class SensorNoise_EXPORT PublishedMethod<short>;
extern template class SensorNoise_EXPORT PublishedMethod<float>;
extern template class SensorNoise_EXPORT PublishedMethod<double>;

} // namespace sensornoise

#endif
