// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedPasses_h
#define sensornoise_published_PublishedPasses_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "base/FramesTogether.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "moments/StackPasses.h"
#include "published/CorrectedVariance.h"
#include "published/FlickerEstimate.h"
#include "published/FlickerSums.h"
#include "published/PublishedReport.h"
#include "published/PublishedScene.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class PublishedPasses
 * \brief The algorithm of Figure 2 of Sur & Gredi\'ac 2015 in three passes over the stack.
 *
 * https://doi.org/10.1137/140977035. Pass 1 gathers the temporal moments, which give mean, variance, clip levels, the
 * vibration mask and the iso-intensity sets; pass 2 each frame's sums over the sets, which give flicker and offset;
 * pass 3 the sums of the corrected variance, which gives gain and intercept. Usage, also by several processes, as
 * StackPasses: their sums have 32 bytes a frame and 8 a frame and row in pass 2, and 8 bytes a pixel in pass 3.
 *
 * Frames that are equal are counted once, see DistinctFrames; flicker is reported for all of them.
 *
 * Same bits for any number of threads and any chunks. Memory: 40 bytes a pixel, 8 bytes a frame and row.
 * A stack that cannot be measured ends in a report whose quantities are `failed`, with a warning that says why; wrong
 * use throws std::invalid_argument.
 */
template <typename TPixel>
class PublishedPasses final : public StackPasses<TPixel>
{
public:
  using typename StackPasses<TPixel>::Passes;
  using Settings = PublishedSettings;

  /** Whether the third pass has more than one sum of a pixel. */
  static constexpr bool HasManySums = false;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work. Throws
   * std::invalid_argument for settings out of range, see PublishedSettings::Validate(), and for a stack or a mask that
   * RequireStack() refuses. */
  PublishedPasses(const PublishedSettings &         settings,
                  const FrameGeometry &             geometry,
                  std::size_t                       frames,
                  const std::vector<std::uint8_t> & mask = {},
                  ParallelFor                       parallelFor = SerialFor);

  /** Whether the last pass has ended. */
  bool
  IsDone() const override
  {
    return m_IsDone;
  }
  /** The report and maps of a frame's size are there when the last pass has ended. */
  const Report &
  GetReport() const override
  {
    return m_Report;
  }
  const std::vector<double> &
  GetMean() const override
  {
    return m_Scene.mean;
  }
  const std::vector<double> &
  GetVariance() const override
  {
    return m_Scene.variance;
  }
  /** NaN where the flicker is not known; empty if the stack cannot be measured. */
  const std::vector<double> &
  GetCorrectedVariance() const override
  {
    return m_Corrected.variance;
  }
  /** Values of PixelUse. */
  const std::vector<std::uint8_t> &
  GetPixelUse() const override
  {
    return m_Corrected.pixelUse;
  }

  /** Give the maps away, after which they are empty here. */
  std::vector<double>
  TakeMean() override
  {
    return std::move(m_Scene.mean);
  }
  std::vector<double>
  TakeVariance() override
  {
    return std::move(m_Scene.variance);
  }
  std::vector<double>
  TakeCorrectedVariance() override
  {
    return std::move(m_Corrected.variance);
  }
  std::vector<std::uint8_t>
  TakePixelUse() override
  {
    return std::move(m_Corrected.pixelUse);
  }

private:
  using typename StackPasses<TPixel>::Plane;
  using Passes::m_Distinct;
  using Passes::m_Geometry;
  using Passes::m_Layout;
  using Passes::m_Moments;
  using Passes::m_ParallelFor;
  using Passes::m_Thumbnails;
  using Passes::m_UserMask;

  bool
  HasSums() const override
  {
    return m_Sums || m_Correction;
  }
  void
  AddDistinct(const std::vector<Plane> & planes,
              const TPixel *             frames,
              std::size_t                count,
              const ParallelFor &        parallelFor) const override;
  void
  ForgetOwnSums() override;
  void
  SaveOwnSums(std::ostream & out) const override;
  void
  MergeOwnSums(std::istream & in) override;
  void
  AddFindings(Fingerprint & fingerprint) const override;
  void
  FinishMoments() override;
  void
  FinishSums() override;

  PublishedScene
  EndMoments();
  CorrectedMaps
  EndCorrection() const;

  PublishedSettings m_Settings;

  // What passes 2 and 3 gather, one of them at a time; neither if the stack cannot be measured.
  std::optional<FlickerSums>       m_Sums;
  std::optional<CorrectedVariance> m_Correction;

  // What the passes find, one after the other.
  PublishedScene  m_Scene;
  FlickerEstimate m_Flicker;
  CorrectedMaps   m_Corrected;
  Report          m_Report;
  bool            m_IsDone{ false };
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT PublishedPasses<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
