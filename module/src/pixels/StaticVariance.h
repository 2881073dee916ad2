// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_StaticVariance_h
#define sensornoise_pixels_StaticVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/QuantisationNoise.h"
#include "pixels/GainByLines.h"
#include "pixels/GainByParts.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"
#include "base/Simd.h"
#include "base/Constants.h"
#include "pixels/ProjectedVariance.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Rejection model: the variance that pixels are tested against. It is a line times the deviation from the line that
 * the whole sensor has, for example by a non-linear response, and it includes the dispersion of the noise from pixel to
 * pixel. Pixels are not rejected for these. */
struct SensorNoise_EXPORT RejectionModel
{
  VarianceLine        line;   ///< the line, with the dispersion of the noise from pixel to pixel
  std::vector<double> levels; ///< levels in rising order [DN]; empty: the model is the line
  std::vector<double> ratios; ///< variance over the line at these levels [1]
  bool byNeighbours{ false }; ///< true: a pixel's level is its neighbours' mean, because its own offset is not signal
  /** Variance inflation of the mean of many pixels by the spatial noise correlation: the sum over all lags of the
   * squared correlation coefficients [1]. */
  double varianceInflation{ 1.0 };

  /** Returns the expected variance at the level \a meanDn [DN^2]. */
  double
  At(double meanDn) const
  {
    RunValues variance{};
    this->FillVariance(&meanDn, 1, variance);
    return variance[0];
  }
  /** Sets \a variance to the expected variance at the levels of \a pixels pixels, at most PixelsPerRun, with SIMD
   * instructions [DN^2]. */
  void
  FillVariance(const double * meanDn, std::size_t pixels, RunValues & variance) const
  {
    const VarianceLine own = line; // a copy that no pointer can alias, which SIMD instructions need
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] = own.At(meanDn[i]);
    }
    if (levels.empty())
    {
      return;
    }
    // The ratio is interpolated as a sum of its increments from each level to the next.
    RunValues ratio{};
    std::fill_n(ratio.begin(), pixels, ratios[0]);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k)
    {
      const double low = levels[k];
      const double high = levels[k + 1];
      const double slope = (ratios[k + 1] - ratios[k]) / (high - low);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        ratio[i] += slope * (std::max(low, std::min(high, meanDn[i])) - low);
      }
    }
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] *= ratio[i];
    }
  }
  /** Returns the level of pixel \a p of \a frame at which it is tested [DN]. */
  double
  LevelOf(const ReferenceFrame & frame, std::size_t p) const
  {
    return byNeighbours ? static_cast<double>(frame.neighbourMean[p]) : frame.mean[p];
  }
  /** Sets \a own to the levels of \a pixels pixels of \a frame from pixel \a first on [DN]. */
  void
  FillLevels(const ReferenceFrame & frame, std::size_t first, std::size_t pixels, RunValues & own) const
  {
    if (byNeighbours)
    {
      std::copy_n(frame.neighbourMean.data() + first, pixels, own.data());
    }
    else
    {
      std::copy_n(frame.mean.data() + first, pixels, own.data());
    }
  }
  /** Returns the degrees of freedom of a pixel's variance, reduced by the dispersion of the noise from pixel to
   * pixel. */
  double
  EffectiveDof(double dof, double varianceDn2) const
  {
    return line.EffectiveDof(dof, varianceDn2);
  }
};

/** Measures the deviation of the whole sensor from \a line. The sensor deviates everywhere, moving objects do so in
 * places. Therefore the frame is divided into tiles of 16 x 16 pixels, which are sorted into up to 16 bins of the
 * level. The deviation in a bin is the median excess of its smoother half of tiles. The dispersion of the noise from
 * pixel to pixel is the median over the dark tiles.
 *
 * The result is \a line alone if no deviation exceeds InPixels.leastDeviation by Significance.hint standard errors.
 * \a blackDn is as in EstimateFixedPattern(). */
SensorNoise_EXPORT RejectionModel
FitRejectionModel(const VarianceLine &              line,
                  const ProjectedVariance &         projected,
                  const std::vector<std::uint8_t> & mask,
                  double                            blackDn,
                  const ParallelFor &               parallelFor);

/** Limits beyond which a chi-square variable over its degrees of freedom deviates from 1 by more than
 * Significance.manyTests standard deviations. The cube root of the variable is about normal (Wilson & Hilferty
 * 1931). */
struct FarLimits
{
  double low;  ///< lower limit [1]
  double high; ///< upper limit [1]

  /** Computes the limits for \a freedom degrees of freedom, above 0. */
  explicit FarLimits(double dof)
  {
    const double s = 2.0 / (9.0 * dof);
    const double far = Significance.manyTests * std::sqrt(s);
    const double above = 1.0 - s + far;
    const double below = 1.0 - s - far;
    low = below * below * below;
    high = above * above * above;
  }
};

/** Test of a run of pixels, inside and outside the mask, against a rejection model, with SIMD instructions. */
struct TestedRun
{
  RunValues expected; ///< variance by the model at the pixel's level [DN^2]
  RunValues ratio;    ///< variance over the expected variance [1]
  RunValues isAbove;  ///< 1 where the ratio is beyond the upper limit of FarLimits, else 0
  RunValues isOff;    ///< 1 where the ratio is beyond either limit of FarLimits, else 0

  /** Tests \a pixels pixels, at most PixelsPerRun, from pixel \a first on. */
  void
  Test(const ProjectedVariance & projected, const RejectionModel & model, std::size_t first, std::size_t pixels)
  {
    const ReferenceFrame & frame = projected.GetFrame();
    const float * const    dof = projected.GetDof().data() + first;
    const VarianceLine     line = model.line;
    RunValues              level;
    model.FillLevels(frame, first, pixels, level);
    model.FillVariance(level.data(), pixels, expected);
    projected.GetVariance().Fill(first, pixels, ratio.data());
    for (std::size_t i = 0; i < pixels; ++i)
    {
      ratio[i] /= expected[i];
      const FarLimits far(line.EffectiveDof(dof[i], expected[i]));
      isAbove[i] = ratio[i] < far.high ? 0.0 : 1.0;
      isOff[i] = ratio[i] > far.low ? isAbove[i] : 1.0;
    }
  }
};

/** Result of the test of the roughness classes against a rejection model. */
struct ClassFit
{
  /** First rejected class; all rougher classes are rejected, too. */
  std::size_t         firstBad{ ProjectedVariance::Classes };
  std::vector<double> pixels; ///< number of pixels of each class
  /** Mean of variance over model of each class, without outliers [1]. */
  std::vector<double> ratio;
  /** Reduced chi-square of the ratios of the classes that are kept [1]. */
  double reducedChi2{ 1.0 };
  /** Whether the roughest class is below the model, by its error and InPixels.leastDeviation: motion would add most to
   * its variance, and takes none, so that the model is wrong at its levels. */
  bool isBelowModel{ false };
  /** Largest relative deviation of a class that fails, but is kept because the gain needs it [1]. */
  double keptDeviation{ 0.0 };
};

/** Compares the mean variance of each roughness class with the flat classes. A class fails if its mean is higher by
 * more than 3 standard errors and 0.15 %, or if its fraction of outliers is higher by 1 %. The first of two failing
 * classes in a row, and all rougher classes, are rejected. Estimator.md, 3.5. */
SensorNoise_EXPORT ClassFit
TestClasses(const ProjectedVariance &         projected,
            const RejectionModel &            line,
            const std::vector<std::uint8_t> & mask,
            const ParallelFor &               parallelFor);

/** Marks the pixels of \a mask whose variance is less than the variance of their shot noise alone, by more than chance.
 * They are no measurements: cameras replace defective pixels, and pixels of the autofocus, by the mean of their
 * neighbours. The noise that is common to these pixels and their neighbours would count twice in the sums over lags.
 * Empty if there are too few to matter. Estimator.md, 3.5. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindQuietPixels(const ProjectedVariance &         projected,
                const VarianceLine &              line,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor);

/** Marks the pixels of neighbourhoods that do not fit the rejection model. A neighbourhood is rejected if the mean
 * variance of its 15 x 15 pixels exceeds the model by 5 standard deviations and 4 %, or if it holds 15 % outliers.
 * Single noisy pixels are not marked; the fit trims them. Estimator.md, 3.5. */
SensorNoise_EXPORT std::vector<std::uint8_t>
RejectNeighbourhoods(const ProjectedVariance &         projected,
                     const RejectionModel &            line,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor);

class ProjectedSquares;

/** Result of the third pass: the pixels that fit a static scene, and the line of their variance. */
struct StaticVariance
{
  /** The variance line, corrected for the noise of the means. Not determined: too few pixels are left, or they have one
   * intensity. */
  VarianceLine line;
  /** Largest fraction of the levels' variance that can be fixed-pattern noise. */
  FixedPatternEstimate pattern;
  /** The line by instrumental variables, see FitInstrumental(); not determined where the pattern is negligible and the
   * line does not contradict it. */
  VarianceLine instrumentalLine;
  /** The line from frames of unequal illumination, and their deviation from it, see FitFramePhotonTransfer(). Not
   * determined where the frames are about equal. */
  VarianceCurve fromFrames;
  /** Result of the test of the roughness classes. */
  ClassFit classes;
  /** Deviation of the variance from instrumentalLine, or from line where instrumentalLine is not determined. The pixels
   * are sorted by the means of their neighbours, or by the instrument where that leaves less than half of the
   * non-linearity. */
  VarianceCurve curve;
  /** Deviation from the same line with the pixels sorted by their own levels, by which two amplifiers differ. It has no
   * bins if \a curve follows its line. */
  VarianceCurve ofOwnLevels;
  /** The parts of the frame whose gains differ. The lines then describe the variance divided by the ratios of these
   * parts. */
  GainByParts parts;
  /** The columns and rows whose gains differ, where no pattern of phases was found. */
  LinesOfSensor lines;
  /** Quantization noise of companded data. Its remainder has been subtracted from all of the above; its line has not,
   * see SubtractQuantisationLine(). */
  QuantisationNoise quantisationNoise;
  /** 1: a pixel that fits a static scene. Includes outliers, which a fit trims. */
  std::vector<std::uint8_t> mask;
  /** Values of PixelUse. Pixels of the mask that the final fit trims are PixelUse::Outlier. */
  std::vector<std::uint8_t> pixelUse;
  /** Gain by which the variance of the pixels is corrected, see ProjectedVariance [DN/e-]. */
  double correctingGain{ 0.0 };
  /** Number of pixels whose use is PixelUse::NotStatic. */
  std::size_t notStatic{ 0 };
  /** Excess of the gain of these pixels over the gain of the others, relative to it [1]; 0: see ExcessOfLeftOut(). */
  double excessOfLeftOut{ 0.0 };
  /** Variance inflation by the spatial noise correlation, see RejectionModel [1]. */
  double varianceInflation{ 1.0 };
  /** Fraction of the sampled pixels that are computed from their neighbours, and left out [1]. */
  double interpolatedFraction{ 0.0 };
  /** Variance that the pixels may lack, relative to the variance [1]: because some pixels are computed from their
   * neighbours and were not found, and because a noise correlation of frames is too small to be corrected. */
  double lostVariance{ 0.0 };
};

/** Returns tiles of the measured variance of the pixels of \a mask. */
SensorNoise_EXPORT PartTiles
TilesOfMeasured(const ProjectedVariance &         projected,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor);

/** Returns the excess of the variance of the pixels that are PixelUse::NotStatic in \a pixelUse, over the line of
 * \a reference, relative to its shot noise [1]. It is a gain of their own if it is the same in all tiles, and does not
 * grow with the roughness of the surroundings: motion depends on the scene. 0 if it is not, or if there are few of
 * these pixels. Estimator.md, 3.15. */
SensorNoise_EXPORT double
ExcessOfLeftOut(const ProjectedVariance &         projected,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & pixelUse,
                const ParallelFor &               parallelFor);

/** Finds the pixels that fit a static scene, and fits the line of their variance, from the flat classes to the rough
 * ones. Neighbourhoods are tested before classes, because an object that moves across the frame has pixels in all
 * classes.
 *
 * \a pixelUse is the use of the pixels as known before; the use of the \a usable pixels is set. \a firstGain is
 * the gain by which the variances are corrected before the first line [DN/e-]; 0 where it is not known nearly. \a
 * offsetDn is the dark offset, or the darkest level if the offset is not known [DN];
 * \a blackDn is the dark offset, or a level that it is not below [DN]. \a varianceInflation is the variance inflation
 * by the spatial noise correlation, see RejectionModel [1]. If too few pixels are left, the line is not determined, and
 * the results that depend on it are missing. */
SensorNoise_EXPORT StaticVariance
FitStaticVariance(const ProjectedSquares &          squares,
                  const std::vector<std::uint8_t> & usable,
                  std::vector<std::uint8_t>         pixelUse,
                  double                            firstGain,
                  double                            offsetDn,
                  double                            blackDn,
                  const ParallelFor &               parallelFor,
                  double                            varianceInflation = 1.0);

} // namespace sensornoise

#endif
