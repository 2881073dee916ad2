// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_Random_h
#define sensornoise_simulation_Random_h

#include "SensorNoiseExport.h"

#include <cmath>
#include <cstdint>

namespace sensornoise
{

/** \class CounterSeededRandom
 * Random numbers that depend on a seed and on three counters, and on nothing else.
 *
 * A simulation gives each row of each frame its own generator, `CounterSeededRandom(seed, stream, frame, row)`, so any
 * row can be drawn by any thread, in any order, with the same result. The counters are hashed into the 256 bits of
 * state of xoshiro256++ (Blackman and Vigna, ACM TOMS 47(4), 2021, DOI 10.1145/3460772). Making a generator costs
 * about as much as ten draws.
 *
 * Bits() and Uniform() are integer arithmetic: the same bits on every platform. Normal() and Poisson() go through
 * log, exp and sqrt, whose last digit belongs to the C library: of numbers rounded to whole grey levels, about one in
 * 1e12 can differ from platform to platform; on one platform none does. */
class SensorNoise_EXPORT CounterSeededRandom
{
public:
  /** \param seed chosen by the user, any value
   * \param stream what the numbers are for: different streams of one seed are independent
   * \param a first counter, for example the frame
   * \param b second counter, for example the row */
  explicit CounterSeededRandom(std::uint64_t seed, std::uint64_t stream = 0, std::uint64_t a = 0, std::uint64_t b = 0);

  /** 64 random bits (xoshiro256++). */
  std::uint64_t
  Bits()
  {
    const std::uint64_t result = Rotate(m_State[0] + m_State[3], 23) + m_State[0];
    const std::uint64_t shifted = m_State[1] << 17;
    m_State[2] ^= m_State[0];
    m_State[3] ^= m_State[1];
    m_State[1] ^= m_State[2];
    m_State[0] ^= m_State[3];
    m_State[2] ^= shifted;
    m_State[3] = Rotate(m_State[3], 45);
    return result;
  }

  /** Uniform in the open interval (0, 1): the midpoints of 2^52 equal cells, never 0 and never 1. */
  double
  Uniform()
  {
    return (static_cast<double>(Bits() >> 12) + 0.5) * 0x1p-52;
  }

  /** Normal with mean 0 and standard deviation 1 (polar method: Marsaglia and Bray, SIAM Review 6(3), 1964,
   * DOI 10.1137/1006063). The method gives pairs; the second number waits for the next call. */
  double
  Normal()
  {
    if (m_HasSpareNormal)
    {
      m_HasSpareNormal = false;
      return m_SpareNormal;
    }
    double u = 0.0;
    double v = 0.0;
    double s = 0.0;
    do
    {
      u = 2.0 * Uniform() - 1.0;
      v = 2.0 * Uniform() - 1.0;
      s = u * u + v * v;
    } while (s >= 1.0 || s == 0.0);
    const double factor = std::sqrt(-2.0 * std::log(s) / s);
    m_SpareNormal = v * factor;
    m_HasSpareNormal = true;
    return u * factor;
  }

  /** Poisson number, exact (no normal approximation).
   *
   * \param mean expected number, from 0 to 1e9; 0 or less gives 0
   *
   * Below 10: as many factors as keep a product of uniforms above exp(-mean) (Knuth, The Art of Computer Programming,
   * vol. 2, 3.4.1). From 10 on: transformed rejection, algorithm PTRS (Hormann, Insurance: Mathematics and Economics
   * 12(1), 1993, DOI 10.1016/0167-6687(93)90997-4), about 1.15 tries a number whatever the mean. */
  std::int64_t
  Poisson(double mean);

  /** Natural logarithm of k! for a whole number k >= 0, to 1e-11 absolute or double precision, whichever is larger.
   * From 16 on Stirling's series, whose first term left out is 1/(1680 k^7) < 3e-12. std::lgamma is not used because it
   * may write a global variable, which threads would race for. */
  static double
  LogFactorial(double k);

private:
  static std::uint64_t
  Rotate(std::uint64_t bits, int count)
  {
    return (bits << count) | (bits >> (64 - count));
  }

  std::int64_t
  PoissonByMultiplication(double mean);

  std::int64_t
  PoissonByTransformedRejection(double mean);

  std::uint64_t m_State[4]{};
  double        m_SpareNormal{ 0.0 };
  bool          m_HasSpareNormal{ false };
};

} // namespace sensornoise

#endif // sensornoise_simulation_Random_h
