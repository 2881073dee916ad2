// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_CommonZero_h
#define sensornoise_pixels_CommonZero_h

#include <vector>

/** \file
 * The level at which the lines of many tiles cross zero together. */

namespace sensornoise
{

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
