// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_StackMethod_h
#define sensornoise_StackMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"

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
 * \brief What both methods share: the passes over a stack, in one process or in several, the report and the maps.
 *
 * Frames that are equal, bit by bit, are counted once. Frames that are unlike the others are left out. If there are
 any,
 * the next pass repeats the first one without them. Usage, with RefinedMethod for example:
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
 * Several processes, each with a part of the frames, share the sums of every pass and all get the report of the whole
 * stack. With integer pixels it has the bits of a single process. With floating-point pixels it is equal to rounding,
 and
 * has the same bits in all processes. Equal frames must be read by one process, or by one that has merged the other's
 * sums before: where two have counted the same frame, MergeSums() throws and names both.
   \code
   RefinedMethod<unsigned short> method(settings, geometry, frames); // alike in every process
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
 * May be moved, also between and within passes.
 *
 * \tparam TPixel unsigned char, unsigned short, short, float or double. */
template <typename TPixel>
class StackMethod
{
public:
  /** Number of times that a stack is read. It is read more often where frames are left out, where the illumination
   * changes strongly, or where RefinedSettings::memoryLimitBytes asks for it. */
  static constexpr unsigned int NumberOfPasses = 3;

  /** Fingerprint of the bytes of a frame: equal for equal frames. */
  using FrameFingerprint = std::array<std::uint64_t, 2>;

  /** Adds the next \a count frames of the current pass, stored one after the other, row by row. Throws std::logic_error
   * if fewer frames are left. */
  void
  AddFrames(const TPixel * frames, std::size_t count);

  /** Leaves the next \a count frames of the current pass to other processes. */
  void
  SkipFrames(std::size_t count);

  /** Makes frame \a frame, from 0, the next one of the current pass: frames may be added in any order. Floating-point
   * frames are summed in the order in which they come. Throws std::logic_error if there is no such frame. */
  void
  GoTo(std::size_t frame);

  /** Returns 1 for every frame that was added or merged in the current pass, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const;

  /** Returns the fingerprints of the frames that were added or merged in the first pass, by frame. */
  const std::map<std::size_t, FrameFingerprint> &
  GetFingerprints() const;

  /** Sets which frames another process counts, as theirs have equal fingerprints: \a areCountedElsewhere has a value
   * for each frame, 0 where it is counted here. Call it in the first pass, before these frames are added. */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere);

  /** Takes back all that was added in the current pass. */
  void
  ForgetSums();

  /** Gives back memory that merged floating-point sums of the first pass take, 32 bytes a pixel each. The bits then
   * depend on the order of merges. */
  void
  FoldSums();

  /** Writes the sums over the frames of the current pass that have been added or merged so far: 20 bytes a pixel
   * (integers) or 32 (floating point) in the first pass. */
  void
  SaveSums(std::ostream & out) const;

  /** Adds the sums that another object, with the same arguments, saved in the same pass. Throws std::runtime_error, and
   * changes nothing, if the stream holds no such sums, or a frame that is here, too, or equals one that is. */
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Returns whether the report is there. */
  bool
  IsDone() const;

  /** Returns the report, when IsDone(). */
  const Report &
  GetReport() const;

  /** Temporal mean of every pixel [DN], when IsDone(). */
  const std::vector<double> &
  GetMean() const;
  /** Temporal variance of every pixel [DN^2]. */
  const std::vector<double> &
  GetVariance() const;
  /** The variance without flicker and motion [DN^2]: NaN where it is not known; empty if the stack cannot be measured.
   */
  const std::vector<double> &
  GetCorrectedVariance() const;
  /** Use of every pixel in the estimate: values of PixelUse. */
  const std::vector<std::uint8_t> &
  GetPixelUse() const;

  /** Move the maps out. They are empty afterwards. */
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

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT StackMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
