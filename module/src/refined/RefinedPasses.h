// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedPasses_h
#define sensornoise_refined_RefinedPasses_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Parallel.h"
#include "moments/Exposures.h"
#include "moments/StackMaps.h"
#include "moments/StackPasses.h"
#include "refined/PixelProjections.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "scene/StaticScene.h"
#include "series/FrameSums.h"
#include "series/FrameEquations.h"
#include "series/SceneSeries.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class RefinedPasses
 * \brief Gain, offset and read noise at the theoretical limit, in three passes over the stack.
 *
 * Pass 1 gathers the temporal moments: the mean image, an initial noise model, and the clipped pixels. Pass 2 regresses
 * every frame on the mean image and its derivatives. It gives the offset and the temporal components: flicker, local
 * illumination and motion. Pass 3 projects every pixel's time series on these components. The residual is sensor noise,
 * and its regression on the mean gives gain and intercept. If the illumination changes strongly, the stack is read once
 * more between passes 1 and 2, see LevelProjection. Usage, also by several processes, as StackPasses. The sums of a
 * process have 16 kB for each frame in pass 2, and 8 bytes for each pixel in the further pass. In pass 3 they have 8
 * bytes for each pixel and temporal component, or 4 where UnitOfNarrowSums() finds that enough.
 *
 * Identical frames are counted once: the result is the result of the distinct frames, and the series in the report
 * repeat the values of a frame's original.
 *
 * The results are identical for any number of threads and any chunks. Memory: 48 bytes for each pixel (52 for
 * floating-point frames), or in the third pass 10 (20) bytes, and 4 or 8 more for each temporal component that is found
 * (2 to 20); 20 kB for each frame, and 32 MiB, see MemoryNeed. A stack that
 * cannot be measured (NothingToMeasure) has a report whose quantities are `failed`, with a warning that gives the
 * reason. Wrong use throws std::invalid_argument. May be moved, also between and within passes. */
template <typename TPixel>
class RefinedPasses final : public StackPasses<TPixel>
{
public:
  using typename StackPasses<TPixel>::Passes;
  using Settings = RefinedSettings;

  /** Whether there is SumBytesPerPixel(). */
  static constexpr bool HasManySums = true;
  /** Whether there is GetSample(). */
  static constexpr bool HasSample = true;

  /** \a mask, if given, has a nonzero value at the pixels to be used. \a parallelFor distributes the work. Throws
   * std::invalid_argument for settings out of range, see RefinedSettings::Validate(), and for a stack or a mask that
   * RequireStack() rejects. */
  RefinedPasses(const RefinedSettings &           settings,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<std::uint8_t> & mask = {},
                ParallelFor                       parallelFor = SerialFor);

  /** Declares that no sums of the third pass are saved or merged: if all frames are added together, the pass needs no
   * memory for them. Call it before the third pass. */
  void
  DisableMerging()
  {
    m_IsWithoutMerging = true;
  }

  /** Declares that the noise of the sample is kept for the planes of a mosaic: its covariance with the noise of the
   * neighbours, which are in other planes, is measured when all planes are. Call it before the third pass. */
  void
  KeepSample()
  {
    m_KeepsSample = true;
  }
  /** Returns the noise of the sample, empty if there is none. */
  const SampledNoise &
  GetSample() const
  {
    static const SampledNoise none;
    return m_Noise ? m_Noise->sampled : none;
  }
  void
  ReleaseSample()
  {
    if (m_Noise)
    {
      m_Noise->sampled = {};
    }
  }
  /** The report, to which the covariance with the pixels of other planes may be added. */
  Report &
  GetReport()
  {
    return m_Report;
  }

  /** Returns whether the report is available. This is after NumberOfPasses passes or more. Each further pass reads the
   * stack once more: one for the moments if frames are left out, one after these if the illumination changes strongly
   * (LevelProjection), and others, as the third, if RefinedSettings::memoryLimitBytes requires them. */
  bool
  IsDone() const override
  {
    return m_IsDone;
  }
  /** Returns whether the current pass is the last one before the third, or, if the stack cannot be measured, a pass
   * without sums. */
  bool
  IsBeforeProjections() const
  {
    return m_HasScene && !m_IsDone && !m_Projections;
  }
  /** Returns the size of the sums of a pixel in the third pass [bytes]; 0 before it. */
  std::size_t
  SumBytesPerPixel() const
  {
    return m_Projections ? m_Projections->BytesPerPixel() : 0;
  }
  /** Releases the memory that is needed only to add frames. Call it when all frames of the second pass have been added,
   * and the pass is to end later. */
  void
  ReleaseFrameSums()
  {
    if (m_FrameSums && !m_Scene->frame.neighbourMean.empty())
    {
      m_FrameSums->EndFrames(m_ParallelFor);
      m_RawNoise = CovarianceOfProducts(m_FrameSums->GetRegressors(), m_Scene->frame.variance, m_ParallelFor);
      std::exchange(m_Scene->frame.neighbourMean, {}); // computed again when the third pass ends
    }
  }
  const Report &
  GetReport() const override
  {
    return m_Report;
  }
  const std::vector<double> &
  GetMean() const override
  {
    return m_Mean.empty() ? m_Scene->frame.mean : m_Mean;
  }
  const std::vector<double> &
  GetVariance() const override
  {
    return m_Scene->frame.variance.GetDoubles();
  }
  /** Returns the variance without flicker and motion [DN^2]; NaN where it was not computed; empty if the stack cannot
   * be measured. */
  const std::vector<double> &
  GetCorrectedVariance() const override
  {
    return m_CorrectedVariance.GetDoubles();
  }
  /** Returns values of PixelUse. */
  const std::vector<std::uint8_t> &
  GetPixelUse() const override
  {
    return m_Noise ? m_Noise->variance.pixelUse : m_Scene->pixelUse;
  }

  /** Return the maps, which are moved out of the object. */
  std::vector<double>
  TakeMean() override
  {
    return std::move(m_Mean.empty() ? m_Scene->frame.mean : m_Mean);
  }
  std::vector<double>
  TakeVariance() override
  {
    return m_Scene->frame.variance.TakeDoubles();
  }
  std::vector<double>
  TakeCorrectedVariance() override
  {
    return m_CorrectedVariance.TakeDoubles();
  }
  std::vector<std::uint8_t>
  TakePixelUse() override
  {
    return std::move(m_Noise ? m_Noise->variance.pixelUse : m_Scene->pixelUse);
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

  /** Returns the projections of the current pass; null: it has none. */
  PixelProjections *
  GetProjections()
  {
    return m_Levels ? &m_Levels->GetProjections() : m_Projections ? &*m_Projections : nullptr;
  }
  const PixelProjections *
  GetProjections() const
  {
    return m_Levels ? &m_Levels->GetProjections() : m_Projections ? &*m_Projections : nullptr;
  }
  bool
  HasSums() const override
  {
    return m_FrameSums || m_Levels;
  }
  void
  AddDistinct(const std::vector<Plane> & planes,
              const TPixel *             frames,
              std::size_t                count,
              const ParallelFor &        parallelFor) const override;
  /** Packs the means, and releases the mask of the usable pixels, if sums of the third pass are held when \a count
   * frames are added. The pass needs both at its end only. */
  void
  PackMaps(std::size_t count, const ParallelFor & parallelFor);
  /** Makes the maps that PackMaps() has packed. */
  void
  UnpackMaps();
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
  /** Calls function(), which may throw NothingToMeasure. Makes the report if no pass remains. */
  template <typename TFunction>
  void
  Finish(TFunction function);

  void
  EndMoments();
  void
  EndLevels();
  /** Returns an upper bound of the noise variance in the frame of the lowest level, from the differences of
   * neighbouring pixels [DN^2]. */
  double
  NoiseOfDarkestFrame() const;
  /** Makes the scene, see MakeStaticScene(), and starts the second pass. */
  void
  MakeScene(StackMaps maps, std::optional<StrongChange> strongChange);
  void
  EndFrameSums();
  bool
  EndProjections();
  void
  MeasureNoise();
  /** Discards all results of the passes after the moments. */
  void
  ForgetFindings();
  /** Returns the quantization noise of companded digital numbers. */
  QuantisationNoise
  FindQuantisationNoise() const;
  Report
  MakeMeasuredReport() const;
  void
  MakeReport();

  RefinedSettings            m_Settings;
  std::optional<ExposureFit> m_ExposureFit; // from the first pass; none: no exposures were given

  // The sums of the passes, and their results. The scene must not move in memory: FrameSums points to its frame.
  std::unique_ptr<StaticScene>        m_Scene;
  std::unique_ptr<LevelProjection>    m_Levels; // levels of the pass after the first pass; null: there is no such pass
  std::unique_ptr<FrameSums>          m_FrameSums; // null in that pass, or if the stack cannot be measured
  std::vector<FrameSums::ClassMatrix> m_RawNoise;  // covariance of the products by the variances of the first pass
  std::optional<const SceneSeries>    m_Series;
  std::optional<PixelProjections>     m_Projections;
  std::optional<PixelNoise>           m_Noise;
  std::optional<const ReestimatedComponents> m_Reestimated;
  std::vector<double>                        m_Mean; // map for display, filled when the report is made
  PixelMap                                   m_CorrectedVariance;
  std::optional<const NothingToMeasure>      m_FailureReason;
  bool                                       m_HasScene{ false };
  bool                                       m_IsWithoutMerging{ false };
  bool                                       m_KeepsSample{ false };
  bool                                       m_IsDone{ false };
  Report                                     m_Report;
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT RefinedPasses<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
