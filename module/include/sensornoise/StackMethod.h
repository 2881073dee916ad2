// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_StackMethod_h
#define sensornoise_StackMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <map>
#include <memory>
#include <ostream>
#include <vector>

namespace sensornoise
{

template <typename TPixel>
class StackPasses; // private

/** \class StackMethod
 * \brief Base class of both methods: the passes over a stack, in one process or in several, the report and the maps.
 *
 * Frames that are equal, bit by bit, are counted once. Frames that are unlike the others are left out. In that case the
 * next pass repeats the first pass without them. Usage, with RefinedMethod for example:
   \code
   RefinedMethod<unsigned short> method(settings, geometry, frames);
   while (!method.IsDone())
   {
     for (const auto & chunk : chunks) // of consecutive frames, all of the stack in every pass
       method.AddFrames(chunk.pixels, chunk.frames);
     method.EndPass();
   }
   method.GetReport();
   \endcode
 *
 * Several processes can measure one stack. Each reads a part of the frames, and all exchange the sums of every pass and
 * get the report of the whole stack. With integer pixels this report has the bits of a single process. With
 * floating-point pixels it is equal within rounding, and has the same bits in all processes. Equal frames must be read
 * by one process, or by a process that has merged the sums of the other before. If two processes have counted equal
 * frames, MergeSums() throws and names both.
   \code
   RefinedMethod<unsigned short> method(settings, geometry, frames); // equal in every process
   while (!method.IsDone())
   {
     method.SkipFrames(first); // this process reads the frames first ... first + count - 1
     method.AddFrames(part, count);
     method.SaveSums(toOthers);
     for (std::istream * other : fromOthers)
     {
       method.MergeSums(*other);
     }
     method.EndPass();
   }
   \endcode
 *
 * An object may be moved, also between and within passes.
 *
 * \tparam TPixel unsigned char, unsigned short, short, float or double. */
template <typename TPixel>
class StackMethod
{
public:
  /** Least number of passes over the stack. There are more passes if frames are left out, if the illumination changes
   * strongly, or if RefinedSettings::memoryLimitBytes requires them. */
  static constexpr unsigned int NumberOfPasses = 3;

  /** Fingerprint of the bytes of a frame: equal for equal frames. */
  using FrameFingerprint = std::array<std::uint64_t, 2>;

  /** Adds the next \a count frames of the current pass, stored one after the other, row by row. Throws std::logic_error
   * if fewer frames are left, or if a frame was added before. */
  void
  AddFrames(const TPixel * frames, std::size_t count);

  /** Leaves the next \a count frames of the current pass to other processes. Throws std::logic_error if fewer frames
   * are left. */
  void
  SkipFrames(std::size_t count);

  /** Makes frame \a frame, from 0, the next frame of the current pass, so that frames may be added in any order.
   * Floating-point frames are summed in the order in which they are added. Throws std::logic_error if \a frame is not
   * below the number of frames. */
  void
  GoTo(std::size_t frame);

  /** Returns 1 for every frame that was added or merged in the current pass, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const;

  /** Returns the fingerprints of the frames that were added or merged in the first pass, by frame. */
  const std::map<std::size_t, FrameFingerprint> &
  GetFingerprints() const;

  /** Sets which frames other processes count, because a frame with an equal fingerprint is there. \a
   * areCountedElsewhere has one value per frame: 0 if the frame is counted here. Call it in the first pass, before
   * these frames are added.
   */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere);

  /** Discards all frames that were added or merged in the current pass. */
  void
  ForgetSums();

  /** Releases the memory of merged floating-point sums of the first pass, 32 bytes per pixel and merge. The bits of the
   * result then depend on the order of the merges. */
  void
  FoldSums();

  /** Writes the sums over all frames that were added or merged in the current pass. In the first pass these are 20
   * bytes per pixel for integer pixels, and 32 bytes for floating-point pixels. */
  void
  SaveSums(std::ostream & out) const;

  /** Adds the sums that another object with the same arguments saved in the same pass. Throws std::runtime_error, and
   * changes nothing, if the stream has other sums, or if it contains a frame that was added here or equals one. */
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Returns whether all passes have ended, so that the report exists. */
  bool
  IsDone() const;

  /** Returns the report, when IsDone(). */
  const Report &
  GetReport() const;

  /** Returns the temporal mean of every pixel [DN], row by row, when IsDone(). */
  const std::vector<double> &
  GetMean() const;
  /** Returns the temporal variance of every pixel [DN^2], row by row, when IsDone(). */
  const std::vector<double> &
  GetVariance() const;
  /** Returns the variance of every pixel without flicker and motion [DN^2], row by row, when IsDone(). It is NaN if it
   * is not known. The map is empty if the stack cannot be measured. */
  const std::vector<double> &
  GetCorrectedVariance() const;
  /** Returns the use of every pixel in the estimate, values of PixelUse, row by row, when IsDone(). */
  const std::vector<std::uint8_t> &
  GetPixelUse() const;

  /** Move the maps of the functions above out, when IsDone(). These maps are empty afterwards. */
  std::vector<double>
  TakeMean();
  std::vector<double>
  TakeVariance();
  std::vector<double>
  TakeCorrectedVariance();
  std::vector<std::uint8_t>
  TakePixelUse();

protected:
  explicit StackMethod(std::unique_ptr<StackPasses<TPixel>> passes);
  StackMethod(StackMethod && other) noexcept;
  StackMethod &
  operator=(StackMethod && other) noexcept;
  ~StackMethod();

  std::unique_ptr<StackPasses<TPixel>> m_Passes;
};

/** \class PublishedMethod
 * \brief Runs the algorithm of Figure 2 of Sur & Gredi\'ac 2015 in three passes over the stack.
 *
 * The paper is https://doi.org/10.1137/140977035. Pass 1 sums the temporal moments, which give mean, variance, clip
 * levels, the vibration mask and the iso-intensity sets. Pass 2 sums each frame over these sets, which gives flicker
 * and offset. Pass 3 sums the corrected variance, which gives gain and intercept. Several processes exchange sums of 32
 * bytes per frame and 8 bytes per frame and row in pass 2, and of 8 bytes per pixel in pass 3.
 *
 * Equal frames are counted once. The flicker is reported for all of them.
 *
 * The result has the same bits for any number of threads and any chunks. The method needs 40 bytes per pixel and 8
 * bytes per frame and row. A stack that cannot be measured gives a report whose quantities have `failed`, with a
 * warning that names the reason. Wrong use throws std::invalid_argument. */
template <typename TPixel>
class PublishedMethod final : public StackMethod<TPixel>
{
public:
  using Settings = PublishedSettings;

  /** Starts the first pass.
   * \param settings settings of the method
   * \param geometry size of a frame, at least 3 x 3 pixels
   * \param frames number of frames of the stack, at least 5
   * \param mask for each pixel a nonzero value if it is to be used; empty: all
   * \param parallelFor spreads the work over threads
   * \throws std::invalid_argument for settings out of range, see PublishedSettings::Validate(), for fewer frames or
   * smaller frames, and for a mask of another size. */
  PublishedMethod(const PublishedSettings &         settings,
                  const FrameGeometry &             geometry,
                  std::size_t                       frames,
                  const std::vector<std::uint8_t> & mask = {},
                  ParallelFor                       parallelFor = SerialFor);
};

/** \class RefinedMethod
 * \brief Estimates gain, offset and read noise at the theoretical limit, in three passes over the stack.
 *
 * Pass 1 sums the temporal moments, which give the mean image, an initial noise model and the clipped pixels. Pass 2
 * regresses every frame on the mean image and its derivatives. It gives the offset and the temporal components of
 * flicker, local illumination and motion. Pass 3 projects the time series of every pixel on these components. The
 * residual is sensor noise, and the regression of its variance on the mean gives gain and intercept. If the
 * illumination changes strongly, the stack is read once more between passes 1 and 2. Several processes exchange sums of
 * 16 kB per frame in pass 2, of 4 or 8 bytes per pixel and component in pass 3, and of 8 bytes per pixel in the
 * additional pass.
 *
 * A stack with repeated frames has the result of its distinct frames, at the times that the correlation of their noise
 * shows. The series of the report have the same value for equal frames.
 *
 * The result has the same bits for any number of threads and any chunks. The method needs 20 kB per frame, 32 MiB, and
 * 48 bytes per pixel. If 10 bytes per pixel, and 4 per pixel and component of illumination and motion (2 to 20 are
 * found), are more, it needs these instead. Large changes of the illumination at 16 bits need 8 bytes per component.
 * Floating-point pixels need 52 bytes, or 20 and 8 per component. A stack that cannot be measured gives a report whose
 * quantities have `failed`, with a warning that names the reason. Wrong use throws std::invalid_argument. */
template <typename TPixel>
class RefinedMethod final : public StackMethod<TPixel>
{
public:
  using Settings = RefinedSettings;

  /** Starts the first pass.
   * \param settings settings of the method
   * \param geometry size of a frame, at least 3 x 3 pixels
   * \param frames number of frames of the stack, at least 5
   * \param mask for each pixel a nonzero value if it is to be used; empty: all
   * \param parallelFor spreads the work over threads
   * \throws std::invalid_argument for settings out of range, see RefinedSettings::Validate(), for fewer or smaller
   * frames, for a mask or exposures of another size, and for a memory limit below the least need. */
  RefinedMethod(const RefinedSettings &           settings,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<std::uint8_t> & mask = {},
                ParallelFor                       parallelFor = SerialFor);

  /** Declares that no sums of the third pass will be saved or merged. If all frames are then added to this pass in one
   * call of AddFrames(), it needs no memory for sums. Call it before the third pass. If it is called before the first
   * pass ends, it holds for the additional pass under strongly changing illumination, too. */
  void
  DisableMerging();
};

#define SensorNoise_EXTERN(TPixel)                                  \
  extern template class SensorNoise_EXPORT StackMethod<TPixel>;     \
  extern template class SensorNoise_EXPORT PublishedMethod<TPixel>; \
  extern template class SensorNoise_EXPORT RefinedMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
