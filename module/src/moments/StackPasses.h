// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackPasses_h
#define sensornoise_moments_StackPasses_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "base/PixelLayout.h"
#include "moments/DistinctFrames.h"
#include "moments/FrameFingerprints.h"
#include "moments/FrameThumbnails.h"
#include "moments/PassFrames.h"
#include "moments/StackMoments.h"
#include "moments/UnlikeFrames.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

class Fingerprint;

/** \class StackPasses
 * \brief The passes of a method over a stack, in one process or in several: what is behind StackMethod.
 *
 * The first pass is that of every method: the temporal moments, the frames that are equal, bit by bit, and those that
 * are unlike the others. Equal frames are counted once. Unlike frames are left out: if there are any, the next pass is
 * for the moments of the others. What is made of these, and what later passes sum, is the method's. */
template <typename TPixel>
class StackPasses
{
public:
  using Passes = StackPasses;

  virtual ~StackPasses() = default;

  /** See StackMethod. */
  static constexpr unsigned int NumberOfPasses = 3;

  /** The pixels of the frames to come stand as \a layout says; without it, one frame after the other. To be told once,
   * before the first pass ends. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
  }

  /** Adds the next \a frames frames of the current pass, stored one after the other or as the layout says. Throws
   * std::logic_error if there are not so many left. */
  void
  AddFrames(const TPixel * chunk, std::size_t frames);

  /** Adds the next \a count frames of the current pass, which are mosaics, to all \a planes of theirs, of one method
   * and size and each with its layout: what one has read of a row is near when the next comes to it. */
  static void
  AddFrames(const std::vector<StackPasses *> & planes,
            const TPixel *                     mosaics,
            std::size_t                        count,
            const ParallelFor &                parallelFor);

  /** The next \a frames frames of the current pass are added by other processes. */
  void
  SkipFrames(std::size_t frames)
  {
    m_InPass.Skip(frames);
  }

  /** Frame \a t, from 0, is the next one of the current pass: frames may be added in any order. Floating-point ones are
   * summed in the order in which they come. Throws std::logic_error if there is none. */
  void
  GoTo(std::size_t t)
  {
    m_InPass.GoTo(t);
  }

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
   * (integers) or 32 bytes a pixel in pass 1. */
  void
  SaveSums(std::ostream & out) const;

  /** Adds the sums that another object, with the same arguments, saved in the same pass. Throws std::runtime_error, and
   * changes nothing, if the stream is no such sums, or holds a frame that is here, too, or equals one that is. */
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** What the method finds, see StackMethod. */
  virtual bool
  IsDone() const = 0;
  virtual const Report &
  GetReport() const = 0;
  virtual const std::vector<double> &
  GetMean() const = 0;
  virtual const std::vector<double> &
  GetVariance() const = 0;
  virtual const std::vector<double> &
  GetCorrectedVariance() const = 0;
  virtual const std::vector<std::uint8_t> &
  GetPixelUse() const = 0;
  virtual std::vector<double>
  TakeMean() = 0;
  virtual std::vector<double>
  TakeVariance() = 0;
  virtual std::vector<double>
  TakeCorrectedVariance() = 0;
  virtual std::vector<std::uint8_t>
  TakePixelUse() = 0;

  /** Whether the current pass is the first one, in which unlike frames are found. */
  bool
  IsFirstPass() const
  {
    return m_InPass.GetPass() == 0;
  }
  /** All frames of the first pass are in: those that are unlike the others. */
  std::vector<LeftOutFrame>
  FindUnlike() const
  {
    return FindUnlikeFrames(m_Thumbnails);
  }
  /** The first pass ends by leaving out these frames, in order, instead of what FindUnlike() says. */
  void
  LeaveOut(std::vector<LeftOutFrame> frames)
  {
    m_LeftOut = std::move(frames);
  }

protected:
  /** \a method is its name in saved sums. Throws std::invalid_argument for what RequireStack() refuses. */
  StackPasses(const std::string &               method,
              const FrameGeometry &             geometry,
              std::size_t                       frames,
              const std::vector<std::uint8_t> & mask,
              ParallelFor                       parallelFor);
  StackPasses(StackPasses &&) noexcept = default;
  StackPasses &
  operator=(StackPasses &&) noexcept = default;

  /** The current pass, from 0. */
  unsigned int
  GetPass() const
  {
    return m_InPass.GetPass();
  }

  /** One of the frames that frames are added to together. */
  struct Plane
  {
    StackPasses * passes; ///< of the method that is asked
    std::size_t   place;  ///< of the first frame among the distinct ones
  };

  /** The frames that are left out, when the first pass has ended. */
  std::vector<LeftOutFrame>
  GetLeftOut() const
  {
    return m_LeftOut.value_or(std::vector<LeftOutFrame>());
  }

  /** A later pass found that the frames at these places among the distinct ones are unlike the others: the next pass
   * is for the moments of the rest, and all that the method found is to be found anew. Returns whether it is so: not if
   * they are too many, all together more than \a largestShare of the frames (JoinUnlikeFrames). */
  bool
  StartAgainWithout(const std::vector<std::size_t> & places,
                    FrameFault                       fault,
                    double                           largestShare = InMoments.largestLeftOutShare);

  /** Whether the current pass gathers moments. */
  bool
  IsOfMoments() const
  {
    return m_IsOfMoments;
  }

  FrameGeometry             m_Geometry;
  PixelLayout               m_Layout;
  std::vector<std::uint8_t> m_UserMask;
  ParallelFor               m_ParallelFor;
  StackMoments<TPixel>      m_Moments;
  FrameThumbnails           m_Thumbnails;
  DistinctFrames            m_Distinct; // when the first pass has ended; without those left out

private:
  /** Adds \a count frames to the moments. */
  static void
  AddToMoments(const std::vector<StackPasses *> & planes,
               const TPixel *                     frames,
               std::size_t                        count,
               const ParallelFor &                parallelFor);

  /** Whether the method sums in the current pass: not while moments are gathered, nor if the stack cannot be measured.
   */
  virtual bool
  HasSums() const = 0;
  /** What follows is only asked for where it has sums. Adds \a count distinct frames to \a planes, this one or all of
   * a mosaic's. */
  virtual void
  AddDistinct(const std::vector<Plane> & planes,
              const TPixel *             frames,
              std::size_t                count,
              const ParallelFor &        parallelFor) const = 0;
  virtual void
  ForgetOwnSums() = 0;
  virtual void
  SaveOwnSums(std::ostream & out) const = 0;
  virtual void
  MergeOwnSums(std::istream & in) = 0;

  /** Adds what the method found in the passes before. */
  virtual void
  AddFindings(Fingerprint & fingerprint) const = 0;
  /** The moments are complete. */
  virtual void
  FinishMoments() = 0;
  /** All frames of a later pass are in. */
  virtual void
  FinishSums() = 0;

  /** The next pass is for the moments of the frames that are not left out. */
  void
  StartMomentsAgain();

  /** Of all that the sums of the current pass depend on beside the frames. */
  std::uint64_t
  FingerprintOfPass() const;

  std::string                              m_Name;
  std::size_t                              m_Frames;
  PassFrames                               m_InPass;
  bool                                     m_IsOfMoments{ true }; // the current pass
  std::optional<std::vector<LeftOutFrame>> m_LeftOut;             // none: not looked for
  mutable std::optional<std::uint64_t>     m_Fingerprint; // of the pass: takes a while, and is asked for at every merge
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT StackPasses<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
