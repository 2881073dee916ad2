// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_CodeSteps_h
#define sensornoise_moments_CodeSteps_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** A code, and of how many pixels it is an extreme over time. */
struct SeenCode
{
  std::int32_t  code;
  std::uint32_t pixels;
};

/** \class CodeSteps
 * \brief How far apart the codes lie, as a function of the level, where that grows with it.
 *
 * Cameras compand to save bits: a tone curve, often a square root, to 8 or 10 bits, which is undone on reading. Then
 * the codes are dense in the dark and coarse in the light, and so is the noise of rounding, step^2 / 12 [DN^2]: it
 * grows with the level and adds to the slope of the variance, which is no more the gain (Janesick, "Photon Transfer",
 * SPIE 2007, ch. 11 on non-linear encoding; step^2 / 12: Bennett 1948, Bell Syst. Tech. J. 27, 446). */
class SensorNoise_EXPORT CodeSteps
{
public:
  /** What the codes are like about a level. */
  struct Local
  {
    double levelDn;
    double stepDn;      ///< mean distance of neighbouring codes
    double varianceDn2; ///< of rounding to them
  };

  CodeSteps() = default;
  /** \a table rises with the level. */
  explicit CodeSteps(std::vector<Local> table, double unitDn = 1.0);

  /** False: the step is the same everywhere, or nothing tells otherwise, and there is no table. */
  bool
  IsCompanded() const
  {
    return !m_Table.empty();
  }
  /** From dark to bright; of the levels between them interpolation, outside of them the nearest tells. */
  const std::vector<Local> &
  GetTable() const
  {
    return m_Table;
  }
  /** What all codes are multiples of [DN]. */
  double
  GetUnitDn() const
  {
    return m_UnitDn;
  }
  /** [DN]; 0 without a table. */
  double
  StepAt(double levelDn) const
  {
    return this->Interpolate(levelDn, &Local::stepDn);
  }
  /** Of rounding to the codes [DN^2]; 0 without a table. */
  double
  VarianceAt(double levelDn) const
  {
    return this->Interpolate(levelDn, &Local::varianceDn2);
  }

private:
  double
  Interpolate(double levelDn, double Local::* value) const;

  std::vector<Local> m_Table;
  double             m_UnitDn{ 1.0 };
};

/** Finds the steps of \a codes, all that occur, ascending. Only neighbours tell that are the extreme of at least 8
 * pixels each: between such, no code is missing by chance. Averages over 12 and more of them are compared, so that
 * rescaled data, whose steps are irregular but the same everywhere, have no table. */
SensorNoise_EXPORT CodeSteps
FindCodeSteps(const std::vector<SeenCode> & codes);

} // namespace sensornoise

#endif
