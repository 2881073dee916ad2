// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_SingleImageMethod_h
#define sensornoise_SingleImageMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Every parameter of the single-image method. */
struct SensorNoise_EXPORT SingleImageSettings
{
  /** Colour filters from the upper left pixel on: each plane is measured by itself. Null (default): a monochrome
   * sensor.
   */
  std::optional<BayerPattern> bayerPattern;
  /** Excess noise factor F of the sensor, 1 or more [1]: the gain is the slope of the variance divided by F. 1
   * (default): none. */
  double excessNoiseFactor{ 1.0 };
  /** Known settings of the digital numbers; others are found from the first frame. */
  DnSettings dnSettings;

  /** Throws std::invalid_argument if a parameter is out of its range. */
  void
  Validate() const;
};

/** \class SingleImageMethod
 * \brief Measures the line variance = slope * level + intercept from the pixels of a single image.
 *
 * After Foi, Trimeche, Katkovnik & Egiazarian, IEEE Trans. Image Process. 17(10), 2008 (DOI 10.1109/TIP.2008.2001399).
 A
 * wavelet transform separates a frame into details, which are mostly noise, and an approximation. Positions around
 which
 * the approximation is even are sorted by its level. The details of each level set give a robust variance. A line is
 * fitted to these variances by maximum likelihood, as the variance of a normal variable that is clipped at both ends.
 *
 * Each of several frames is measured, and one line is fitted to the level sets of all. The mean of the frames is
 * measured, too: variance that does not average out there is no noise of the frames. The scatter of the slopes of the
 * frames checks their errors: if it is larger, the errors of the report grow to it.
 *
 * The slope is the gain where the noise is white. Offset and read noise are not identifiable from a single image.
 Texture
 * as fine as a pixel, and fixed-pattern noise, count as noise; where that is noticed, the report warns.
 *
 * Each frame is read once. The bits are the same for any number of threads and any chunks. Memory: 8 bytes a pixel for
 * the mean of several frames, and 10 MB a thread. A frame that cannot be measured ends in a report whose quantities are
 * `failed`, with a warning that says why.
   \code
   SingleImageMethod<unsigned short> method(SingleImageSettings{}, { width, height }, 1);
   method.AddFrames(pixels, 1);
   method.GetReports()[0];
   \endcode
 *
 * \tparam TPixel unsigned char, unsigned short, short, float or double. */
template <typename TPixel>
class SingleImageMethod
{
public:
  using Settings = SingleImageSettings;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work over threads.
   * Throws std::invalid_argument for settings out of range, no frame, and a mask of another size than a frame. */
  SingleImageMethod(const SingleImageSettings &       settings,
                    const FrameGeometry &             geometry,
                    std::size_t                       frames,
                    const std::vector<std::uint8_t> & mask = {},
                    ParallelFor                       parallelFor = SerialFor);
  SingleImageMethod(SingleImageMethod && other) noexcept;
  SingleImageMethod &
  operator=(SingleImageMethod && other) noexcept;
  ~SingleImageMethod();

  /** Adds the next \a count frames, stored one after the other, row by row. Throws std::logic_error if fewer are left,
   * and std::invalid_argument if the data pass the given bit depth. */
  void
  AddFrames(const TPixel * frames, std::size_t count);

  /** Returns whether all frames have been added. */
  bool
  IsDone() const;

  /** Returns the report, or the reports of the four planes in the order of BayerPlanes, when IsDone(). Throws
   * std::logic_error before. */
  std::vector<Report>
  GetReports() const;

private:
  struct Planes;

  std::unique_ptr<Planes> m_Planes;
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SingleImageMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
