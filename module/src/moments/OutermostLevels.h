// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_OutermostLevels_h
#define sensornoise_moments_OutermostLevels_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <functional>
#include <map>

namespace sensornoise
{

/** \class OutermostLevels
 * \brief Histogram of the extremes of the pixels over time, for the 64 lowest or highest values of a floating-point
 * stack.
 *
 * Values are the same level only if they are exactly equal. The counts are exact for any order of the pixels: a level
 * that left the table has 64 others beyond it and cannot return. */
class SensorNoise_EXPORT OutermostLevels
{
public:
  enum class End
  {
    Low,
    High
  };

  explicit OutermostLevels(End end)
    : m_Sign(end == End::High ? 1.0 : -1.0)
  {}

  /** Adds a pixel whose extreme is \a value, a finite number. */
  void
  Add(double value)
  {
    const double outwards = m_Sign * value;
    if (!m_Counts.empty() && outwards == m_Counts.begin()->first)
    {
      ++m_Counts.begin()->second; // shortcut: at a clip level this is every second pixel
    }
    else if (m_Counts.size() < MostLevels || outwards >= m_Innermost)
    {
      this->Insert(outwards);
    }
  }

  /** Outermost level [DN]; the table must not be empty. */
  double
  Level() const
  {
    return m_Sign * m_Counts.begin()->first + 0.0; // + 0.0 turns -0 into 0
  }
  /** Number of pixels whose extreme is the outermost level; 0 if the table is empty. */
  std::size_t
  Pixels() const
  {
    return m_Counts.empty() ? 0 : m_Counts.begin()->second;
  }

  /** Removes the outermost levels that lie beyond a pile-up and apart from it, as FindEndOfCodes() does: the levels of
   * stuck pixels. \a stepDn is the spacing of the levels [DN]. */
  void
  LeaveOutStray(double stepDn);

  /** Returns the spacing of the levels [DN]: the quantile 0.1 of the distances between neighbours. Codes that no pixel
   * has make most distances longer; stray values make a few shorter. 0: fewer than two levels. */
  double
  Step() const;

  /** Returns the largest number of pixels on one of the levels at most 16 steps inside of the outermost one. */
  std::size_t
  MostInside(double stepDn) const;

private:
  static constexpr std::size_t MostLevels = 64;

  using Counts = std::map<double, std::size_t, std::greater<double>>; // outermost level first

  void
  Insert(double outwards);

  /** Returns the largest number of pixels on one of the levels at most 16 steps inside of \a end. */
  std::size_t
  MostInside(Counts::const_iterator end, double stepDn) const;

  double m_Sign;
  double m_Innermost{ 0.0 }; // innermost level of the table
  Counts m_Counts;
};

} // namespace sensornoise

#endif
