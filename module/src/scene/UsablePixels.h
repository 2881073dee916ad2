// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_UsablePixels_h
#define sensornoise_scene_UsablePixels_h

#include "SensorNoiseExport.h"
#include "moments/FrameThumbnails.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "scene/Constants.h"
#include "sensornoise/FrameGeometry.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Comparison of the raw variance of the pixels of a cell with a model. */
enum class CellFit : std::uint8_t
{
  Unknown, ///< fewer than 8 pixels of the sample lie in it
  Fits,
  Below, ///< the variance is below the model
  Above  ///< the median variance, or the variance of many of its pixels, is above the model
};

/** All cells, compared with a model. The fractions are of the pixels of the known cells, and add up to 1. */
struct TileComparison
{
  std::vector<CellFit> fits;           ///< row by row
  double               fitting{ 0.0 }; ///< fraction that fits [1]
  double               below{ 0.0 };   ///< fraction below the model [1]
  double               above{ 0.0 };   ///< fraction above the model [1]
};

/** Test whether changes of the illumination explain the cells above a model: the signal of every pixel changes by the
 * same factor. */
struct IlluminationTest
{
  double explained{ 0.0 };  ///< fraction of the cells whose pixels are explained by one flicker per cell [1]
  double modulation{ 0.0 }; ///< square root of the ratio of the variance above the model to the squared level above the
                            ///< darkest level [1]
};

/** \class VarianceTiles
 * \brief Rectangles of the frame, at most 24 x 24 and at least 8 pixels wide, by which the raw variance is compared
 * with a model. The median of some 60 pixels yields the variance of a cell to a few per cent. */
class SensorNoise_EXPORT VarianceTiles
{
public:
  /** \a pixels are the pixels of \a sample, which must outlive the object; \a frames is the number of frames T. */
  VarianceTiles(const VarianceSample &           sample,
                const std::vector<std::size_t> & pixels,
                const FrameGeometry &            geometry,
                std::size_t                      frames);

  std::size_t
  Columns() const
  {
    return m_Columns;
  }
  std::size_t
  Rows() const
  {
    return m_Rows;
  }
  /** Returns the cell of pixel \a p of the frame. */
  std::size_t
  CellOfPixel(std::size_t p) const
  {
    const std::size_t x = p % m_Geometry.width;
    const std::size_t y = p / m_Geometry.width;
    return y * m_Rows / m_Geometry.height * m_Columns + x * m_Columns / m_Geometry.width;
  }
  /** Returns the cell of pixel \a i of the sample. */
  std::size_t
  CellOf(std::size_t i) const
  {
    return m_CellOf[i];
  }
  /** Compares the cells with the variance that a model predicts. */
  TileComparison
  Compare(const VariancePrediction & prediction) const;

  /** Returns whether the pixels of the cells of \a comparison that are above the model change independently of each
   * other: the means of these cells, \a variances, change as little as independent pixels let them. */
  bool
  AreIndependent(const TileComparison &            comparison,
                 const VariancePrediction &        prediction,
                 const std::vector<CellVariance> & variances) const;

  /** Tests whether changes of the illumination explain the cells of \a comparison that are above the model: a separate
   * flicker in every cell. A pixel is not explained if its variance differs by more than the factor \a largestRatio. */
  IlluminationTest
  TestIllumination(const TileComparison & comparison, const VariancePrediction & prediction, double largestRatio) const;

private:
  const VarianceSample & m_Sample;
  FrameGeometry          m_Geometry;
  std::size_t            m_Columns;
  std::size_t            m_Rows;
  double                 m_MedianRatio; // ratio of the median of a variance with T - 1 degrees of freedom to its
                                        // expectation
  std::vector<std::size_t> m_CellOf;    // cell of each pixel of the sample
};

/** Finds the part of the frame that a moving object crosses. Returns a map of the frame with 1 in the cells of this
 * part, else 0; empty if there is no moving object.
 *
 * A person who walks through a burst disturbs all pixels on the way, which may be most of the frame. A model of the
 * variance fitted to the majority then describes the person, and flicker and motion found with it are wrong. But a
 * moving object only adds variance. The model of the static scene therefore has no cells below it, and as many cells
 * as possible fit it; a third of the frame or less is enough.
 *
 * Nothing is searched where \a model, which was fitted to all usable pixels, explains 85 % of the frame and few cells
 * lie below it. Smaller objects are left to FindOutlierPixels() and to the third pass. Otherwise models are fitted to
 * parts of the frame: halves, thirds and ninths. Each is then extended over all cells that fit it. The cells above the
 * best model are the region, with their neighbours and the narrow islands between them. Local changes of the
 * illumination are not an object, see FindLocalIllumination(). Neither are parts of the sensor with more read noise:
 * an object moves many pixels together, and noise changes each by itself. So the means of the cells of the region,
 * \a cellVariances, do not change by more than independent pixels let them. Nothing is compared if \a cellVariances is
 * empty. Estimator.md, 3.2. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindTransientRegion(const ReferenceFrame &            frame,
                    const InitialNoiseModel &         model,
                    const std::vector<CellVariance> & cellVariances);

/** Returns whether each pixel can be used, or the reason why not, before any model of the noise: values of PixelUse.
 * \a valid is the map from which \a frame was made; \a userMask, if not empty, is 0 at pixels that are masked. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindPixelUse(const ReferenceFrame &            frame,
             const std::vector<std::uint8_t> & valid,
             const std::vector<std::uint8_t> & userMask,
             const ParallelFor &               parallelFor = SerialFor);

/** The usable pixels of a frame: without clipping, guard band and coarse quantization. */
struct UsablePixels
{
  std::vector<std::uint8_t> usable;        ///< 1: the pixel is usable
  std::vector<std::uint8_t> pixelUse;      ///< values of PixelUse
  double                    count{ 0.0 };  ///< number of usable pixels
  std::size_t               nearClip{ 0 }; ///< number of excluded pixels in the guard band
  std::size_t               coarse{ 0 };   ///< number of excluded pixels whose noise is below half a quantization step
  /** Number of the coarse pixels of companded digital numbers that are brighter than the centre; the fit does not need
   * them. */
  std::size_t coarseWhereBright{ 0 };
};

/** Excludes the pixels that clipping could affect (FindGuardBand), and pixels whose noise is below half a quantization
 * step, which hides it.
 * \param frameMeans means of the frames [DN], for the brightest and the darkest frame
 * \param pixelUse result of FindPixelUse()
 * \param darkestNoiseDn2 if given, the illumination changes strongly and the variance of \a frame is without these
 * changes; it is an upper bound of the noise variance in the darkest frame [DN^2] */
SensorNoise_EXPORT UsablePixels
ExcludeCoarseAndGuarded(const ReferenceFrame &        frame,
                        const InitialNoiseModel &     model,
                        const DnRange &               dnRange,
                        const std::vector<double> &   frameMeans,
                        std::vector<std::uint8_t>     pixelUse,
                        const ParallelFor &           parallelFor,
                        const std::optional<double> & darkestNoiseDn2 = std::nullopt);

/** Throws NothingToMeasure with WarningCode::CodesTooCoarse if the quantization step \a stepDn [DN] hides the noise of
 * more than a fifth of the pixels, without the bright ones of companded digital numbers. */
SensorNoise_EXPORT void
RequireFineQuantization(const UsablePixels & pixels, double stepDn);

/** Range of the illumination and the offset, estimated from the levels of the frames and a rough model. */
struct IlluminationRange
{
  double lowestDn{ 0.0 };        ///< mean of the darkest frame minus the mean of all frames [DN]
  double highestDn{ 0.0 };       ///< mean of the brightest frame minus the mean of all frames [DN]
  double lowestOffsetDn{ 0.0 };  ///< smallest possible offset [DN]
  double highestOffsetDn{ 0.0 }; ///< largest possible offset, at most the mean of the darkest frame [DN]
  double lowestNoiseDn2{ 0.0 };  ///< upper bound of the noise variance in the darkest frame; may be infinite [DN^2]
  /** Fraction of the model's noise variance that is noise, at high levels; the rest is caused by the illumination [1].
   */
  double fractionOfNoise{ 1.0 };
  /** Whether motion changes a frame in proportion to its brightness. A weak change moves the extreme by less than the
   * distance in standard deviations allows for. */
  bool scalesMotion{ false };
};

/** Marks the pixels that clipping could affect, whether it did or not: those whose expected extreme reaches a clip
 * level. The expected extreme is in the brightest or darkest frame, with the lowest or the highest offset, \a sds
 * standard deviations of the noise at the level that is reached.
 *
 * Excluding only the pixels that happened to clip would select by the noise: the variance of the others would be too
 * small (estimator.md, 3.2). */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &    frame,
              const InitialNoiseModel & model,
              const DnRange &           dnRange,
              const IlluminationRange & range,
              const ParallelFor &       parallelFor,
              double                    sds = InScene.guardBandSds);

/** Marks outlier pixels, which are no part of a static scene as far as one pass determines it. Returns 1 where the
 * variance is far above the model, 2 where this is true of many of the 7 x 7 neighbours, else 0. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindOutlierPixels(const ReferenceFrame & frame, const InitialNoiseModel & model, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
