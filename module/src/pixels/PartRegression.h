// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PartRegression_h
#define sensornoise_pixels_PartRegression_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "pixels/Constants.h"
#include "pixels/PartTiles.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class PartRegression
 * \brief Robust regression of the excess variance of tiles on the parts of a frame.
 *
 * The model is excess = s d_part + (1 - s) h_part + curve(level). s is the fraction of the common line's variance that
 * is shot noise. d is the relative excess of the part's gain, and h the relative excess of its variance without signal.
 * The curve is common to all parts. Estimator.md, 3.15. */
struct SensorNoise_EXPORT PartRegression
{
  Partition             partition{ Partition::LeftRight };
  Eigen::Index          gains{ 0 };   ///< number of coefficients d, which come first
  Eigen::Index          darks{ 0 };   ///< number of coefficients h, which follow
  std::vector<double>   knotsDn;      ///< levels of the coefficients of the curve, which follow [DN]
  std::optional<double> stepDn;       ///< level of a step of the curve, the last coefficient [DN]; null: no step
  Eigen::VectorXd       theta;        ///< the coefficients [1]
  Eigen::MatrixXd       covariance;   ///< covariance of theta, scaled by the dispersion of the tiles [1]
  double                scale{ 1.0 }; ///< dispersion of the tiles over their sampling error, 1 or more [1]
  bool                  isDetermined{ false };

  /** Returns whether what differs is a smooth field over the frame. */
  bool
  IsSmooth() const
  {
    return partition == Partition::SmoothField;
  }

  /** Returns the products of Legendre polynomials at a place of the frame, of a total degree up to 4. \a x and \a y are
   * in units of the frame's width and height [1]. */
  static Eigen::VectorXd
  FieldAt(double x, double y);

  /** Returns the matrix that gives a number for each part when it is multiplied by theta: the mean over the part of the
   * quantity whose \a count coefficients start at \a first, d or h. */
  Eigen::MatrixXd
  ToParts(const std::vector<TileExcess> & tiles, Eigen::Index first, Eigen::Index count) const;

  /** Returns the Schwarz criterion: the robust loss with the dispersion \a common [1], plus the logarithm of the number
   * of tiles for each coefficient of the parts. The best model has the lowest criterion. */
  double
  Criterion(const std::vector<TileExcess> & tiles, double common) const;

  using Terms = std::vector<std::pair<Eigen::Index, double>>;
  /** Sets \a terms to the nonzero columns of a tile, with their values. */
  void
  FillTerms(const TileExcess & tile, Terms & terms) const;
};

/** Quantities that may differ between parts. */
enum class PartsDiffer : std::uint8_t
{
  InBoth,   ///< gain and variance without signal
  InGain,   ///< gain
  InTheDark ///< variance without signal, as by the read noise
};

/** Fits the parts of \a partition. */
SensorNoise_EXPORT PartRegression
FitParts(Partition partition, PartsDiffer differ, const std::vector<TileExcess> & tiles);

/** Fits one part that has all pixels. With \a stepDn the curve has a step at that level [DN], as with two amplifiers
 * that read every pixel. With more \a knots the curve follows a strongly non-linear response. */
SensorNoise_EXPORT PartRegression
FitUniform(const std::vector<TileExcess> & tiles,
           std::optional<double>           stepDn = std::nullopt,
           std::size_t                     knots = InParts.knots);

} // namespace sensornoise

#endif
