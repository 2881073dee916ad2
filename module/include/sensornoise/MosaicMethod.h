// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_MosaicMethod_h
#define sensornoise_MosaicMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/PublishedMethod.h"
#include "sensornoise/RefinedMethod.h"
#include "sensornoise/Report.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class MosaicMethod
 * \brief Runs a method on the four planes of a Bayer mosaic at once: each pass reads the stack once for all of them.
 *
 * It is used as the method itself, see StackMethod. The report of each plane has the bits that the method finds of this
 * plane alone. MakeChannelReports() joins the four reports. May be moved.
 *
 * \tparam TPixel type of the pixels.
 * \tparam TMethod RefinedMethod<TPixel> or PublishedMethod<TPixel>. */
template <typename TPixel, typename TMethod>
class MosaicMethod
{
public:
  static constexpr unsigned int NumberOfPasses = TMethod::NumberOfPasses;

  using Settings = typename TMethod::Settings;

  /** \a settings are those of all planes, RefinedSettings::memoryLimitBytes for all of them together. \a geometry and
   * \a mask are those of the mosaic. \a parallelFor has \a threads threads. Throws as the method does. */
  MosaicMethod(const Settings &                  settings,
               const FrameGeometry &             geometry,
               BayerPattern                      pattern,
               std::size_t                       frames,
               const std::vector<std::uint8_t> & mask = {},
               const ParallelFor &               parallelFor = SerialFor,
               std::size_t                       threads = 1);
  /** The same with settings of each plane, in the order of BayerPlanes: offsets from dark frames differ between planes.
   */
  MosaicMethod(const std::array<Settings, 4> &   settings,
               const FrameGeometry &             geometry,
               BayerPattern                      pattern,
               std::size_t                       frames,
               const std::vector<std::uint8_t> & mask = {},
               const ParallelFor &               parallelFor = SerialFor,
               std::size_t                       threads = 1);
  MosaicMethod(MosaicMethod && other) noexcept;
  MosaicMethod &
  operator=(MosaicMethod && other) noexcept;
  ~MosaicMethod();

  /** Adds the next \a count frames of the current pass, mosaics, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count);

  /** Makes frame \a frame, from 0, the next one of the current pass. Throws std::logic_error if there is no such frame.
   */
  void
  GoTo(std::size_t frame);

  /** Returns 1 for every frame that was added or merged in the current pass, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const;

  /** Takes back all that was added in the current pass. */
  void
  ForgetSums();

  /** Writes the sums of the current pass, of all planes. */
  void
  SaveSums(std::ostream & out) const;

  /** Adds the sums that another object saved in the same pass, as StackMethod::MergeSums(). */
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Returns whether the reports of all planes are there. */
  bool
  IsDone() const;

  /** Returns the reports, in the order of BayerPlanes, when IsDone(). */
  std::array<Report, 4>
  GetReports() const;

  /** Move a map of the whole frame out, every pixel with the value of its plane: as those of StackMethod. NaN, or for
   * the pixel use Border, where a plane has no map, and in a last column or row that is in no plane. */
  std::vector<double>
  TakeMean();
  std::vector<double>
  TakeVariance();
  std::vector<double>
  TakeCorrectedVariance();
  std::vector<std::uint8_t>
  TakePixelUse();

private:
  struct Planes;

  std::unique_ptr<Planes> m_Planes;
};

// A type between angle brackets takes no parentheses. NOLINTBEGIN(bugprone-macro-parentheses)
#define SensorNoise_EXTERN(TPixel)                                                      \
  extern template class SensorNoise_EXPORT MosaicMethod<TPixel, RefinedMethod<TPixel>>; \
  extern template class SensorNoise_EXPORT MosaicMethod<TPixel, PublishedMethod<TPixel>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN
// NOLINTEND(bugprone-macro-parentheses)

} // namespace sensornoise

#endif
