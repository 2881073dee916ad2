// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Emva1288_h
#define sensornoise_Emva1288_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportPage.h"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/** \file
 * Evaluation of a camera by EMVA Standard 1288, Release 4.0 Linear (2021): flat fields and dark frames at several
 * exposures. Numbers in parentheses are equations of this release. */

namespace sensornoise
{

/** Spatial variances of the mean image of a series [DN^2]. Temporal noise that remains in the mean is subtracted: a
 * variance may be below 0. */
struct EmvaSpatialVariance
{
  std::size_t columns{ 0 };         ///< columns of the image that is evaluated [pixel]
  std::size_t rows{ 0 };            ///< rows of the image that is evaluated [pixel]
  double      measuredDn2{ 0.0 };   ///< variance of the mean image, with its temporal noise (35)
  double      stackDn2{ 0.0 };      ///< mean over the pixels of their temporal variance (65)
  double      totalDn2{ 0.0 };      ///< spatial variance of the pixels (36)
  double      columnMeanDn2{ 0.0 }; ///< variance of the means of the columns (41)
  double      rowMeanDn2{ 0.0 };    ///< variance of the means of the rows (41)
  double      columnDn2{ 0.0 };     ///< part of the columns (42)
  double      rowDn2{ 0.0 };        ///< part of the rows (42)
  double      pixelDn2{ 0.0 };      ///< part of the single pixels (42)
};

/** Statistics of the frames of one exposure. */
struct EmvaSeries
{
  double exposure{ 0.0 }; ///< exposure time, or any other number that is proportional to the exposure, 0 or more
  /** Mean number of photons that reach a pixel during the exposure [photon]; null: not known. Dark frames: 0. */
  std::optional<double> photons;
  bool                  isDark{ false };            ///< whether the sensor was covered
  std::size_t           width{ 0 };                 ///< columns of a frame [pixel]
  std::size_t           height{ 0 };                ///< rows of a frame [pixel]
  std::size_t           frames{ 0 };                ///< number of frames, 2 or more
  double                meanDn{ 0.0 };              ///< mean over pixels and frames (16) [DN]
  double                frameSquaresDn2{ 0.0 };     ///< sum over frames of (mean of the frame - meanDn)^2 [DN^2]
  double                temporalVarianceDn2{ 0.0 }; ///< temporal variance (18) [DN^2]
  double                highestDn{ 0.0 };           ///< largest digital number in the frames [DN]
  double                fractionAtHighest{ 0.0 };   ///< fraction of all values that equal highestDn [1]
  EmvaSpatialVariance   unfiltered;                 ///< spatial variances of the mean image
  std::optional<EmvaSpatialVariance> highpass;      ///< spatial variances after the highpass filter (8.1); null: the
                                                    ///< frames are smaller than 21 x 21 pixels
};

/** \class EmvaSeriesSums
 * \brief Adds up the frames of one exposure, one at a time, to the statistics of EmvaSeries.
 *
 * The temporal variance of a pair is (18): half of the mean square of the difference, less half of the square of the
 * difference of the means. The variance of more frames is the mean of this value over all pairs.
 *
 * It holds four frames of doubles, for any number of frames. The result has the same bits for any number of threads. */
class SensorNoise_EXPORT EmvaSeriesSums
{
public:
  /** Makes sums for frames of this size. Throws std::invalid_argument if a size is below 3. */
  EmvaSeriesSums(std::size_t width, std::size_t height);

  /** Adds a frame, row after row [DN]. TPixel is unsigned char, unsigned short, short, float or double. Throws
   * std::invalid_argument if a value is not finite. */
  template <typename TPixel>
  void
  AddFrame(const TPixel * frame, const ParallelFor & parallelFor = SerialFor);

  /** Returns the statistics of the frames so far; exposure, photons and isDark are left as they are by default. Throws
   * std::invalid_argument if there are fewer than two frames. */
  EmvaSeries
  Measure(const ParallelFor & parallelFor = SerialFor) const;

private:
  std::size_t         m_Width;
  std::size_t         m_Height;
  std::vector<double> m_Sum;                    // sum of each pixel over the frames [DN]
  std::vector<double> m_SquareSum;              // sum of the squares of each pixel over the frames [DN^2]
  std::vector<double> m_Frame;                  // the last frame [DN]
  std::vector<double> m_FrameMeans;             // mean of each frame [DN]
  double              m_HighpassSquares{ 0.0 }; // sum of squares of the filtered frames over frames and pixels [DN^2]
  double              m_HighestDn{ -std::numeric_limits<double>::infinity() };
  double              m_AtHighest{ 0.0 }; // number of values that equal m_HighestDn
};

/** Settings of the evaluation. */
struct EmvaSettings
{
  /** Quantization step [DN], above 0: the variance of the quantization is its square over 12. The standard has 1. */
  double quantizationStepDn{ 1.0 };
  /** Bit depth of the digital numbers [bit], at most 16; 0: not known. It decides whether the brightest frames are
   * saturated. Digital numbers beyond its range are an error. */
  unsigned int bitDepth{ 0 };
  /** Unit of the exposures: "s", or "" if it is not known. The dark current is given per unit of the exposure. */
  std::string exposureUnit;
};

/** One exposure in the photon transfer curve. */
struct EmvaPoint
{
  double                exposure{ 0.0 };      ///< as in EmvaSeries
  std::optional<double> photons;              ///< as in EmvaSeries [photon]
  std::size_t           frames{ 0 };          ///< number of frames
  double                meanDn{ 0.0 };        ///< mean level [DN]
  double                signalDn{ 0.0 };      ///< mean level, less the mean level of the dark frames [DN]
  double                varianceDn2{ 0.0 };   ///< temporal variance [DN^2]
  double                excessDn2{ 0.0 };     ///< temporal variance, less the variance of the dark frames [DN^2]
  bool                  isInGainFit{ false }; ///< whether the system gain is fitted to it: up to 70 % of saturation
  /** Deviation from the line of the linearity (62) [%]; null: outside of the range of 5 to 95 % of saturation. */
  std::optional<double> deviationPercent;
  double                snr{ 0.0 }; ///< signal over the temporal noise, as measured [1]
  std::optional<double> modelSnr;   ///< signal-to-noise ratio of the linear model (21) [1]
  std::optional<double> totalSnr;   ///< modelSnr with the spatial non-uniformity (69) [1]
};

/** Remark on an evaluation. */
struct EmvaNote
{
  std::string code;    ///< stable name, for programs
  std::string message; ///< one sentence, for people, with the numbers found and expected
};

/** All results of an evaluation. EmvaQuantityList() has symbol, unit and equation of each quantity. */
struct EmvaReport
{
  std::size_t             width{ 0 };           ///< columns of a frame [pixel]
  std::size_t             height{ 0 };          ///< rows of a frame [pixel]
  EmvaSettings            settings;             ///< settings of the evaluation
  std::vector<EmvaSeries> series;               ///< statistics of all series, as they were given
  std::vector<EmvaPoint>  points;               ///< photon transfer curve, in the order of the exposures
  std::size_t             saturationPoint{ 0 }; ///< number of the point with the largest variance, from 0

  Quantity gain;                    ///< system gain K (50) [DN/e-]
  Quantity weightedGain;            ///< slope of the weighted line of variance against mean [DN/e-]
  Quantity weightedIntercept;       ///< intercept of this line: variance at level 0 [DN^2]
  Quantity weightedReducedChi2;     ///< reduced chi-square of this line [1]
  Quantity responsivity;            ///< responsivity R (49) [DN/photon]
  Quantity quantumEfficiency;       ///< quantum efficiency (52) [%]
  Quantity darkSignal;              ///< dark signal at the lowest exposure [DN]
  Quantity darkNoise;               ///< temporal dark noise sigma_y.dark [DN]
  Quantity darkNoiseElectrons;      ///< temporal dark noise sigma_d, without quantization noise (53), (54) [e-]
  Quantity saturationSignal;        ///< signal at saturation [DN]
  Quantity saturationPhotons;       ///< saturation capacity mu_p.sat [photon]
  Quantity saturationElectrons;     ///< saturation capacity mu_e.sat [e-]
  Quantity thresholdPhotons;        ///< absolute sensitivity threshold mu_p.min (26) [photon]
  Quantity thresholdElectrons;      ///< absolute sensitivity threshold mu_e.min (26) [e-]
  Quantity largestSnr;              ///< maximum signal-to-noise ratio (55) [1]
  Quantity dynamicRange;            ///< dynamic range (28) [1]
  Quantity linearityError;          ///< linearity error LE (63) [%]
  Quantity linearityErrorCorrected; ///< linearity error without the contribution of noise [%]
  Quantity lowestDeviation;         ///< lowest deviation from the line [%]
  Quantity highestDeviation;        ///< highest deviation from the line [%]
  Quantity linearitySlope;          ///< slope of the line of the linearity (60) [DN per photon, or unit of exposure]
  Quantity linearityOffset;         ///< offset of the line of the linearity (59) [DN]
  Quantity darkCurrent;             ///< dark current from the mean [DN per unit of exposure]
  Quantity darkCurrentElectrons;    ///< dark current from the mean [e- per unit of exposure]
  Quantity darkCurrentOfVariance;   ///< dark current from the variance [e- per unit of exposure]
  Quantity dsnu;                    ///< DSNU1288 (66) [e-]
  Quantity dsnuColumn;              ///< part of the columns [e-]
  Quantity dsnuRow;                 ///< part of the rows [e-]
  Quantity dsnuPixel;               ///< part of the pixels [e-]
  Quantity prnu;                    ///< PRNU1288 (67) [%]
  Quantity prnuColumn;              ///< part of the columns [%]
  Quantity prnuRow;                 ///< part of the rows [%]
  Quantity prnuPixel;               ///< part of the pixels [%]
  Quantity gainThroughOrigin;       ///< system gain of a line without offset, as the package emva1288 has it [DN/e-]
  Quantity dsnuUnfiltered;          ///< DSNU1288 without the highpass filter [e-]
  Quantity prnuUnfiltered;          ///< PRNU1288 without the highpass filter [%]

  std::optional<std::size_t> darkStack;   ///< series of the DSNU, by its place in `series`; null: none
  std::optional<std::size_t> brightStack; ///< series of the PRNU, by its place in `series`; null: none
  std::vector<EmvaNote>      notes;       ///< remarks
};

/** Evaluations of the planes of a mosaic of colour filters, each by itself. */
struct EmvaMosaicReport
{
  BayerPattern              pattern{ BayerPattern::RGGB }; ///< colours of the upper left 2 x 2 pixels
  std::array<EmvaReport, 4> planes;                        ///< in the order of BayerPlanes
};

/** Description of one quantity of the evaluation. */
struct EmvaQuantityEntry
{
  const char * section;  ///< "sensitivity", "linearity", "dark_current", "spatial" or "comparison"
  const char * name;     ///< name in the JSON record
  const char * symbol;   ///< symbol of the standard; "": it has none
  const char * label;    ///< label in the table
  const char * unit;     ///< unit; "unit" stands for the unit of the exposure
  const char * equation; ///< number of the equation or section of the standard; "": this project's own
  Quantity EmvaReport::* quantity;
};

/** Returns all quantities, in the order of the standard. Table, JSON and documentation go by it. */
SensorNoise_EXPORT const std::vector<EmvaQuantityEntry> &
EmvaQuantityList();

/** Evaluates series of flat fields and dark frames.
 *
 * The photon transfer curve has the flat series in the order of their photons, or of their exposures. Where one
 * exposure has a pair and a longer series, the pair is in the curve, and the longer series gives the non-uniformity, as
 * the standard asks. The dark level and the dark variance of a flat series are taken from the dark series of its
 * exposure. Without such a series they are interpolated linearly between the exposures of the dark series, and constant
 * outside. Saturation is the point with the largest variance.
 *
 * Throws std::invalid_argument if series differ in the size of their frames, an exposure is below 0 or not finite, or
 * there is no dark series or fewer than three flat exposures. It also throws if the flat series have no temporal noise,
 * or are darker than the dark series. Quantities that the series do not determine have no value. */
SensorNoise_EXPORT EmvaReport
EvaluateEmva1288(const std::vector<EmvaSeries> & series, const EmvaSettings & settings = {});

/** Returns the evaluation as a table for people; of a mosaic, a table of each plane. */
SensorNoise_EXPORT std::string
MakeTable(const EmvaReport & report);
SensorNoise_EXPORT std::string
MakeTable(const EmvaMosaicReport & report);

/** Returns the evaluation as one HTML page, which needs no network and has no scripts: the main results, the photon
 * transfer curve with the notes, all quantities in the order of the standard, the signal-to-noise ratio, the linearity,
 * all exposures, the settings, and the hash of the frames, if \a input has it. */
SensorNoise_EXPORT std::string
ToHtml(const EmvaReport & report, const PageTitle & title = {}, const std::optional<InputRecord> & input = {});

/** Returns the evaluations of a mosaic as one HTML page: the main results of all planes as a table, and the content of
 * the page of each plane. */
SensorNoise_EXPORT std::string
ToHtml(const EmvaMosaicReport & report, const PageTitle & title = {}, const std::optional<InputRecord> & input = {});

/** Returns the photon transfer curve as an SVG file; of a mosaic, the curve of the plane G1. */
SensorNoise_EXPORT std::string
ToSvg(const EmvaReport & report);
SensorNoise_EXPORT std::string
ToSvg(const EmvaMosaicReport & report);

/** Name and version of the schema of the JSON record. */
inline constexpr const char * EmvaSchema = "itk-sensornoise-emva1288/1";

/** Returns the evaluation as a JSON object, schema "itk-sensornoise-emva1288/1". Unknown values are null. */
SensorNoise_EXPORT std::string
ToJson(const EmvaReport & report);

/** Name and version of the schema of the JSON record of a mosaic. */
inline constexpr const char * EmvaMosaicSchema = "itk-sensornoise-emva1288-mosaic/1";

/** Returns the evaluations of a mosaic as a JSON object, schema "itk-sensornoise-emva1288-mosaic/1". Its member
 * `planes` has the record of each plane under the name of the plane, and `bayer` is the pattern. */
SensorNoise_EXPORT std::string
ToJson(const EmvaMosaicReport & report);

/** Returns the evaluation as XML with the names and units of the Python package emva1288, version 1.0.2. Each value has
 * its section, its symbol and its unit. Exposure times count as seconds. */
SensorNoise_EXPORT std::string
ToXml(const EmvaReport & report);

/** Returns the evaluations of a mosaic as XML: the element `mosaic` has an element `plane` with the name of each plane,
 * which has the XML of the plane. */
SensorNoise_EXPORT std::string
ToXml(const EmvaMosaicReport & report);

} // namespace sensornoise

#endif
