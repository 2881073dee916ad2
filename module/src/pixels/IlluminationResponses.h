// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_IlluminationResponses_h
#define sensornoise_pixels_IlluminationResponses_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

/** \file
 * The level at which the lines of many tiles cross zero together. */

namespace sensornoise
{

class PixelCoordinates;
struct ReferenceFrame;
struct VarianceLine;

/** The projected stack and the quantities needed to analyse the illumination pixel by pixel. */
struct IlluminationResponses
{
  const ReferenceFrame &            frame;
  const PixelCoordinates &          coordinates;
  std::size_t                       factors; ///< number of illumination components, which are the first coordinates
  const VarianceLine &              line;
  const std::vector<std::uint8_t> & mask;
  double                            centreDn;  ///< level that is subtracted from the means [DN]
  double                            darkestDn; ///< darkest quantile of the means [DN]
  double                            rangeDn;   ///< brightest minus darkest quantile of the means [DN]
};

/** Number of the terms of a surface in a tile: 1 and I, the mean minus the centre, and both times the place (x, y) in
 * the tile; and of a curved one, which has both times x^2, x y and y^2, too. */
inline constexpr int LinearTerms = 6;
inline constexpr int CurvedTerms = 2 * LinearTerms;

/** Terms of a curved surface: 1, I, x, y, x I, y I, then x^2, x y and y^2, and then these times I. */
using CurvedSurface = Eigen::Matrix<double, CurvedTerms, 1>;

/** The part of motion that is correlated with the illumination by chance. */
struct MotionLeakage
{
  /** Response for each derivative, as rows, to each illumination component, as columns [pixel]. */
  Eigen::MatrixXd kappa;
  /** Whether the derivatives along x and y explain more of the responses in single tiles than chance does: parts of the
   * scene move by themselves, and no tile determines an offset. */
  bool isMotionLocal{ false };
};

/** Estimates the leakage of motion into the responses: kappa_k times the derivatives of first and second order, with
 * kappa common to the frame. It is estimated against lines in the mean that are free in every 8 x 8 tile and whose
 * coefficients vary linearly over it (Frisch & Waugh 1933), so that local illumination does not bias it. Even
 * derivatives resemble the mean locally, so their leakage would shift the offset. */
SensorNoise_EXPORT MotionLeakage
EstimateMotionLeakage(const IlluminationResponses & data, const ParallelFor & parallelFor = SerialFor);

/** Dark offset from the responses of the pixels to the illumination components. */
struct LocalOffset
{
  double offset{ 0.0 };                                            ///< offset minus the centre [DN]
  double standardError{ std::numeric_limits<double>::infinity() }; ///< standard error of the offset [DN]
  /** Lower end of the 95 % interval, minus the centre [DN]; infinite: not bounded. */
  double low{ -std::numeric_limits<double>::infinity() };
  /** Upper end of the 95 % interval, minus the centre [DN]; infinite: not bounded. */
  double high{ std::numeric_limits<double>::infinity() };
  /** Dispersion of the lines about the common zero, over their noise [1]; 1 if only noise separates them. */
  double      phi{ 1.0 };
  std::size_t tiles{ 0 };           ///< number of tiles that determine a line
  bool        doLinesMeet{ false }; ///< whether they cross zero at one level, up to a small dispersion
  /** Whether parallel lines explain more, in any partition: the flicker is the same everywhere, and the level that does
   * not flicker differs from place to place, as by a steady light source. */
  bool areParallel{ false };
};

/** Estimates the dark offset where the illumination is local, from the responses without motion, which leaks into them
 * by \a kappa. The response of a pixel
 * to an illumination component is S_j = rho_j (mean - mu), with rho_j nearly linear or quadratic over a tile. Without
 * the slopes and curvature of rho_j, the lines of all tiles and components cross zero at mu. Tiles of 8 to 64 pixels
 * and strips of rows are tried. Linear terms do not suffice where curvature is significant. Where rho_j varies even
 * more within tiles, their lines do not meet in one zero. Among the fits whose lines meet, the fit with the smallest
 * error is used that agrees with the fits of larger errors (Lepski 1990). The dispersion of the lines widens the error.
 * If parallel lines explain more, the level that does not flicker differs between tiles, and the lines do not meet.
 * Null if no tile determines a line. Estimator.md, 3.7. */
SensorNoise_EXPORT std::optional<LocalOffset>
FindLocalOffset(const IlluminationResponses & data,
                const Eigen::MatrixXd &       kappa,
                const ParallelFor &           parallelFor = SerialFor);

/** Sums that give the standard deviation over time of local illumination for any offset. */
struct SensorNoise_EXPORT LocalFlicker
{
  double energy{ 0.0 }; ///< sum over the pixels of sum_j (S_j^2 / noise - 1), over the illumination components j [1]
  double w{ 0.0 };      ///< sum of the weights w = 1 / noise [1/DN^2]
  double wI{ 0.0 };     ///< sum of w I, where I is the mean minus the centre [1/DN]
  double wII{ 0.0 };    ///< sum of w I^2 [1]
  double frames{ 0.0 }; ///< number of frames T

  /** Returns the root mean square over the frame of the standard deviation of the illumination over time, relative to
   * its mean [1]: sqrt(sum w sum_j (S_j^2 - noise) / ((T - 1) sum w q^2)), where q is the mean above \a offset.
   * \a offset is relative to the centre [DN]. */
  double
  Sd(double offset) const;
};

/** Computes the sums over the pixels of the mask. */
SensorNoise_EXPORT LocalFlicker
SumLocalFlicker(const IlluminationResponses & data);

/** Returns whether each further illumination component is one line a + b mean over the whole frame. Then a common
 * offset drifts, and there is no second light source that changes. */
SensorNoise_EXPORT bool
IsOffsetDrift(const IlluminationResponses & data);

/** Sums for the lines of a tile in which the illumination may have gradients, one for each response. They are the Gram
 * matrix of 1 and I, the mean minus the centre, corrected for the noise of the means, and for each response z the sums
 * r1 = sum w z and r2 = sum w I z.
 */
struct TileLines
{
  double              g11{ 0.0 };
  double              g12{ 0.0 };
  double              g22{ 0.0 };
  std::vector<double> r1;
  std::vector<double> r2;

  double
  Determinant() const
  {
    return g11 * g22 - g12 * g12;
  }
  /** Returns the inverse variance of the slope of a line that crosses zero at \a m. */
  double
  Precision(double m) const
  {
    return g22 - 2.0 * m * g12 + m * m * g11;
  }
};

/** Returns the sum of squares of the responses that lines through zero at \a m explain. */
double
Explained(const std::vector<TileLines> & tiles, double m);

/** Returns the zero that explains most, within \a range of \a start. */
double
FindCommonZero(const std::vector<TileLines> & tiles, double start, double range);

/** Sums for the error of a common zero. */
struct ZeroErrors
{
  double full{ 0.0 };        ///< sum of squares that free lines explain
  double information{ 0.0 }; ///< information on the zero [1/DN^2]
  double scatter{ 0.0 };     ///< variance of this information [1/DN^4]
  double number{ 0.0 };      ///< number of lines
};

/** Returns the sums for the error of the common zero \a zero. */
ZeroErrors
SumErrors(const std::vector<TileLines> & tiles, double zero);

} // namespace sensornoise

#endif
