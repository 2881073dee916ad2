// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PartRegression_h
#define sensornoise_pixels_PartRegression_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "pixels/Constants.h"
#include "pixels/PartTiles.h"
#include "pixels/Partition.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class PartRegression
 * \brief A robust regression of the excess of the variance, tile by tile, on the parts of a frame.
 *
 * excess = s d_part + (1 - s) h_part + curve(level), with s the part of the common line's variance that is shot noise:
 * d is the relative excess of the part's gain, h that of its variance without signal, and the curve is what all parts
 * have in common at a level. Estimator.md, 3.15. */
struct SensorNoise_EXPORT PartRegression
{
  Partition             partition{ Partition::LeftRight };
  Eigen::Index          gains{ 0 }; ///< the first coefficients are d
  Eigen::Index          darks{ 0 }; ///< the next ones h
  std::vector<double>   knotsDn;    ///< levels of the curve's coefficients, which are the next
  std::optional<double> stepDn;     ///< level at which the curve has a step, the last coefficient; null: it has none
  Eigen::VectorXd       theta;
  Eigen::MatrixXd       covariance; ///< of theta, with the scatter of the tiles
  double                scale{ 1.0 };
  bool                  isDetermined{ false };

  bool
  IsSmooth() const
  {
    return partition == Partition::SmoothField && gains > 1;
  }

  /** Products of Legendre polynomials of the place, up to the fourth degree together. */
  static Eigen::VectorXd
  FieldAt(double x, double y);

  /** The excess of the gain of each part, as a matrix times theta. */
  Eigen::MatrixXd
  ToParts(const std::vector<TileExcess> & tiles) const;

  /** Schwarz' criterion: the robust loss with a common \a scale, and the logarithm of the number of tiles for every
   * coefficient of the parts. The model of the lowest criterion is the best. */
  double
  Criterion(const std::vector<TileExcess> & tiles, double common) const;

  using Terms = std::vector<std::pair<Eigen::Index, double>>;
  /** The columns of a tile that are not 0. */
  void
  FillTerms(const TileExcess & tile, Terms & terms) const;
};

/** What the parts have of their own. */
enum class PartsDiffer : std::uint8_t
{
  InBoth,
  InGain,
  InTheDark ///< in the variance without signal, as by their read noise
};

/** Fits the parts of \a partition. A smooth field differs in its gain. */
SensorNoise_EXPORT PartRegression
FitParts(Partition partition, PartsDiffer differ, const std::vector<TileExcess> & tiles);

/** Fits one part, all pixels. With \a stepDn the curve has a step at that level, as between two amplifiers that read
 * every pixel; of more \a knots it follows a response that is strongly non-linear. */
SensorNoise_EXPORT PartRegression
FitUniform(const std::vector<TileExcess> & tiles,
           std::optional<double>           stepDn = std::nullopt,
           std::size_t                     knots = InParts.knots);

} // namespace sensornoise

#endif
