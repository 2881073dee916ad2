// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_Random_h
#define sensornoise_simulation_Random_h

#include "base/BytesFingerprint.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace sensornoise
{

/** \class CounterSeededRandom
 * \brief Random numbers that depend on a seed and three counters only.
 *
 * A simulation gives each row of each frame a separate generator, `CounterSeededRandom(seed, stream, frame, row)`, so
 * that any thread can draw any row, in any order, with the same result. The counters are hashed into the 256 bits of
 * state of xoshiro256++ (Blackman and Vigna, ACM TOMS 47(4), 2021, DOI 10.1145/3460772). The construction of a
 * generator costs about as much as ten draws.
 *
 * Bits() and Uniform() use integer arithmetic, and give the same bits on every platform. Normal() and Poisson() use
 * log, exp and sqrt, whose last digit depends on the C library. About one in 1e12 numbers that are rounded to integer
 * DN can differ between platforms. On one platform all numbers are always the same. */
class CounterSeededRandom
{
public:
  /** \param seed chosen by the user, any value
   * \param stream purpose of the numbers: different streams of one seed are independent
   * \param a first counter, for example the frame
   * \param b second counter, for example the row */
  explicit CounterSeededRandom(std::uint64_t seed, std::uint64_t stream = 0, std::uint64_t a = 0, std::uint64_t b = 0);

  /** Returns 64 random bits (xoshiro256++). */
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

  /** Returns a number uniform in the open interval (0, 1): the midpoint of one of 2^52 equal cells, never 0 and never
   * 1. */
  double
  Uniform()
  {
    return (static_cast<double>(Bits() >> 12) + 0.5) * 0x1p-52;
  }

  /** Returns a normal number with mean 0 and standard deviation 1 (polar method: Marsaglia and Bray, SIAM Review 6(3),
   * 1964, DOI 10.1137/1006063). The method yields pairs; the second number is kept for the next call. */
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

  /** Returns a Poisson number, exact (no normal approximation).
   *
   * \param mean expected number, from 0 to 1e9; 0 or less gives 0
   *
   * For means below 10, the result is the number of uniform factors that keep their product above exp(-mean) (Knuth,
   * The Art of Computer Programming, vol. 2, 3.4.1). From 10 on, it is drawn by transformed rejection, algorithm PTRS
   * (Hormann, Insurance: Mathematics and Economics 12(1), 1993, DOI 10.1016/0167-6687(93)90997-4), with about 1.15
   * tries per number for any mean. */
  std::int64_t
  Poisson(double mean);

  /** Returns the natural logarithm of k! for an integer k >= 0, to 1e-11 absolute or double precision, whichever is
   * larger. From 16 on it uses Stirling's series, whose first omitted term is 1/(1680 k^7) < 3e-12. std::lgamma is not
   * used because it may write a global variable, which would be a data race. */
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

inline CounterSeededRandom::CounterSeededRandom(std::uint64_t seed,
                                                std::uint64_t stream,
                                                std::uint64_t a,
                                                std::uint64_t b)
{
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  // Each step is one to one in its counter, so that no two rows of one frame have the same generator.
  std::uint64_t hash = MixBits(seed + golden);
  for (const std::uint64_t counter : { stream, a, b })
  {
    hash = MixBits((hash ^ counter) + golden);
  }
  for (std::uint64_t & word : m_State)
  {
    hash += golden;
    word = MixBits(hash);
  }
}

inline std::int64_t
CounterSeededRandom::Poisson(double mean)
{
  if (!(mean > 0.0))
  {
    return 0;
  }
  return mean < 10.0 ? PoissonByMultiplication(mean) : PoissonByTransformedRejection(mean);
}

inline double
CounterSeededRandom::LogFactorial(double k)
{
  constexpr double factorials[] = { 1.0,         1.0,          2.0,           6.0,
                                    24.0,        120.0,        720.0,         5040.0,
                                    40320.0,     362880.0,     3628800.0,     39916800.0,
                                    479001600.0, 6227020800.0, 87178291200.0, 1307674368000.0 };
  if (k < 16.0)
  {
    return std::log(factorials[static_cast<int>(k)]);
  }
  constexpr double halfLogTwoPi = 0.91893853320467274178;
  const double     inverse = 1.0 / k;
  const double     inverseSquared = inverse * inverse;
  return (k + 0.5) * std::log(k) - k + halfLogTwoPi +
         inverse * (1.0 / 12.0 - inverseSquared * (1.0 / 360.0 - inverseSquared / 1260.0));
}

inline std::int64_t
CounterSeededRandom::PoissonByMultiplication(double mean)
{
  const double limit = std::exp(-mean);
  std::int64_t count = 0;
  for (double product = Uniform(); product > limit; product *= Uniform())
  {
    ++count;
  }
  return count;
}

inline std::int64_t
CounterSeededRandom::PoissonByTransformedRejection(double mean)
{
  // Names and constants of PTRS: a and b shape the hat function, its immediate acceptance area has height vr.
  const double b = 0.931 + 2.53 * std::sqrt(mean);
  const double a = -0.059 + 0.02483 * b;
  const double vr = 0.9277 - 3.6224 / (b - 2.0);
  while (true)
  {
    const double u = Uniform() - 0.5;
    const double v = Uniform();
    const double us = 0.5 - std::abs(u);
    const double k = std::floor((2.0 * a / us + b) * u + mean + 0.43);
    if (us >= 0.07 && v <= vr)
    {
      return static_cast<std::int64_t>(k);
    }
    if (k < 0.0 || (us < 0.013 && v > us))
    {
      continue;
    }
    const double inverseAlpha = 1.1239 + 1.1328 / (b - 3.4);
    if (std::log(v * inverseAlpha / (a / (us * us) + b)) <= k * std::log(mean) - mean - LogFactorial(k))
    {
      return static_cast<std::int64_t>(k);
    }
  }
}

/** Purpose of the random numbers of a simulated stack: the stream of a CounterSeededRandom. The meaning of a number
 * never changes, because a seed would otherwise yield another stack. Streams from 100 on are free for programs that
 * extend the simulator. The counter "frame" is the number of the exposure, where frames are repeated. */
enum class RandomStream : std::uint64_t
{
  Series = 1,       ///< flicker, shifts and phase; counter: frame
  Pixels = 2,       ///< electrons and read noise; counters: frame, row
  FixedPattern = 3, ///< fixed-pattern noise; counter: FixedPatternKind
  RowNoise = 4,     ///< counters: frame, row
  ColumnNoise = 5,  ///< counter: frame
  Banding = 6,      ///< counter: frame
  Illumination = 7  ///< counter: frame
};

/** Maps of the stream FixedPattern. */
enum class FixedPatternKind : std::uint64_t
{
  Efficiency = 0,
  Offset = 1,
  HotPixels = 2,
  Gain = 3,
  ColumnGain = 4,
  ColumnEfficiency = 5,
  ColumnOffset = 6,
  ReadNoise = 7
};

/** Returns the number of a stream. Frames with the shutter closed have independent temporal noise, but the
 * fixed-pattern noise of the bright frames, so that both come from one sensor. */
inline std::uint64_t
StreamNumber(RandomStream stream, bool isDark = false)
{
  constexpr std::uint64_t dark = std::uint64_t{ 1 } << 32;
  return static_cast<std::uint64_t>(stream) + (isDark ? dark : 0);
}

} // namespace sensornoise

#endif
