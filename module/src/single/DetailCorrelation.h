// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_DetailCorrelation_h
#define sensornoise_single_DetailCorrelation_h

#include "SensorNoiseExport.h"
#include "single/LevelSums.h"

#include <array>
#include <cstddef>

namespace sensornoise
{

/** \class DetailCorrelation
 * \brief Correlation of the diagonal details of neighbouring positions without edges, by lag.
 *
 * The details of white noise are uncorrelated, because the wavelet is orthonormal. Fine periodic texture, such as a
 * weave, has the same power in all bands of details and passes as noise, but its details repeat from position to
 * position. The correlation is about the fraction of their variance that is texture. */
class SensorNoise_EXPORT DetailCorrelation
{
public:
  /** Correlation of a lag. */
  struct Lag
  {
    int    x{ 0 };               ///< lag along a row [coefficients, 2 pixels each]
    int    y{ 0 };               ///< lag across the rows
    double value{ 0.0 };         ///< [1]
    double standardError{ 0.0 }; ///< of white noise [1]
  };

  /** Adds the pairs of positions of a tile. Positions with edges, or with a detail that is too large, are left out. */
  void
  Add(const BandTile & tile, const LevelGrid & grid);

  void
  Add(const DetailCorrelation & other);

  /** Returns the lag with the largest size of the correlation; all 0: there is no pair. */
  Lag
  Largest() const;

private:
  struct Place
  {
    int x;
    int y;
  };
  struct Sums
  {
    double pairs{ 0.0 };
    double products{ 0.0 };
    double squares{ 0.0 }; ///< mean squares of the two positions of a pair, relative to the expected variance
  };
  static constexpr std::array<Place, 6> Places{ { { 1, 0 }, { 0, 1 }, { 1, 1 }, { -1, 1 }, { 2, 0 }, { 0, 2 } } };

  std::array<Sums, Places.size()> m_Sums{};
};

} // namespace sensornoise

#endif
