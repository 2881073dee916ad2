// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_RowFlicker_h
#define sensornoise_published_RowFlicker_h

#include "SensorNoiseExport.h"
#include "published/FlickerSums.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** v^*(y, t) for every frame and row, (3.28), where the row set reaches. */
struct RowRatios
{
  double                    sigmaRows{ 0.0 }; ///< sigma_y that was used [rows]
  std::vector<double>       ratio;            ///< frame by frame, row by row; 1 where not known
  std::vector<std::uint8_t> known;            ///< per row: the row set has pixels within sigma_y of it
};

/** Chooses sigma_y by leave-one-row-out cross-validation; 0 means that the flicker is the same in all rows.
 *
 * Section 3.5 of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035) takes 50 rows and leaves the choice to future
 * work. Here each row's v^* is predicted from the other rows' with the weights of (3.28), and the sigma_y that
 * predicts best over all frames wins. Rows are modelled only if that beats the whole frame's v^* by more than 1 %
 * of the squared error: below, what a row's own flicker adds to the variance of a pixel is under 1 % of its noise.
 * A first look at 16 frames and three widths spares a stack without row flicker the search. */
SensorNoise_EXPORT double
ChooseSigmaRows(const FlickerSums & sums);

/** v^*(y, t) with the width \a sigmaRows. A row farther than sigma_y from any pixel of the row set is not known: the
 * kernel would extrapolate there. */
SensorNoise_EXPORT RowRatios
SmoothRowRatios(const FlickerSums & sums, double sigmaRows);

} // namespace sensornoise

#endif
