// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedPasses_h
#define sensornoise_published_PublishedPasses_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Simd.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "moments/StackPasses.h"
#include "published/Flicker.h"
#include "published/PublishedEstimate.h"
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
 * \brief Algorithm of Figure 2 of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035) in three passes over the
 * stack.
 *
 * Pass 1 sums the temporal moments, which give mean, variance, clip levels, the vibration mask and the iso-intensity
 * sets. Pass 2 sums each frame over the sets, which gives flicker and offset. Pass 3 sums the corrected variance, which
 * gives gain and intercept. Usage, also by several processes, as StackPasses. The sums of a process have 32 bytes per
 * frame and 8 bytes per frame and row in pass 2, and 8 bytes per pixel in pass 3.
 *
 * Equal frames count once, see DistinctFrames; the flicker is reported for all frames.
 *
 * The number of threads and chunks does not change a bit. Memory: 40 bytes per pixel, and 8 bytes per frame and row. If
 * a stack cannot be measured, all quantities of the report are `failed`, and a warning says why. Wrong use throws
 * std::invalid_argument. */
template <typename TPixel>
class PublishedPasses final : public StackPasses<TPixel>
{
public:
  using typename StackPasses<TPixel>::Passes;
  using Settings = PublishedSettings;

  /** Whether the third pass has more than one sum per pixel. */
  static constexpr bool HasManySums = false;

  /** \a mask, if not empty, is nonzero at the pixels to be used. \a parallelFor distributes the work over threads.
   * Throws std::invalid_argument if settings are out of range, see PublishedSettings::Validate(), or if RequireStack()
   * rejects the stack or the mask. */
  PublishedPasses(const PublishedSettings &         settings,
                  const FrameGeometry &             geometry,
                  std::size_t                       frames,
                  const std::vector<std::uint8_t> & mask = {},
                  ParallelFor                       parallelFor = SerialFor);

  /** Returns whether the last pass has ended. */
  bool
  IsDone() const override
  {
    return m_IsDone;
  }
  /** Returns the report, which is complete when the last pass has ended. The same holds for the maps below. */
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
  /** Returns the corrected variance [DN^2]: NaN where the flicker is not known; empty if the stack cannot be
   * measured. */
  const std::vector<double> &
  GetCorrectedVariance() const override
  {
    return m_Corrected.variance;
  }
  /** Returns a map of values of PixelUse. */
  const std::vector<std::uint8_t> &
  GetPixelUse() const override
  {
    return m_Corrected.pixelUse;
  }

  /** Moves the map of means out of the object. The following functions do the same for the other maps. */
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

  // Sums of pass 2 or of pass 3; neither if the stack cannot be measured.
  std::optional<FlickerSums>       m_Sums;
  std::optional<CorrectedVariance> m_Correction;

  // Results of the passes, in their order.
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
