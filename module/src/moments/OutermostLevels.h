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
 * \brief How many pixels have which value as their extreme over time: the 64 lowest or highest values of a
 * floating-point stack.
 *
 * Values are the same level if they are equal exactly. The counts are exact in whatever order the pixels are added: a
 * level that left the table has 64 others beyond it and cannot come back. */
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
      ++m_Counts.begin()->second; // where a level clips, this is every second pixel
    }
    else if (m_Counts.size() < MostLevels || outwards >= m_Innermost)
    {
      this->Insert(outwards);
    }
  }

  /** The outermost level [DN], and how many pixels have it. Some pixel has been added. */
  double
  Level() const
  {
    return m_Sign * m_Counts.begin()->first + 0.0; // never -0
  }
  std::size_t
  Pixels() const
  {
    return m_Counts.empty() ? 0 : m_Counts.begin()->second;
  }

  /** Forgets the outermost levels that lie beyond a pile-up and apart from it, as FindEndOfCodes() does: those of stuck
   * pixels. \a stepDn is the spacing of the levels. */
  void
  LeaveOutStray(double stepDn);

  /** The spacing of the levels [DN]: that which 1 in 10 of the distances between neighbours does not pass. Codes that
   * no pixel has make most distances longer, and stray values make a few shorter. 0: fewer than two levels. */
  double
  Step() const;

  /** The most pixels of one level among those at most 16 steps inside of the outermost one. */
  std::size_t
  MostInside(double stepDn) const;

private:
  static constexpr std::size_t MostLevels = 64;

  using Counts = std::map<double, std::size_t, std::greater<double>>; // outermost first

  void
  Insert(double outwards);

  /** The most pixels of one level among those at most 16 steps inside of \a end. */
  std::size_t
  MostInside(Counts::const_iterator end, double stepDn) const;

  double m_Sign;
  double m_Innermost{ 0.0 }; // of the table
  Counts m_Counts;
};

} // namespace sensornoise

#endif
