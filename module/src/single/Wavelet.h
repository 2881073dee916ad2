// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_Wavelet_h
#define sensornoise_single_Wavelet_h

#include <array>
#include <cstddef>

namespace sensornoise
{

/** Daubechies' orthonormal wavelet with three vanishing moments (Comm. Pure Appl. Math. 41, 1988, DOI
 * 10.1002/cpa.3160410705). Details of white noise are uncorrelated with each other and with the approximation; details
 * of a polynomial of degree 2 along a row or a column are 0. */
struct Wavelet
{
  static constexpr std::size_t Taps = 6;

  /** Weights of the approximation; their sum is the square root of 2. (1 + s + q, 5 + s + 3 q, 10 - 2 s + 2 q,
   * 10 - 2 s - 2 q, 5 + s - 3 q, 1 + s - q) / (16 sqrt(2)), with s = sqrt(10) and q = sqrt(5 + 2 s). */
  static constexpr std::array<float, Taps> low{ { 0.3326705529500826F,
                                                  0.8068915093110926F,
                                                  0.4598775021184915F,
                                                  -0.1350110200102546F,
                                                  -0.0854412738820267F,
                                                  0.0352262918857095F } };
  /** Weights of the details: those of the approximation in reverse, with alternating sign. */
  static constexpr std::array<float, Taps> high{ { low[5], -low[4], low[3], -low[2], low[1], -low[0] } };
};

/** Geometry of the windows of a position, in coefficients of the approximation. The centre of the approximation's
 * weights is 0.8 pixels from its first tap, the centre of the squared weights of the details 3.8 pixels: 1.5
 * coefficients apart. A window of an even number of coefficients has its centre half between two of them, so both
 * centres are equal. Without that the level of a ramp would be off by 3 pixels of its slope. */
struct WaveletWindow
{
  /** Width of the window of the level and of the roughness. */
  static constexpr std::size_t Size = 6;
  /** Width of the mean from which the approximation's deviations are taken: a ramp has none. */
  static constexpr std::size_t Smooth = 5;
  /** Coefficients that a position's windows reach along an axis, less 1. */
  static constexpr std::size_t Reach = Size + Smooth - 2;
  /** First coefficient of the window of the level. */
  static constexpr std::size_t LevelFirst = Smooth / 2;
  /** The detail coefficient of the position. */
  static constexpr std::size_t Detail = LevelFirst + Size / 2 - 2;
};

} // namespace sensornoise

#endif
