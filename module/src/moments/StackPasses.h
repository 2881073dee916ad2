// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackPasses_h
#define sensornoise_moments_StackPasses_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "base/PixelLayout.h"
#include "moments/FrameThumbnails.h"
#include "moments/StackFrames.h"
#include "moments/StackMoments.h"

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
 * \brief The passes of a method over a stack, in one process or in several: the implementation of StackMethod.
 *
 * The first pass is common to all methods: it computes the temporal moments and finds the frames that are equal bit by
 * bit, and the frames that are unlike the others. Equal frames are counted once. Unlike frames are left out: if there
 * are any, the next pass computes the moments of the others. The sums of the later passes, and the results, belong to
 * the method. */
template <typename TPixel>
class StackPasses
{
public:
  using Passes = StackPasses;

  virtual ~StackPasses() = default;

  /** See StackMethod. */
  static constexpr unsigned int NumberOfPasses = 3;

  /** Sets the layout of the pixels of the frames that are added. By default, frames are stored one after the other.
   * Call this once, before the first pass ends. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
  }

  /** Adds the next \a frames frames of the current pass, stored one after the other or as the layout specifies. Throws
   * std::logic_error if fewer are left. */
  void
  AddFrames(const TPixel * chunk, std::size_t frames);

  /** Adds the next \a count frames of the current pass, which are mosaics, to all of their \a planes. The planes have
   * one method, one size, and each its own layout. A row is read for all planes while it is in the cache. */
  static void
  AddFrames(const std::vector<StackPasses *> & planes,
            const TPixel *                     mosaics,
            std::size_t                        count,
            const ParallelFor &                parallelFor);

  /** Passes over the next \a frames frames of the current pass, which other processes add. */
  void
  SkipFrames(std::size_t frames)
  {
    m_InPass.Skip(frames);
  }

  /** Makes frame \a t, from 0, the next one of the current pass: frames may be added in any order. Floating-point
   * frames are summed in the order of adding. Throws std::logic_error if there is no such frame. */
  void
  GoTo(std::size_t t)
  {
    m_InPass.GoTo(t);
  }

  /** Returns 1 for every frame that was added or merged in the current pass, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_InPass.GetHas();
  }

  /** Pass 1: marks the frames that another process counts. Where two processes have frames with equal fingerprints, one
   * of them leaves its frames to the other. \a areCountedElsewhere has a value for each frame, 0 where it is counted
   * here. To be called before the frames are added. */
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

  /** Removes all that was added in the current pass. */
  void
  ForgetSums();

  /** Releases the memory of merged floating-point sums of pass 1, 32 bytes per pixel each. From then on the bits of the
   * result depend on the order of merges. */
  void
  FoldSums()
  {
    m_Moments.Fold();
  }

  /** Writes the sums over the frames of the current pass that have been added or merged so far, see BinaryStream. In
   * pass 1 they have 20 (integers) or 32 bytes per pixel. */
  void
  SaveSums(std::ostream & out) const;

  /** Adds the sums that another object, with the same arguments, saved in the same pass. Throws std::runtime_error, and
   * changes nothing, if the stream holds something else. The same happens if it holds a frame that has been added
   * here, or a frame that equals one of these. */
  void
  MergeSums(std::istream & in);

  /** Ends the current pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Results of the method, see StackMethod. */
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

  /** Returns whether the current pass is the first one, in which unlike frames are found. */
  bool
  IsFirstPass() const
  {
    return m_InPass.GetPass() == 0;
  }
  /** Returns the frames that are unlike the others, after all frames of the first pass have been added. */
  std::vector<LeftOutFrame>
  FindUnlike() const;
  /** Sets the frames that the first pass leaves out, in ascending order, instead of the result of FindUnlike(). */
  void
  LeaveOut(std::vector<LeftOutFrame> frames)
  {
    m_LeftOut = std::move(frames);
  }

protected:
  /** \a method is the name of the method in saved sums. Throws std::invalid_argument in the cases of RequireStack(). */
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

  /** One of the planes to which frames are added together. */
  struct Plane
  {
    StackPasses * passes; ///< plane, of the method that receives the call
    std::size_t   place;  ///< place of the first frame among the distinct frames
  };

  /** Returns the frames that are left out, after the first pass has ended. */
  std::vector<LeftOutFrame>
  GetLeftOut() const
  {
    return m_LeftOut.value_or(std::vector<LeftOutFrame>());
  }

  /** Leaves out further frames and starts again, if a later pass has found that they are unlike the others. The next
   * pass computes the moments of the rest, and the method computes all results anew.
   * \param places places of the frames among the distinct frames
   * \param fault reason why they are left out
   * \param largestFraction largest fraction of the frames that may be left out in all [1], see JoinUnlikeFrames()
   * \return false, without any change, if there are none or too many of them */
  bool
  RestartWithoutFrames(const std::vector<std::size_t> & places,
                       FrameFault                       fault,
                       double                           largestFraction = InMoments.largestLeftOutFraction);

  /** Returns the mask of the user; null: there is none. */
  const std::uint8_t *
  MaskOrNull() const
  {
    return m_UserMask.empty() ? nullptr : m_UserMask.data();
  }

  /** Returns whether the current pass sums moments. */
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
  DistinctFrames            m_Distinct; // set when the first pass has ended; without the frames that are left out

private:
  /** Adds \a count frames to the moments. */
  static void
  AddToMoments(const std::vector<StackPasses *> & planes,
               const TPixel *                     frames,
               std::size_t                        count,
               const ParallelFor &                parallelFor);

  /** Returns whether the method sums in the current pass. It does not while moments are summed, nor if the stack cannot
   * be measured. */
  virtual bool
  HasSums() const = 0;
  /** Adds \a count distinct frames to \a planes, this one or all planes of a mosaic. This function and the next three
   * are only called where HasSums() is true. */
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

  /** Adds the findings of the method in earlier passes to \a fingerprint. */
  virtual void
  AddFindings(Fingerprint & fingerprint) const = 0;
  /** Called when the moments are complete. */
  virtual void
  FinishMoments() = 0;
  /** Called when all frames of a later pass have been added. */
  virtual void
  FinishSums() = 0;

  /** Makes the next pass sum the moments of the frames that are not left out. */
  void
  RestartMoments();

  /** Returns a fingerprint of all data, apart from the frames, on which the sums of the current pass depend. */
  std::uint64_t
  FingerprintOfPass() const;

  std::string                              m_Name;
  std::size_t                              m_Frames;
  PassFrames                               m_InPass;
  bool                                     m_IsOfMoments{ true }; // whether the current pass sums moments
  std::optional<std::vector<LeftOutFrame>> m_LeftOut;             // none: not searched yet
  mutable std::optional<std::uint64_t>     m_Fingerprint; // result of FingerprintOfPass(), which is slow to compute and
                                                          // needed at every merge
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT StackPasses<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
