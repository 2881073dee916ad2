// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedPasses.h"

#include "base/BinaryStream.h"
#include "base/FreeMemory.h"
#include "base/Text.h"
#include "sensornoise/FrameGeometry.h"
#include "moments/Constants.h"
#include "moments/DarkFrames.h"
#include "moments/StackMaps.h"
#include "pixels/ProjectedFrames.h"
#include "refined/RefinedResults.h"
#include "refined/PixelProjections.h"
#include "refined/RefinedEstimate.h"
#include "report/StackReport.h"
#include "report/Quantities.h"
#include "series/FrameSums.h"
#include "series/FrameRegressors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace sensornoise
{

namespace
{
/** Precision of the residual squares. Digital numbers have no squares beyond the range of single precision. */
template <typename TPixel>
constexpr Precision PrecisionOfSquares = std::is_integral_v<TPixel> ? Precision::Single : Precision::Double;

/** Returns \a noise with the frames of its groups by their indices in the stack. \a counted has the indices of the
 * distinct frames. */
FrameNoise
WithIndicesOfStack(FrameNoise noise, const std::vector<std::size_t> & counted)
{
  for (FrameGroup & group : noise.groups)
  {
    std::transform(group.frames.begin(), group.frames.end(), group.frames.begin(), [&](std::size_t frame) {
      return counted[frame];
    });
  }
  return noise;
}
} // namespace

template <typename TPixel>
RefinedPasses<TPixel>::RefinedPasses(const RefinedSettings &           settings,
                                     const FrameGeometry &             geometry,
                                     std::size_t                       frames,
                                     const std::vector<std::uint8_t> & mask,
                                     ParallelFor                       parallelFor)
  : Passes("RefinedMethod", geometry, frames, mask, std::move(parallelFor))
  , m_Settings(settings)
  , m_Scene(std::make_unique<StaticScene>())
{
  settings.Validate();
  RequireExposuresOfFrames(settings.exposures, frames);
  RequireMemoryLimit(settings.memoryLimitBytes, geometry, frames, 1);
  if constexpr (std::is_integral_v<TPixel>)
  {
    constexpr int bits = 8 * sizeof(TPixel);
    settings.RequireOffsetWithin(std::exp2(bits), "the number of levels of " + std::to_string(bits) + " bits");
  }
}

template <typename TPixel>
void
RefinedPasses<TPixel>::AddDistinct(const std::vector<Plane> & planes,
                                   const TPixel *             frames,
                                   std::size_t                count,
                                   const ParallelFor &        parallelFor) const
{
  std::vector<FrameSums::Plane>        summed;
  std::vector<PixelProjections::Plane> projected;
  for (const auto & [passes, place] : planes)
  {
    auto & method = static_cast<RefinedPasses &>(*passes);
    if (method.m_Levels) // the planes of a mosaic may be in different passes
    {
      projected.push_back(method.m_Levels->PlaneAt(place));
    }
    else if (method.m_Projections)
    {
      method.PackMaps(count, parallelFor);
      projected.push_back({ &*method.m_Projections, place, &method.m_Scene->frame });
    }
    else
    {
      summed.push_back({ method.m_FrameSums.get(), place });
    }
  }
  if (!summed.empty())
  {
    FrameSums::AddFrames(summed, frames, count, parallelFor);
  }
  if (!projected.empty())
  {
    PixelProjections::AddFrames(projected, frames, count, parallelFor);
  }
}

template <typename TPixel>
void
RefinedPasses<TPixel>::PackMaps(std::size_t count, const ParallelFor & parallelFor)
{
  ReferenceFrame & frame = m_Scene->frame;
  const bool       isFirst = !m_Noise && frame.packedMean.IsEmpty(); // no pass of the illumination alone
  if (std::is_integral_v<TPixel> && isFirst && m_Projections->HoldsSums(count, frame.frames))
  {
    frame.packedMean.Pack(frame.mean, frame.frames, TemporalMaps<TPixel>::Centre, parallelFor);
    if (!frame.packedMean.IsEmpty())
    {
      std::exchange(frame.usable, {});
    }
  }
}

template <typename TPixel>
void
RefinedPasses<TPixel>::UnpackMaps()
{
  ReferenceFrame & frame = m_Scene->frame;
  if (!frame.packedMean.IsEmpty())
  {
    ReleaseFreedMemory(); // frees the memory of the sums
    frame.packedMean.Unpack(frame.mean, m_ParallelFor);
    frame.usable = MaskOfUsed(m_Scene->pixelUse);
  }
}

template <typename TPixel>
void
RefinedPasses<TPixel>::ForgetOwnSums()
{
  PixelProjections * const projections = this->GetProjections();
  projections != nullptr ? projections->Forget() : m_FrameSums->Forget();
}

template <typename TPixel>
void
RefinedPasses<TPixel>::SaveOwnSums(std::ostream & out) const
{
  const PixelProjections * const projections = this->GetProjections();
  projections != nullptr ? projections->Save(out) : m_FrameSums->Save(out);
}

template <typename TPixel>
void
RefinedPasses<TPixel>::MergeOwnSums(std::istream & in)
{
  if (PixelProjections * const projections = this->GetProjections())
  {
    projections->Merge(in);
    return;
  }
  FrameProducts others = m_FrameSums->GetProducts();
  others.Restore(in);
  m_FrameSums->Merge(others);
}

template <typename TPixel>
void
RefinedPasses<TPixel>::AddFindings(Fingerprint & fingerprint) const
{
  const ReferenceFrame & frame = m_Levels ? m_Levels->GetFrame() : m_Scene->frame;
  for (std::size_t p = 0; p < frame.variance.size(); p += PixelsPerRun)
  {
    RunValues         buffer;
    const std::size_t pixels = std::min(PixelsPerRun, frame.variance.size() - p);
    fingerprint.Add(frame.MeansOf(p, pixels, buffer.data()), pixels);
  }
  frame.variance.Visit([&](const auto & variance) { fingerprint.Add(variance.data(), variance.size()); });
  fingerprint.Add(m_Scene->pixelUse.data(), m_Scene->pixelUse.size());
  const TemporalBasis * const basis = m_Levels   ? &m_Levels->GetProjections().GetBasis()
                                      : m_Series ? &m_Series->basis
                                                 : nullptr;
  for (std::size_t j = 0; basis != nullptr && j < basis->Size(); ++j)
  {
    for (std::size_t t = 0; t < m_Distinct.Count(); ++t)
    {
      const double rounded = basis->Rounded(t, j);
      fingerprint.Add(&rounded, 1);
    }
  }
}

template <typename TPixel>
template <typename TFunction>
void
RefinedPasses<TPixel>::Finish(TFunction function)
{
  try
  {
    function();
  }
  catch (const NothingToMeasure & failureReason)
  {
    m_FailureReason.emplace(failureReason);
    m_FrameSums.reset();
    m_Projections.reset();
  }
  m_IsDone = m_IsDone || (!this->HasSums() && !this->IsOfMoments() && this->GetPass() >= Passes::NumberOfPasses);
  if (m_IsDone)
  {
    this->MakeReport();
  }
}

template <typename TPixel>
void
RefinedPasses<TPixel>::FinishMoments()
{
  this->Finish([this] { this->EndMoments(); });
}

template <typename TPixel>
void
RefinedPasses<TPixel>::FinishSums()
{
  this->Finish([this] {
    if (m_Levels)
    {
      this->EndLevels();
    }
    else if (m_Projections)
    {
      m_IsDone = this->EndProjections();
    }
    else if (m_FrameSums)
    {
      this->EndFrameSums();
    }
  });
}

template <typename TPixel>
void
RefinedPasses<TPixel>::EndMoments()
{
  StackMaps maps =
    MakeStackMaps<TPixel>(m_Moments.Take(), m_Settings.dnSettings, m_ParallelFor, m_UserMask, m_Geometry.width);
  const std::vector<double> levels = m_Distinct.OfDistinct(m_Moments.GetFrameMeans());
  m_ExposureFit = FitExposures(m_Settings.exposures, m_Thumbnails, m_Distinct.Counted(), maps);
  const bool isStrong = m_Thumbnails.FindIlluminationChange(m_Distinct.Counted()) > InMoments.strongIlluminationChange;
  if (isStrong && AreLevelsSeries(levels))
  {
    m_Levels = std::make_unique<LevelProjection>(
      std::move(maps), m_Geometry, m_Layout, levels, m_IsWithoutMerging, m_ParallelFor);
    return;
  }
  this->MakeScene(std::move(maps), std::nullopt);
}

template <typename TPixel>
void
RefinedPasses<TPixel>::EndLevels()
{
  LevelProjection::Maps maps = m_Levels->TakeMaps(m_ParallelFor);
  m_Levels.reset();
  this->MakeScene(std::move(maps.ofScene), StrongChange{ this->NoiseOfDarkestFrame(), std::move(maps.rawVariance) });
}

template <typename TPixel>
double
RefinedPasses<TPixel>::NoiseOfDarkestFrame() const
{
  const std::vector<std::size_t> counted = m_Distinct.Counted();
  const std::vector<double>      levels = m_Distinct.OfDistinct(m_Moments.GetFrameMeans());
  const auto                     darkest = std::min_element(levels.begin(), levels.end()) - levels.begin();
  return m_Thumbnails.NoiseOf(counted[static_cast<std::size_t>(darkest)]) * m_Thumbnails.PixelsOfCell();
}

template <typename TPixel>
void
RefinedPasses<TPixel>::MakeScene(StackMaps maps, std::optional<StrongChange> strongChange)
{
  m_HasScene = true;
  SceneAndOutliers made = MakeStaticScene(std::move(maps),
                                          m_UserMask,
                                          m_Geometry,
                                          m_Distinct.Count(),
                                          m_Distinct.OfDistinct(m_Moments.GetFrameMeans()),
                                          m_Thumbnails.FindCellVariances(m_Distinct.Counted()),
                                          std::move(strongChange),
                                          m_ParallelFor);
  m_Scene = std::make_unique<StaticScene>(std::move(made.scene));
  if (m_Scene->failureReason)
  {
    throw NothingToMeasure(*m_Scene->failureReason);
  }
  if (std::is_floating_point_v<TPixel>)
  {
    RequireUnitOfFrames(m_Scene->model);
    m_Settings.RequireOffsetWithin(1000.0 * LargestMeanDn(m_Scene->frame.mean),
                                   "1000 times the largest level of the frames");
  }
  if (std::is_integral_v<TPixel> && IsSingleEnough(m_Scene->frame, m_Scene->model))
  {
    m_Scene->frame.variance.Round(m_ParallelFor);
  }
  m_FrameSums = std::make_unique<FrameSums>(MakeSceneRegressors(*m_Scene, made.outliers, m_ParallelFor), m_ParallelFor);
  m_FrameSums->SetLayout(m_Layout);
  ReleaseFreedMemory(); // the first pass has released its maps
}

template <typename TPixel>
void
RefinedPasses<TPixel>::EndFrameSums()
{
  this->ReleaseFrameSums();
  std::optional<double> knownOffsetDn;
  if (m_Settings.offset)
  {
    knownOffsetDn = m_Settings.offset->valueDn;
  }
  SceneSeries                 series = FindSceneSeries(*m_FrameSums,
                                       m_Settings.rollingShutter,
                                       knownOffsetDn,
                                       BlackLevel(m_Settings, *m_Scene, std::nullopt),
                                       m_Scene->changesStrongly,
                                       std::exchange(m_RawNoise, {}));
  const std::optional<double> narrow =
    std::is_integral_v<TPixel> ? UnitOfNarrowSums(m_Scene->frame, m_Scene->model, m_ParallelFor) : std::nullopt;
  const SumWidth width = narrow ? SumWidth::Narrow : SumWidth::Wide;
  series.basis = series.basis.WithUnit(narrow.value_or(TemporalBasis::Unit));
  m_Series.emplace(std::move(series));
  if (this->RestartWithoutFrames(m_Series->frameOffsets.unlike, FrameFault::OtherOffset))
  {
    this->ForgetFindings();
    return;
  }
  const MemoryNeed  need{ m_Geometry.Pixels(), m_Distinct.Count() };
  const double      left = m_Settings.memoryLimitBytes - need.BesideProjections();
  const std::size_t slabs = PixelProjections::SlabsWithin(left, m_Series->basis.Size(), width);
  m_Projections.emplace(m_Geometry,
                        FrameSample::Of<TPixel>(m_Geometry, m_Distinct.Count(), m_ParallelFor),
                        m_Series->basis,
                        PixelProjections::Options{
                          slabs, m_Series->local.IsLocal(), m_IsWithoutMerging, width, PrecisionOfSquares<TPixel> },
                        m_ParallelFor);
  m_Projections->SetLayout(m_Layout);
}

/** Returns whether all passes have been read. */
template <typename TPixel>
bool
RefinedPasses<TPixel>::EndProjections()
{
  const bool isIlluminationLocal = m_Series->local.IsLocal(); // the report needs the coordinates then
  if (m_Noise)
  {
    m_Projections->EndIlluminationPass(m_Scene->frame);
  }
  else if (!m_Projections->EndPass(m_Scene->frame))
  {
    return false;
  }
  else
  {
    this->UnpackMaps();
    this->MeasureNoise();
    const double most = m_Noise->frames.areFramesEqual ? InMoments.largestOtherGroup : InMoments.largestLeftOutFraction;
    if (this->RestartWithoutFrames(m_Noise->frames.unlike, FrameFault::OtherNoise, most))
    {
      this->ForgetFindings();
      return false;
    }
    if (isIlluminationLocal && !m_Projections->HasCoordinates())
    {
      m_Projections->StartIlluminationPass();
      return false;
    }
  }
  // The components are weighted with all noise, the noise of digital numbers included.
  m_Reestimated.emplace(ReestimateComponents(
    *m_FrameSums, *m_Series, m_Projections->TakeCoordinates(), m_Noise->variance, m_CorrectedVariance, m_ParallelFor));
  m_Projections.reset();
  return true;
}

template <typename TPixel>
void
RefinedPasses<TPixel>::ForgetFindings()
{
  m_Scene = std::make_unique<StaticScene>();
  m_FrameSums.reset();
  m_Series.reset();
  m_Projections.reset();
  m_Noise.reset();
  m_CorrectedVariance = PixelMap();
  m_HasScene = false;
}

template <typename TPixel>
void
RefinedPasses<TPixel>::MeasureNoise()
{
  m_Scene->frame.neighbourMean = ComputeNeighbourMean(m_Scene->frame, m_ParallelFor);
  const ReferenceFrame &         frame = m_Scene->frame;
  const std::vector<std::size_t> counted = m_Distinct.Counted();
  const QuantisationNoise        quantisationNoise = this->FindQuantisationNoise();
  m_Noise.emplace(MeasurePixelNoise(m_Projections->TakeSquares(),
                                    m_Projections->TakeSample(),
                                    m_Distinct.RecordedNumbers(),
                                    *m_Scene,
                                    m_Series,
                                    m_Settings,
                                    quantisationNoise,
                                    !m_Thumbnails.FindChange(counted).IsLarge(),
                                    m_KeepsSample,
                                    m_ParallelFor));
  if (!m_Noise->variance.line.isDetermined)
  {
    throw NothingToMeasure(
      "too few pixels are left to fit the variance, or all have one intensity. Include dark and bright areas "
      "in the scene, or measure a larger part of it (--roi)",
      WarningCode::IntensityRangeTooSmall);
  }
  m_CorrectedVariance = std::move(m_Noise->correctedVariance);
  ForPixels(m_CorrectedVariance.size(), m_ParallelFor, [&](std::size_t p) {
    m_CorrectedVariance.Set(p,
                            frame.usable[p] != 0 ? m_CorrectedVariance[p] + quantisationNoise.RemainderAt(frame.mean[p])
                                                 : std::numeric_limits<double>::quiet_NaN());
  });
}

template <typename TPixel>
QuantisationNoise
RefinedPasses<TPixel>::FindQuantisationNoise() const
{
  const auto & offset = m_Settings.offset;
  const double darkStepDn = offset && offset->maps ? offset->maps->stepDn : 0.0;
  return MakeQuantisationNoise(m_Scene->summary.dnRange, m_Scene->frame, m_Scene->model, darkStepDn);
}

template <typename TPixel>
Report
RefinedPasses<TPixel>::MakeMeasuredReport() const
{
  const StaticVariance variance = SubtractQuantisationLine(m_Noise->variance);
  return MakeRefinedReport({ m_Settings,
                             *m_Scene,
                             *m_Series,
                             variance,
                             *m_Reestimated,
                             m_CorrectedVariance.GetDoubles(),
                             BlackLevel(m_Settings, *m_Scene, m_Series),
                             m_Noise->correlation,
                             WithIndicesOfStack(m_Noise->frames, m_Distinct.Counted()),
                             m_Noise->lines,
                             m_ExposureFit ? &*m_ExposureFit : nullptr,
                             FindDarkSignal(m_Settings.offset, m_Scene->frame, variance.pixelUse, m_ParallelFor),
                             { FindDarkCharge(m_Settings.offset, m_Geometry, m_ParallelFor),
                               FindPixelCharge(m_Settings.offset, m_Geometry, m_ParallelFor) } },
                           m_ParallelFor);
}

template <typename TPixel>
void
RefinedPasses<TPixel>::MakeReport()
{
  this->UnpackMaps();
  m_Scene->frame.variance.Widen(m_ParallelFor);
  m_CorrectedVariance.Widen(m_ParallelFor);
  m_Report = m_FailureReason ? MakeFailedReport(m_Settings, *m_Scene, this->GetPixelUse(), *m_FailureReason)
                             : this->MakeMeasuredReport();
  ReportLinearity(m_Report, m_ExposureFit);
  FileStatuses(m_Report);
  DivideExcessNoise(m_Report, m_Settings.excessNoiseFactor);
  std::exchange(m_Scene->frame.neighbourMean, {});
  m_Mean = KnownMeans(m_Scene->frame, m_ParallelFor);
  WarnOfMosaic(m_Report, m_Mean, m_Geometry, m_ParallelFor);
  NoteMask(m_Report, m_Geometry, m_UserMask);
  ReportSceneChange(m_Report, m_Thumbnails.FindChange(m_Distinct.Counted()));
  ReportAllFrames(m_Report, m_Distinct, this->GetLeftOut());
}

#define SensorNoise_INSTANTIATE(TPixel) template class RefinedPasses<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
