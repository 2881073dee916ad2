// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_PixelMap_h
#define sensornoise_base_PixelMap_h

#include "base/ParallelWork.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Precision in which the numbers of a map are held. */
enum class Precision : std::uint8_t
{
  Double, ///< 8 bytes
  Single  ///< 4 bytes, with a relative error of at most 2^-24
};

/** \class PixelMap
 * \brief One number for each pixel of a frame, held in single or in double precision.
 *
 * Sums and products of the numbers are made in double precision. Estimator.md, 6, says which maps need which precision.
 */
class PixelMap
{
public:
  explicit PixelMap(Precision precision = Precision::Double)
    : m_Precision(precision)
  {}
  PixelMap(std::vector<double> numbers) // NOLINT(google-explicit-constructor): the same map
    : m_Double(std::move(numbers))
  {}

  std::size_t
  size() const
  {
    return m_Precision == Precision::Double ? m_Double.size() : m_Single.size();
  }
  double
  operator[](std::size_t p) const
  {
    return m_Precision == Precision::Double ? m_Double[p] : static_cast<double>(m_Single[p]);
  }
  void
  Set(std::size_t p, double number)
  {
    m_Precision == Precision::Double ? void(m_Double[p] = number) : void(m_Single[p] = static_cast<float>(number));
  }

  /** Calls function(numbers), with a vector of double or of float. */
  template <typename TFunction>
  auto
  Visit(TFunction function) const
  {
    return m_Precision == Precision::Double ? function(m_Double) : function(m_Single);
  }

  /** Copies the numbers of \a pixels pixels from pixel \a first on to \a numbers. */
  void
  CopyTo(double * numbers, std::size_t first, std::size_t pixels) const
  {
    this->Visit([=](const auto & map) { std::copy_n(map.data() + first, pixels, numbers); });
  }
  /** Sets the numbers of \a pixels pixels from pixel \a first on. */
  void
  SetBlock(std::size_t first, std::size_t pixels, const double * numbers)
  {
    if (m_Precision == Precision::Double)
    {
      std::copy_n(numbers, pixels, m_Double.data() + first);
      return;
    }
    std::transform(
      numbers, numbers + pixels, m_Single.data() + first, [](double number) { return static_cast<float>(number); });
  }

  /** Allocates the memory of \a pixels pixels. */
  void
  Reserve(std::size_t pixels)
  {
    m_Precision == Precision::Double ? m_Double.reserve(pixels) : m_Single.reserve(pixels);
  }
  /** Extends the map to \a pixels pixels, see GrowMap(). */
  void
  Grow(std::size_t pixels, const ParallelFor & parallelFor)
  {
    m_Precision == Precision::Double ? GrowMap(m_Double, pixels, parallelFor) : GrowMap(m_Single, pixels, parallelFor);
  }

  /** Rounds the numbers to single precision. */
  void
  Round(const ParallelFor & parallelFor)
  {
    if (m_Precision == Precision::Double)
    {
      m_Single = MakeMap<float>(m_Double.size(), parallelFor);
      ForPixels(m_Single.size(), parallelFor, [this](std::size_t p) { m_Single[p] = static_cast<float>(m_Double[p]); });
      m_Double = std::vector<double>(); // assigning {} would keep the memory
      m_Precision = Precision::Single;
    }
  }
  /** Holds the numbers in double precision from now on. */
  void
  Widen(const ParallelFor & parallelFor)
  {
    if (m_Precision == Precision::Single)
    {
      m_Double = MakeMap<double>(m_Single.size(), parallelFor);
      ForPixels(
        m_Double.size(), parallelFor, [this](std::size_t p) { m_Double[p] = static_cast<double>(m_Single[p]); });
      m_Single = std::vector<float>();
      m_Precision = Precision::Double;
    }
  }
  Precision
  GetPrecision() const
  {
    return m_Precision;
  }
  /** Return the numbers, which must be held in this precision. */
  const std::vector<double> &
  GetDoubles() const
  {
    return m_Double;
  }
  const std::vector<float> &
  GetSingles() const
  {
    return m_Single;
  }
  /** Moves the numbers, which must be held in double precision, out of the object. */
  std::vector<double>
  TakeDoubles()
  {
    return std::exchange(m_Double, {});
  }

private:
  Precision           m_Precision{ Precision::Double };
  std::vector<double> m_Double; // empty in single precision
  std::vector<float>  m_Single; // empty in double precision
};

} // namespace sensornoise

#endif
