// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedMethod_h
#define sensornoise_refined_RefinedMethod_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/NothingToMeasure.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/correlation/NoiseCorrelation.h"
#include "sensornoise/moments/DistinctFrames.h"
#include "sensornoise/moments/FrameThumbnails.h"
#include "sensornoise/moments/PassFrames.h"
#include "sensornoise/moments/StackMoments.h"
#include "sensornoise/pixels/StaticVariance.h"
#include "sensornoise/refined/PixelProjections.h"
#include "sensornoise/refined/PolishedSeries.h"
#include "sensornoise/refined/RefinedSettings.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/scene/StillScene.h"
#include "sensornoise/series/FrameSums.h"
#include "sensornoise/series/SceneSeries.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class RefinedMethod
 * \brief Gain, offset and read noise at the theoretical limit, in three passes over the stack.
 *
 * Pass 1 gathers the temporal moments: the mean image, a rough noise model, what is clipped. Pass 2 regresses every
 * frame on the mean image and its derivatives: the series over time of flicker, local light and motion, and the
 * offset. Pass 3 projects every pixel's time series on these few series; what is left is sensor noise, whose
 * regression on the mean gives gain and intercept. Usage as PublishedMethod.
 *
 * Frames that are equal, bit by bit, are counted once: the result is that of the distinct frames, and the report's
 * series repeat the values of a frame's original.
 *
 * Same bits for any number of threads and any chunks. Memory: 56 bytes a pixel and 8 more for each series of light and
 * motion that is found (2 to 20), 20 kB a frame and 32 MiB, see MemoryNeed. A stack that cannot be measured
 (NothingToMeasure) ends in a report whose quantities are `failed`, with a
 * warning that says why; wrong use throws std::invalid_argument. May be moved, also between and within passes.
 *
 * Several processes, each with a part of the frames, get the whole's report if they share the sums of every pass: the
 * whole's bits with integer pixels; with floating point the same bits in all of them, equal to the whole's to rounding.
 * Equal frames must be read by one process, or by one that has merged the other's sums before: where two have counted
 * the same frame, MergeSums() throws and names both.
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
 */
template <typename TPixel>
class RefinedMethod
{
public:
  static constexpr unsigned int NumberOfPasses = 3;

  /** \a mask, if given, has a nonzero value at the pixels to be used; \a parallelFor spreads the work. Throws
   * std::invalid_argument for settings out of range, see RefinedSettings::Validate(), and for a stack or a mask that
   * RequireStack() refuses. */
  RefinedMethod(const RefinedSettings &           settings,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<std::uint8_t> & mask = {},
                ParallelFor                       parallelFor = SerialFor);

  /** Adds the next \a frames frames of the current pass, stored one after the other. Throws std::logic_error if there
   * are not so many left. */
  void
  AddFrames(const TPixel * chunk, std::size_t frames);

  /** The next \a frames frames of the current pass are added by other processes. */
  void
  SkipFrames(std::size_t frames);

  /** Frame \a t, from 0, is the next one of the current pass: frames may be added in any order. Floating-point ones are
   * summed in the order in which they come. Throws std::logic_error if there is none. */
  void
  GoTo(std::size_t t);

  /** For every frame, 1 if it was added, or merged, in the current pass. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_InPass.GetHas();
  }

  /** Pass 1: what two processes would count, as the fingerprints of their frames are equal, one of them is told to
   * leave to the other: \a areCountedElsewhere has a value for each frame, 0 where it is counted. Before they are
   * added. */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere)
  {
    m_Moments.SetCountedElsewhere(areCountedElsewhere);
  }
  const FrameFingerprints &
  GetFingerprints() const
  {
    return m_Moments.GetFingerprints();
  }

  /** Takes back all that was added in the current pass. */
  void
  ForgetSums();

  /** Gives back memory that merged floating-point sums of pass 1 take, 32 bytes a pixel each: then the bits depend on
   * the order of merges. */
  void
  FoldSums()
  {
    m_Moments.Fold();
  }

  /** Writes the sums over the frames of the current pass that have been added or merged so far, see BinaryStream: 20
   * (integers) or 32 bytes a pixel in pass 1, 16 kB a frame in pass 2, 8 bytes a pixel and series in pass 3. */
  void
  SaveSums(std::ostream & out) const;

  /** Adds the sums that another object, with the same arguments, saved in the same pass. Throws std::runtime_error, and
   * changes nothing, if the stream is no such sums, or holds a frame that is here, too, or equals one that is. */
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Whether the report is there. That is after NumberOfPasses passes, or more if RefinedSettings::memoryLimitBytes
   * asks for it: these read the stack once more, like the third. */
  bool
  IsDone() const
  {
    return m_IsDone;
  }
  const Report &
  GetReport() const
  {
    return m_Report;
  }
  const std::vector<double> &
  GetMean() const
  {
    return m_Scene->frame.mean;
  }
  const std::vector<double> &
  GetVariance() const
  {
    return m_Scene->frame.variance;
  }
  /** NaN where it was not computed; empty if the stack cannot be measured. */
  const std::vector<double> &
  GetCorrectedVariance() const
  {
    return m_CorrectedVariance;
  }
  /** Values of PixelUse. */
  const std::vector<std::uint8_t> &
  GetPixelUse() const
  {
    return m_Variance ? m_Variance->pixelUse : m_Scene->pixelUse;
  }

  /** Give the maps away, after which they are empty here. */
  std::vector<double>
  TakeMean()
  {
    return std::move(m_Scene->frame.mean);
  }
  std::vector<double>
  TakeVariance()
  {
    return std::move(m_Scene->frame.variance);
  }
  std::vector<double>
  TakeCorrectedVariance()
  {
    return std::move(m_CorrectedVariance);
  }
  std::vector<std::uint8_t>
  TakePixelUse()
  {
    return std::move(m_Variance ? m_Variance->pixelUse : m_Scene->pixelUse);
  }

private:
  /** Adds \a count of the distinct frames, the first of which has the given place among them, in pass 2 or 3. */
  void
  AddDistinct(const TPixel * frames, std::size_t place, std::size_t count);
  /** Of all that the sums of the current pass depend on beside the frames. */
  std::uint64_t
  FingerprintOfPass() const;
  void
  EndMoments();
  void
  EndFrameSums();
  bool
  EndProjections();
  void
  MeasureVariance();
  /** Of companded codes. */
  CodeNoise
  FindCodeNoise() const;
  void
  MakeReport();

  RefinedSettings           m_Settings;
  FrameGeometry             m_Geometry;
  std::size_t               m_Frames;
  std::vector<std::uint8_t> m_UserMask;
  ParallelFor               m_ParallelFor;
  PassFrames                m_InPass;

  // The sums of the passes, and what each pass found. The scene stays where it is: FrameSums points to its frame.
  StackMoments<TPixel>                  m_Moments;
  FrameThumbnails                       m_Thumbnails;
  DistinctFrames                        m_Distinct;
  std::unique_ptr<StillScene>           m_Scene;
  std::unique_ptr<FrameSums>            m_FrameSums; // null: the stack cannot be measured
  std::optional<const SceneSeries>      m_Series;
  std::optional<PixelProjections>       m_Projections;
  std::optional<StaticVariance>         m_Variance;
  std::optional<const PolishedSeries>   m_Polished;
  NoiseCorrelation                      m_Correlation;
  std::vector<double>                   m_CorrectedVariance;
  std::optional<const NothingToMeasure> m_Obstacle;
  bool                                  m_IsDone{ false };
  Report                                m_Report;
};

extern template class SensorNoise_EXPORT RefinedMethod<unsigned char>;
extern template class SensorNoise_EXPORT RefinedMethod<unsigned short>;
extern template class SensorNoise_EXPORT RefinedMethod<short>;
extern template class SensorNoise_EXPORT RefinedMethod<float>;
extern template class SensorNoise_EXPORT RefinedMethod<double>;

} // namespace sensornoise

#endif
