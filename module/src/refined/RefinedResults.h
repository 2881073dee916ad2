// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedResults_h
#define sensornoise_refined_RefinedResults_h

#include "SensorNoiseExport.h"
#include "correlation/ColourCovariance.h"
#include "correlation/FrameSample.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "moments/Exposures.h"
#include "pixels/IlluminationResponses.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/ProjectionSums.h"
#include "pixels/StaticVariance.h"
#include "pixels/VarianceLine.h"
#include "refined/FramePhotonTransfer.h"
#include "scene/ReferenceFrame.h"
#include "scene/StaticScene.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "series/Constants.h"
#include "series/FrameSums.h"
#include "series/FrameEquations.h"
#include "series/OffsetLine.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Difference of two offsets from the flicker: the mean of the offsets of parts of the frame, such as its halves, minus
 * the offset that is common to them. See FindPartOffsets(). */
struct SensorNoise_EXPORT PartOffsets
{
  double differenceDn{ 0.0 };
  double varianceDn2{ 0.0 }; ///< variance of the difference by noise [DN^2]; 0: nothing was compared
  /** Change of the gain [DN/e-] and the intercept [DN^2] by the differences of the offsets, beyond chance. */
  Eigen::Vector2d ofLine{ Eigen::Vector2d::Zero() };

  /** Returns the size of the difference beyond \a z standard deviations [DN], see SizeBeyondChance(). */
  double
  BeyondChanceDn(double z) const;
};

/** Compares the offset of \a line with the offsets of the halves and the quadrants of the frame, which have one
 * flicker. Amplifiers of unlike offset move the common offset where their parts have unlike levels, and do not move the
 * offsets of the parts. They also move the line of \a variance, which takes all levels for signal. Returns the largest
 * difference, and the largest change of the line. Estimator.md, 3.3. */
SensorNoise_EXPORT PartOffsets
FindPartOffsets(const FrameSums &      sums,
                const OffsetLine &     line,
                const MotionSeries &   motion,
                const StaticVariance & variance,
                const ParallelFor &    parallelFor);

/** Temporal components that are re-estimated with the noise of the third pass: illumination and motion in the report.
 */
struct ReestimatedComponents
{
  OffsetLine   line; ///< offset and flicker
  MotionSeries motion;
  double       motionPhi{ 1.0 }; ///< dispersion of the frames over all gradient classes [1]
  /** Relative errors of the shifts by least squares along x and y, see ScaleErrorsOf() [1]. */
  Eigen::Vector2d                 scaleErrors{ Eigen::Vector2d::Zero() };
  std::optional<InstrumentShifts> shifts;
  bool                            isOffsetDrift{ false }; ///< whether the local illumination is a drifting offset
  bool                            isMotionLocal{ false }; ///< see MotionLeakage
  std::optional<LocalOffset>      localOffset;            ///< only under local illumination
  LocalFlicker                    localFlicker;
  PartOffsets                     partOffsets; ///< only where the illumination is not local
};

/** Estimates offset, flicker and shifts again, with the noise that is now known: \a correctedVariance of each
 * pixel [DN^2], and the line. Reads no frames. The pixels' \a coordinates on the temporal components are needed only
 * under local illumination. */
SensorNoise_EXPORT ReestimatedComponents
ReestimateComponents(const FrameSums &        sums,
                     const SceneSeries &      series,
                     const PixelCoordinates & coordinates,
                     const StaticVariance &   variance,
                     const PixelMap &         correctedVariance,
                     const ParallelFor &      parallelFor);

/** Illumination that is specific to the rows of a frame, or to its columns where the frame is turned: by pulsed
 * illumination under a rolling shutter, or by interlaced frames. Estimator.md, 3.18. */
struct LineIllumination
{
  LineAxis axis{ LineAxis::Rows }; ///< whether it is specific to rows or to columns
  /** Mean square of its relative changes, see EstimateLineIlluminationChange() [1]: \a found before it is subtracted,
   * \a left after that. */
  MeasuredNumber found;
  MeasuredNumber left;
  /** Whether it was subtracted, and the number of pixels of the noise sample, which were measured without it. */
  bool        isSubtracted{ false };
  std::size_t pixels{ 0 };
  /** Variance by other changes of the illumination that remains in a pixel's variance, relative to it [1]; 0: none is
   * significant. */
  double remainingVariance{ 0.0 };

  /** Returns the name of such a line in messages. */
  std::string
  NameOfLine() const
  {
    return axis == LineAxis::Rows ? "row" : "column";
  }
};

/** Returns the relative increase of the slope of the variance by illumination changes of the mean square \a square [1].
 * They add \a square times q^2 to the variance at the signal q; \a signalDn is the signal of the brightest pixels
 * [DN], \a gain the gain [DN/e-]. Returns 0 if the increase is not significant, or less than \a least [1]. */
SensorNoise_EXPORT double
EffectOfLineIllumination(const MeasuredNumber & square, double signalDn, double gain, double least);

/** Returns the increase of a pixel's variance by local changes of the illumination, relative to it [1]; 0: not
 * significant, or too small to count. */
SensorNoise_EXPORT double
RestOfIllumination(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** Subtracts the noise and illumination of whole \a lines from \a residuals, whose pixels are \a chosen, and returns
 * the remaining squares. \a width is the width of the frame. Pixels outside of the sample are removed from \a chosen
 * and marked in \a pixelUse. */
SensorNoise_EXPORT ReplacedSquares
SubtractLineIllumination(LineIllumination &          lines,
                         NoiseResiduals &            residuals,
                         std::size_t                 width,
                         std::vector<std::uint8_t> & chosen,
                         std::vector<std::uint8_t> & pixelUse,
                         const ParallelFor &         parallelFor);

/** Charge in the dark frames that differs from place to place, see FindDarkCharge(), or from pixel to pixel, see
 * FindPixelCharge(). */
struct SensorNoise_EXPORT DarkCharge
{
  MeasuredNumber slope;    ///< slope of the variance over the level of the dark frames [DN]; charge has the gain
  double         spreadDn; ///< mean level above the darkest tiles, or mean difference between two pixels [DN]

  /** Returns the mean variance of the charge, beyond chance: spreadDn times the slope [DN^2]. Returns 0 if the slope is
   * not explained by charge. \a gain is the gain of the frames [DN/e-]. */
  double
  VarianceDn2(double gain) const;
};

/** Charge in the dark frames, over the frame and between pixels. */
struct SensorNoise_EXPORT DarkCharges
{
  std::optional<DarkCharge> ofPlaces{}; ///< see FindDarkCharge(); null: not known
  std::optional<DarkCharge> ofPixels{}; ///< see FindPixelCharge(); null: not known

  /** Returns the variance of both, which add [DN^2]; see DarkCharge::VarianceDn2(). */
  double
  VarianceDn2(double gain) const;
};

/** Results of the passes of the refined method, from which its report is made. */
struct RefinedResults
{
  const RefinedSettings &       settings;
  const StaticScene &           scene;             ///< from the first pass
  const SceneSeries &           series;            ///< from the second pass
  const StaticVariance &        variance;          ///< from the third pass
  const ReestimatedComponents & reestimated;       ///< from the sums of the second pass, with the noise from the third
  const std::vector<double> &   correctedVariance; ///< NaN where it was not computed [DN^2]
  double                        blackDn{ 0.0 };    ///< see BlackLevel()
  NoiseCorrelation              correlation{};     ///< from the sample of the third pass
  FrameNoise                    frameNoise{};      ///< groups by the indices of the frames in the stack
  LineIllumination              lines{};           ///< from the sample of the third pass
  /** Results from the frames' exposures; null: none were given. */
  const ExposureFit * exposures{ nullptr };
  /** Fraction of the signal in the dark frames, see FindDarkSignal() [1]; null: none. */
  std::optional<MeasuredNumber> darkSignal{};
  DarkCharges                   darkCharge{}; ///< charge in the dark frames

  /** Return a level of the mean frame in the frame of the lowest or the highest illumination factor, if the frames have
   * a photon transfer; else the level itself [DN]. */
  double
  InDarkestFrame(double levelDn) const
  {
    return variance.fromFrames.line.isDetermined
             ? this->InFrame(levelDn, *std::min_element(series.line.gamma.begin(), series.line.gamma.end()))
             : levelDn;
  }
  double
  InBrightestFrame(double levelDn) const
  {
    return variance.fromFrames.line.isDetermined
             ? this->InFrame(levelDn, *std::max_element(series.line.gamma.begin(), series.line.gamma.end()))
             : levelDn;
  }

  /** Returns whether the scene has one level, under strong changes of the illumination: its motion is not identifiable.
   */
  bool
  IsFlatUnderChange() const
  {
    return scene.changesStrongly && !(series.line.contrast > InSeries.leastContrast);
  }
  /** Returns whether the illumination changes differently over the frame. */
  bool
  HasLocalIllumination() const
  {
    return series.local.IsLocal() && !reestimated.isOffsetDrift;
  }
  /** Returns whether parts of the scene move by themselves, which looks like local illumination. Under strong changes
   * of the illumination the noise of bright places is too uneven for the test. */
  bool
  IsMotionLocal() const
  {
    return this->HasLocalIllumination() && reestimated.isMotionLocal && !scene.changesStrongly;
  }
  /** Returns whether slow noise, as behind noise reduction in time, may have made the temporal components of the local
   * illumination: they determine neither an offset nor a flicker. */
  bool
  MayLocalIlluminationBeNoise() const
  {
    return correlation.kind == NoiseKind::Temporal;
  }

private:
  double
  InFrame(double levelDn, double gamma) const
  {
    const double offsetDn = series.offset + scene.model.centreDn; // the offset to which gamma refers
    return offsetDn + std::max(0.0, 1.0 + gamma) * (levelDn - offsetDn);
  }
};

/** Returns the fraction of the scene's signal that the dark frames contain, as of a shutter that was not closed [1].
 * Returns null if it is below InRefined.leastSignalOfDark or not significant, if too few places of the scene have
 * contrast, or if there are no maps of the dark frames.
 *
 * The estimate is the regression of the dark mean on the difference of bright and dark mean, within tiles of the
 * frame. Offsets of the pixels are in both means and cancel in the difference. \a pixelUse has a value of PixelUse for
 * each pixel. Estimator.md, 3.9. */
SensorNoise_EXPORT std::optional<MeasuredNumber>
FindDarkSignal(const std::optional<KnownOffset> & offset,
               const ReferenceFrame &             bright,
               const std::vector<std::uint8_t> &  pixelUse,
               const ParallelFor &                parallelFor);

/** Returns the charge in the dark frames, by dark current, glow or light, as the regression of the variance on the
 * level of their tiles. Returns null if there are no maps of the dark frames, or too few tiles. Estimator.md, 3.9. */
SensorNoise_EXPORT std::optional<DarkCharge>
FindDarkCharge(const std::optional<KnownOffset> & offset,
               const FrameGeometry &              geometry,
               const ParallelFor &                parallelFor);

/** Returns the charge that differs from pixel to pixel of the dark frames, as dark current does: the regression of the
 * difference of the variances on the difference of the levels of two pixels. Pixels far from the others have little
 * influence. Returns null if there are no maps of the dark frames, too few pixels, or a variance that quantization
 * hides. Estimator.md, 3.9. */
SensorNoise_EXPORT std::optional<DarkCharge>
FindPixelCharge(const std::optional<KnownOffset> & offset,
                const FrameGeometry &              geometry,
                const ParallelFor &                parallelFor);

/** Returns the black level [DN]: the given offset, else the offset from the flicker if it is identifiable, else the
 * lower clip level, or 0 if there is none. The latter two are limited to the darkest level. The black level separates
 * signal and offset approximately where the frames do not determine the offset. */
SensorNoise_EXPORT double
BlackLevel(const RefinedSettings &                  settings,
           const StaticScene &                      scene,
           const std::optional<const SceneSeries> & series);

/** Returns the variance of the quantization noise [DN^2]. */
inline double
QuantisationVariance(const StaticScene & scene)
{
  const double step = scene.summary.dnRange.quantisationStepDn;
  return step * step / 12.0;
}

/** Returns the mask of the usable pixels that have levels within the range of the settings, and that the dark frames do
 * not show as defective. The reasons for other pixels are written to \a pixelUse. */
SensorNoise_EXPORT std::vector<std::uint8_t>
PixelsOfVariance(const StaticScene & scene, const RefinedSettings & settings, std::vector<std::uint8_t> & pixelUse);

/** Removes pixels from \a chosen whose surroundings have another level, and marks them in \a pixelUse. Where frames
 * were filtered, the variance of these pixels is a mean over other neighbours than their level, and lies on no line.
 * \a line is the variance line of the frames without correction for filters. */
SensorNoise_EXPORT void
LeaveOutEdges(const ReferenceFrame &      frame,
              const VarianceLine &        line,
              std::vector<std::uint8_t> & chosen,
              std::vector<std::uint8_t> & pixelUse);

/** Results of the third pass: the noise of each pixel, and its spatial and temporal correlation. */
struct PixelNoise
{
  StaticVariance   variance;
  NoiseCorrelation correlation;
  FrameNoise       frames; ///< indices among the distinct frames
  LineIllumination lines;
  /** Variance without flicker and motion [DN^2]; 0 at pixels that are not usable; empty: there is no line. */
  PixelMap     correctedVariance;
  SampledNoise sampled; ///< noise of the sample; empty if it was not to be kept
};

/** Fits the variance and measures the noise correlation. If the correlation is strong, the mean variance of a tile
 * scatters more, and the pixels are tested a second time for a static scene. The remainder of \a quantisationNoise is
 * subtracted from the variance of the pixels before it is fitted, and \a quantisationNoise becomes a member of the
 * result. \a frameNumbers are the numbers of the frames of \a sample among the recorded frames. The noise of the frames
 * is compared only if \a isOneScene. The noise of the sample is kept if \a keepsSample. If too few pixels remain for a
 * line, only the variance is set.
 */
SensorNoise_EXPORT PixelNoise
MeasurePixelNoise(ResidualSquares                          squares,
                  FrameSample                              sample,
                  const std::vector<std::size_t> &         frameNumbers,
                  const StaticScene &                      scene,
                  const std::optional<const SceneSeries> & series,
                  const RefinedSettings &                  settings,
                  const QuantisationNoise &                quantisationNoise,
                  bool                                     isOneScene,
                  bool                                     keepsSample,
                  const ParallelFor &                      parallelFor);

} // namespace sensornoise

#endif
