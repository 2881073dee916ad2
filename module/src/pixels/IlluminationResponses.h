// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_IlluminationResponses_h
#define sensornoise_pixels_IlluminationResponses_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

class PixelCoordinates;
struct ReferenceFrame;
struct VarianceLine;

/** The projected stack and the quantities needed to analyse the illumination pixel by pixel. */
struct IlluminationResponses
{
  const ReferenceFrame &            frame;
  const PixelCoordinates &          coordinates;
  std::size_t                       factors; ///< number of illumination components, which are the first coordinates
  const VarianceLine &              line;
  const std::vector<std::uint8_t> & mask;
  double                            centreDn;  ///< level that is subtracted from the means [DN]
  double                            darkestDn; ///< darkest quantile of the means [DN]
  double                            rangeDn;   ///< brightest minus darkest quantile of the means [DN]
};

/** Terms of a surface in a tile: 1 and I, the mean minus the centre, and both times the place (x, y) in the tile. */
using Surface = Eigen::Matrix<double, 6, 1>;

/** Division of the frame into tiles within which local illumination has one pattern. */
struct Tiles
{
  std::size_t height; ///< height of a tile [pixel]
  std::size_t width;  ///< width of a tile [pixel]
  std::size_t across; ///< number of tiles in a row of tiles

  /** Returns the tile of pixel \a p of frames of \a frameWidth columns. */
  std::size_t
  Of(std::size_t p, std::size_t frameWidth) const
  {
    return p / frameWidth / height * across + p % frameWidth / width;
  }
  /** Returns the place of pixel \a p in its tile, from -1/2 to 1/2 along x and y [1]. */
  Eigen::Vector2d
  PlaceOf(std::size_t p, std::size_t frameWidth) const
  {
    const auto part = [](std::size_t at, std::size_t size) {
      return (static_cast<double>(at % size) + 0.5) / static_cast<double>(size) - 0.5;
    };
    return { part(p % frameWidth, width), part(p / frameWidth, height) };
  }
  /** Returns the terms of a surface at pixel \a p, whose mean minus the centre is \a centred [DN]. */
  Surface
  SurfaceAt(std::size_t p, std::size_t frameWidth, double centred) const
  {
    const Eigen::Vector2d place = this->PlaceOf(p, frameWidth);
    return (Surface() << 1.0, centred, place, centred * place).finished();
  }
};

/** Returns a map of the responses to each illumination component, without the part that motion leaked into them by
 * chance [DN]. They are 0 outside the mask. The leakage is kappa_k times the derivatives, with kappa common to the
 * frame. It is estimated against lines in the mean that are free in every 8 x 8 tile and whose coefficients vary
 * linearly over it (Frisch & Waugh 1933), so that local illumination does not bias it. Even derivatives resemble the
 * mean locally, so their leakage would shift the offset. */
SensorNoise_EXPORT std::vector<std::vector<double>>
RemoveMotionLeakage(const IlluminationResponses & data, const ParallelFor & parallelFor);

/** Dark offset from the responses of the pixels to the illumination components. */
struct LocalOffset
{
  double offset{ 0.0 };                                            ///< offset minus the centre [DN]
  double standardError{ std::numeric_limits<double>::infinity() }; ///< standard error of the offset [DN]
  /** Lower end of the 95 % interval, minus the centre [DN]; infinite: not bounded. */
  double low{ -std::numeric_limits<double>::infinity() };
  /** Upper end of the 95 % interval, minus the centre [DN]; infinite: not bounded. */
  double high{ std::numeric_limits<double>::infinity() };
  /** Dispersion of the lines about the common zero, over their noise [1]; 1 if only noise separates them. */
  double      phi{ 1.0 };
  std::size_t tiles{ 0 };           ///< number of tiles that determine a line
  bool        doLinesMeet{ false }; ///< whether they cross zero at one level, up to a small dispersion
};

/** Estimates the dark offset where the illumination is local. The response of a pixel to an illumination component is
 * S_j = rho_j (mean - mu), with rho_j nearly linear or quadratic over a tile. Without the slopes and curvature of
 * rho_j, the lines of all tiles and components cross zero at mu. Tiles of 8 to 64 pixels and strips of rows are tried.
 * Linear terms do not suffice where curvature is significant. Where rho_j varies even more within tiles, their lines do
 * not meet in one zero. Of the fits whose lines meet, the one with the smallest error is used that agrees with the fits
 * of larger errors (Lepski 1990). The dispersion of the lines widens the error. Null if no tile determines a line.
 * Estimator.md, 3.7. */
SensorNoise_EXPORT std::optional<LocalOffset>
FindLocalOffset(const IlluminationResponses & data, const ParallelFor & parallelFor = SerialFor);

/** Sums that give the standard deviation over time of local illumination for any offset. */
struct SensorNoise_EXPORT LocalFlicker
{
  double energy{ 0.0 }; ///< sum over the pixels of sum_j (S_j^2 / noise - 1), over the illumination components j [1]
  double w{ 0.0 };      ///< sum of the weights w = 1 / noise [1/DN^2]
  double wI{ 0.0 };     ///< sum of w I, where I is the mean minus the centre [1/DN]
  double wII{ 0.0 };    ///< sum of w I^2 [1]
  double frames{ 0.0 }; ///< number of frames T

  /** Returns the root mean square over the frame of the standard deviation of the illumination over time, relative to
   * its mean [1]: sqrt(sum w sum_j (S_j^2 - noise) / ((T - 1) sum w q^2)), where q is the mean above \a offset.
   * \a offset is relative to the centre [DN]. */
  double
  Sd(double offset) const;
};

/** Computes the sums over the pixels of the mask. */
SensorNoise_EXPORT LocalFlicker
SumLocalFlicker(const IlluminationResponses & data);

/** Returns whether each further illumination component is one line a + b mean over the whole frame. Then a common
 * offset drifts, and there is no second light source that changes. */
SensorNoise_EXPORT bool
IsOffsetDrift(const IlluminationResponses & data);

} // namespace sensornoise

#endif
