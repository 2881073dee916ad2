// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_MosaicMethod_h
#define sensornoise_MosaicMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StackMethod.h"
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
 * Use it as the method itself, see StackMethod. The report of each plane is equal, bit by bit, to the report of the
 * method for this plane alone. MakeChannelReports() joins the four reports. An object may be moved.
 *
 * \tparam TPixel type of the pixels.
 * \tparam TMethod RefinedMethod<TPixel> or PublishedMethod<TPixel>. */
template <typename TPixel, typename TMethod>
class MosaicMethod
{
public:
  /** Least number of passes over the stack, as StackMethod::NumberOfPasses. */
  static constexpr unsigned int NumberOfPasses = TMethod::NumberOfPasses;

  /** Settings of the method: RefinedSettings or PublishedSettings. */
  using Settings = typename TMethod::Settings;

  /** Starts the first pass, with the same \a settings for all planes. RefinedSettings::memoryLimitBytes limits all
   * planes together.
   * \param settings settings of the method
   * \param geometry size of the mosaic
   * \param pattern pattern of the mosaic
   * \param frames number of frames of the stack, at least 5
   * \param mask for each pixel of the mosaic a nonzero value if it is to be used; empty: all
   * \param parallelFor spreads the work over threads
   * \param threads number of threads of \a parallelFor
   * \throws std::invalid_argument as the method does. */
  MosaicMethod(const Settings &                  settings,
               const FrameGeometry &             geometry,
               BayerPattern                      pattern,
               std::size_t                       frames,
               const std::vector<std::uint8_t> & mask = {},
               const ParallelFor &               parallelFor = SerialFor,
               std::size_t                       threads = 1);
  /** Starts the first pass, with \a settings for each plane, in the order of BayerPlanes. The offsets from dark frames
   * differ between planes. A memory limit is the limit of each plane. */
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

  /** Adds the next \a count mosaics of the current pass, stored one after the other, row by row. Throws
   * std::logic_error if fewer frames are left, or if a frame was added before. */
  void
  AddFrames(const TPixel * frames, std::size_t count);

  /** Makes frame \a frame, from 0, the next frame of the current pass. Throws std::logic_error if \a frame is not below
   * the number of frames. */
  void
  GoTo(std::size_t frame);

  /** Returns 1 for every frame that was added or merged in the current pass, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const;

  /** Discards all frames that were added or merged in the current pass. */
  void
  ForgetSums();

  /** Writes the sums of all planes over the frames of the current pass, as StackMethod::SaveSums(). */
  void
  SaveSums(std::ostream & out) const;

  /** Adds the sums that another object saved in the same pass, and throws, as StackMethod::MergeSums(). */
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Returns whether all passes have ended, so that the reports of all planes exist. */
  bool
  IsDone() const;

  /** Returns the reports, in the order of BayerPlanes, when IsDone(). */
  std::array<Report, 4>
  GetReports() const;

  /** Move a map of the whole frame out, in which every pixel has the value of its plane. The maps are the maps of
   * StackMethod. A pixel is NaN (PixelUse::Border in the map of pixel use) if its plane has no map, or if it is in a
   * last column or row that belongs to no plane. */
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
