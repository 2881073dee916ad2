// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedPasses_h
#define sensornoise_published_PublishedPasses_h

#include "SensorNoiseExport.h"
#include "base/PixelLayout.h"
#include "base/PolynomialFit.h"
#include "base/Simd.h"
#include "moments/StackPasses.h"
#include "published/Flicker.h"
#include "published/PublishedScene.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** Largest reduced chi-square of the corrected variance about its line that is accepted [1]. Chosen. */
inline constexpr double LargestReducedChi2 = 10.0;
/** Reduced chi-square from which the report warns of a poor fit [1]. Chosen. */
inline constexpr double PoorReducedChi2 = 1.5;

/** Verdict on the line through the corrected variance: whether it describes a sensor, or the reason why not. */
enum class LineVerdict : std::uint8_t
{
  Identified,
  OneIntensity, ///< the pixels of the regression have one intensity
  NotRising     ///< the variance does not rise with the mean
};

/** Parameters of the sensor by the line through the corrected variance. */
struct NoiseParameters
{
  PolynomialFit             line;
  std::optional<FitQuality> quality;   ///< null: the number of frames, on which it depends, is not known
  std::optional<double>     offsetDn;  ///< mu [DN]; null: the flicker does not determine it
  std::optional<double>     darkestDn; ///< mean of the darkest pixels, with its error [DN]; null: not known
  LineVerdict               verdict{ LineVerdict::Identified };
  /** sigma^2 by gain, intercept and offset, also if it is not above 0 [DN^2]; 0 without an offset. */
  double   squaredReadNoiseDn2{ 0.0 };
  Quantity gain;               ///< [DN/e-]
  Quantity intercept;          ///< sigma^2 - g mu, with quantization noise [DN^2]
  Quantity offset;             ///< [DN]
  Quantity readNoise;          ///< [DN]
  Quantity readNoiseElectrons; ///< [e-]

  /** Returns whether the variance scatters so much about the line that no parameter is accepted. */
  bool
  IsScattered() const
  {
    return quality && quality->reducedChi2 > LargestReducedChi2;
  }
  /** Returns whether sigma^2 is not above 0, though the offset is known. */
  bool
  IsReadNoiseLost() const
  {
    return verdict == LineVerdict::Identified && offsetDn && !(squaredReadNoiseDn2 > 0.0);
  }
  /** Returns the level where sigma^2 is 0: the lowest offset [DN]. */
  double
  LowestOffsetDn() const
  {
    return -line.intercept / line.slope;
  }
  /** Returns whether the darkest pixels bound the offset from above. */
  bool
  HasBounds() const
  {
    return verdict == LineVerdict::Identified && darkestDn && *darkestDn > this->LowestOffsetDn();
  }
};

/** Returns gain, intercept, offset and read noise by the line through the corrected variance, as in section 3.3 of Sur
 * & Gredi\'ac 2015 (https://doi.org/10.1137/140977035). The slope is g, the intercept is sigma^2 - g mu, and sigma^2 =
 * intercept + g mu if mu is known.
 *
 * \a offsetDn is mu [DN], or null if the flicker does not determine it. In that case offset and read noise are
 * not-identifiable. They have bounds from sigma^2 >= 0 and flux >= 0: -intercept/g <= mu <= \a darkestDn [DN]. A gain
 * that is not positive, or a line about which the variance of \a quality scatters by more than LargestReducedChi2,
 * contradicts the model: all parameters are failed.
 *
 * Quantization noise is not subtracted: intercept and total intercept are equal, as in the paper. */
SensorNoise_EXPORT NoiseParameters
EstimateParameters(const PolynomialFit &             line,
                   std::optional<double>             offsetDn,
                   std::optional<double>             darkestDn,
                   const std::optional<FitQuality> & quality = std::nullopt);

/** Result of pass 3 of the published method. */
struct CorrectedMaps
{
  std::vector<double>       variance; ///< variance of the corrected stack [DN^2]; empty: the stack cannot be measured
  std::vector<std::uint8_t> pixelUse; ///< values of PixelUse
};

/** Results of all passes of the published method, from which its estimate is made. */
struct PublishedFindings
{
  const PublishedSettings & settings;
  const FrameGeometry &     geometry;
  std::size_t               frames;
  const PublishedScene &    scene;
  const FlickerEstimate &   flicker;
  const CorrectedMaps &     corrected;
};

/** Largest deviation of the corrected variance from its line, half way between dark and bright, without a warning,
 * relative to the line [1]. Chosen. */
inline constexpr double LargestCurvedFraction = 0.03;

/** Estimates of the published method from the results of its passes, without messages. */
struct PublishedEstimate
{
  Quantity flickerSd;           ///< [1]
  Quantity vibrationSdX;        ///< [pixel]
  Quantity vibrationSdY;        ///< [pixel]
  Quantity vibrationCovariance; ///< [pixel^2]
  double   contrastDn{ 0.0 };   ///< level of the bright set minus level of the dark set [DN]
  double   neededDn{ 0.0 };     ///< contrast that is needed for a line [DN]
  /** Parameters of the sensor; null: the contrast is too small. */
  std::optional<NoiseParameters> parameters;
  /** Significant deviation of the corrected variance from its line, half way between dark and bright, relative to the
   * line, if it is above LargestCurvedFraction [1]; null: it is not. */
  std::optional<double> curvedFraction;

  /** Returns whether the flicker determines the offset. */
  bool
  HasFlicker() const
  {
    return flickerSd.status == EstimateStatus::Identified;
  }
};

/** Decides on every quantity by the results of the passes; the scene must be measurable. */
SensorNoise_EXPORT PublishedEstimate
EstimatePublished(const PublishedFindings & found, const ParallelFor & parallelFor);

/** Returns the report of the published method. It has values and statuses, but no standard errors or intervals: the
 * paper gives none for a stack, and the errors of an ordinary regression would hide its bias. */
SensorNoise_EXPORT Report
MakePublishedReport(const PublishedFindings & found, const ParallelFor & parallelFor);

/** Copies the parameters and the quality of the fit to \a report, and warns of findings that contradict them. */
SensorNoise_EXPORT void
FileParameters(Report & report, const NoiseParameters & parameters);

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
  /** Whether the noise of a sample is kept for the planes of a mosaic. */
  static constexpr bool HasSample = false;

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
