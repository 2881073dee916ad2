// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Stencils_h
#define sensornoise_base_Stencils_h

#include <array>
#include <cstddef>
#include <utility>

namespace sensornoise
{

/** One weight of a stencil, at column \a dx and row \a dy from the pixel. */
struct StencilTap
{
  int    dx;
  int    dy;
  double weight;

  /** Returns the distance from the pixel to this weight, in a map of \a width columns [pixels in memory]. */
  constexpr std::ptrdiff_t
  Offset(std::size_t width) const
  {
    return static_cast<std::ptrdiff_t>(dy) * static_cast<std::ptrdiff_t>(width) + dx;
  }
};

/** The weights of a stencil, at most 6 of them. */
class StencilTaps
{
public:
  template <typename... TTaps>
  constexpr explicit StencilTaps(TTaps... taps)
    : m_Taps{ taps... }
    , m_Size(sizeof...(taps))
  {}
  constexpr const StencilTap *
  begin() const
  {
    return m_Taps.data();
  }
  constexpr const StencilTap *
  end() const
  {
    return m_Taps.data() + m_Size;
  }

private:
  std::array<StencilTap, 6> m_Taps;
  std::size_t               m_Size;
};

/** A central difference on 5 x 5 pixels. */
struct Stencil
{
  const char * name{ nullptr }; ///< the derivatives: "x", "yy", "xxy", ...
  int          order{ 0 };      ///< order of the derivative, 1 to 3
  StencilTaps  taps;

  constexpr double
  CentreWeight() const
  {
    for (const StencilTap & tap : taps)
    {
      if (tap.dx == 0 && tap.dy == 0)
      {
        return tap.weight;
      }
    }
    return 0.0;
  }
};

/** Width of the border of the frame in which the stencils are not defined [pixels]. */
inline constexpr std::size_t StencilMargin = 2;

inline constexpr std::size_t NumberOfStencils = 9;

namespace detail
{
using Tap = StencilTap;
inline constexpr std::array<Stencil, NumberOfStencils> Stencils{
  { { "x", 1, StencilTaps(Tap{ 1, 0, 0.5 }, Tap{ -1, 0, -0.5 }) },
    { "y", 1, StencilTaps(Tap{ 0, 1, 0.5 }, Tap{ 0, -1, -0.5 }) },
    { "xx", 2, StencilTaps(Tap{ 1, 0, 1.0 }, Tap{ 0, 0, -2.0 }, Tap{ -1, 0, 1.0 }) },
    { "yy", 2, StencilTaps(Tap{ 0, 1, 1.0 }, Tap{ 0, 0, -2.0 }, Tap{ 0, -1, 1.0 }) },
    { "xy", 2, StencilTaps(Tap{ 1, 1, 0.25 }, Tap{ -1, -1, 0.25 }, Tap{ -1, 1, -0.25 }, Tap{ 1, -1, -0.25 }) },
    { "xxx", 3, StencilTaps(Tap{ 2, 0, 0.5 }, Tap{ 1, 0, -1.0 }, Tap{ -1, 0, 1.0 }, Tap{ -2, 0, -0.5 }) },
    { "yyy", 3, StencilTaps(Tap{ 0, 2, 0.5 }, Tap{ 0, 1, -1.0 }, Tap{ 0, -1, 1.0 }, Tap{ 0, -2, -0.5 }) },
    { "xxy",
      3,
      StencilTaps(Tap{ 1, 1, 0.5 },
                  Tap{ 0, 1, -1.0 },
                  Tap{ -1, 1, 0.5 },
                  Tap{ 1, -1, -0.5 },
                  Tap{ 0, -1, 1.0 },
                  Tap{ -1, -1, -0.5 }) },
    { "xyy",
      3,
      StencilTaps(Tap{ 1, 1, 0.5 },
                  Tap{ 1, 0, -1.0 },
                  Tap{ 1, -1, 0.5 },
                  Tap{ -1, 1, -0.5 },
                  Tap{ -1, 0, 1.0 },
                  Tap{ -1, -1, -0.5 }) } }
};
} // namespace detail

/** The derivatives of the mean into which a small motion of the scene is expanded, up to the third order. The first two
 * are of the first order. */
constexpr const std::array<Stencil, NumberOfStencils> &
MotionStencils()
{
  return detail::Stencils;
}

/** Index in MotionStencils(). */
enum StencilIndex : std::size_t
{
  StencilX = 0,
  StencilY = 1,
  StencilXX = 2,
  StencilYY = 3,
  StencilXY = 4,
  StencilXXX = 5,
  StencilYYY = 6
};

/** Number of the derivatives of the first and second order, the first ones of MotionStencils(). */
inline constexpr std::size_t StencilsOfLowOrder = StencilXXX;

/** Returns the value of the stencil at pixel \a p of a map of \a width columns; \a p is at least StencilMargin pixels
 * from the border. */
inline double
ApplyStencil(const Stencil & stencil, const double * map, std::size_t width, std::size_t p)
{
  double sum = 0.0;
  for (const StencilTap & tap : stencil.taps)
  {
    sum += tap.weight * map[static_cast<std::ptrdiff_t>(p) + tap.Offset(width)];
  }
  return sum;
}

namespace detail
{
template <std::size_t VStencil>
double
ValueOfStencil(const double * pixel, std::ptrdiff_t width)
{
  constexpr StencilTaps taps = Stencils[VStencil].taps;
  double                sum = 0.0;
  for (const StencilTap & tap : taps)
  {
    sum += tap.weight * pixel[tap.dy * width + tap.dx];
  }
  return sum;
}

template <std::size_t... VStencils>
std::array<double, sizeof...(VStencils)>
ValuesOfStencils(const double * pixel, std::ptrdiff_t width, std::index_sequence<VStencils...>)
{
  return { ValueOfStencil<VStencils>(pixel, width)... };
}
} // namespace detail

/** Returns the values of all of MotionStencils() at pixel \a p. */
inline std::array<double, NumberOfStencils>
ApplyStencils(const double * map, std::size_t width, std::size_t p)
{
  return detail::ValuesOfStencils(
    map + p, static_cast<std::ptrdiff_t>(width), std::make_index_sequence<NumberOfStencils>());
}

/** Returns the first derivatives along x and y at pixel \a p. */
inline std::array<double, 2>
ApplyGradient(const double * map, std::size_t width, std::size_t p)
{
  return detail::ValuesOfStencils(
    map + p, static_cast<std::ptrdiff_t>(width), std::index_sequence<StencilX, StencilY>());
}

/** Returns the squared effect of a motion of about one pixel: the squared gradient, plus a quarter of the squared
 * second derivatives along x and y, at pixel \a p of a map. */
inline double
StencilEnergyAt(const double * map, std::size_t width, std::size_t p)
{
  using Counting = std::index_sequence<StencilX, StencilY, StencilXX, StencilYY>;
  const auto d = detail::ValuesOfStencils(map + p, static_cast<std::ptrdiff_t>(width), Counting());
  return d[0] * d[0] + d[1] * d[1] + 0.25 * (d[2] * d[2] + d[3] * d[3]);
}

/** Returns the sum of the products of the weights of two stencils: the expected product of their values for white noise
 * of variance 1. */
inline double
InnerProduct(const Stencil & a, const Stencil & b)
{
  double sum = 0.0;
  for (const StencilTap & s : a.taps)
  {
    for (const StencilTap & t : b.taps)
    {
      sum += s.dx == t.dx && s.dy == t.dy ? s.weight * t.weight : 0.0;
    }
  }
  return sum;
}

} // namespace sensornoise

#endif
