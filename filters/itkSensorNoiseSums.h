/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef itkSensorNoiseSums_h
#define itkSensorNoiseSums_h

#include "SensorNoiseExport.h"
#include "itkImage.h"
#include "itkObject.h"
#include "itkObjectFactory.h"
#include "itkSensorNoiseEstimator.h"
#include "sensornoise/FrameGeometry.h"

#include <ostream>
#include <string>

namespace itk
{

/** \class SensorNoiseSums
 * \brief Exposes the sums of SensorNoiseEstimator, so that several processes can each read a part of the frames.
 *
 * The estimator makes three or more passes over the stack, see IsDone(). In each pass every process adds its frames. It
 * then sends its sums, a row of bytes, to the other processes, or to one process that merges them. When all frames are
 * included, every process merges the sums of the whole stack and ends the pass. All processes start the next pass from
 * the same state. After the last pass the estimator has the report and the maps.
 *
 * With 8- and 16-bit pixels the results are bit-identical to the results of one process that reads all frames. They do
 * not depend on which process reads a part or on the order of merging. With floating-point pixels they agree to
 * rounding, and the same parts, merged in the same order, give the same bits.
 *
 * Size of the sums in bytes:
 *
 * - Pass 1: 20 for each pixel (floating point: 32), and 2 kB for each included frame.
 * - Pass 2: 16 kB for each frame.
 * - Pass 3: 8 for each pixel and temporal component (4 to 20 components), and a sample of at most 32 MiB.
 * - The extra pass after pass 1, which strong changes of the illumination need: 8 for each pixel.
 * - Method Published, pass 2: 32 for each frame, and 8 for each frame and row.
 * - Method Published, pass 3: 8 for each pixel.
 *
 * Sums can be merged only by the same version of the module on the same kind of machine. A stack has at most 2^22
 * frames, the number up to which sums of integers are exact. The memory is the memory of the estimator and twice the
 * size of the sums.
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time) of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT SensorNoiseSums : public Object
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseSums);

  using Self = SensorNoiseSums;
  using Superclass = Object;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using EstimatorType = SensorNoiseEstimator<TStack>;
  using BytesType = Image<unsigned char, 2>;
  using BytesPointer = BytesType::Pointer;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseSums";
  }

  /** Starts the first pass with the settings, mask and dark frames of an estimator; mask and dark frames are read. Only
   * the size and the metadata of its stack are used; the stack needs no pixels. A Bayer pattern "auto" is taken from
   * the metadata, else from \a recognised, the result of RecogniseBayerPattern() for the first frame. Throws an
   * ExceptionObject if neither gives a pattern. The estimator must not be changed or updated from then on. */
  void
  Start(EstimatorType * estimator, const std::string & recognised = "");

  /** Returns the Bayer pattern that the levels of the first frame show: "RGGB", "GRBG", "GBRG", "BGGR" or "none". */
  static std::string
  RecogniseBayerPattern(const TStack * frames);

  /** Returns the index of the current pass, from 0, which is the number of passes that have ended. */
  unsigned int
  GetPass() const
  {
    return m_Pass;
  }

  /** Returns whether all passes have ended and the estimator has the results. There are three passes. There is one more
   * if frames are left out because they differ from the others, and one more if the illumination changes strongly. */
  bool
  IsDone() const;

  /** Returns the number of planes: 4 for a mosaic, whose planes are measured separately, else 1. */
  unsigned int
  GetNumberOfPlanes() const;

  /** Adds the frames of an image in memory to the sums of the current pass. The first frame of the image is frame \a
   * first of the stack. Frames may be added in any order; floating-point frames are summed in the order in which they
   * are added. Throws an ExceptionObject, and adds nothing, if the frames do not have the size of the stack or a frame
   * is already included. */
  void
  AddFrames(const TStack * frames, SizeValueType first);

  /** Returns a row with a value for each frame: 1 if the frame is included, else 0. */
  BytesPointer
  GetFrames() const;
  /** Returns a row with a value for each frame: 1 if the frame is included in \a sums, else 0. The bytes \a sums are
   * the result of GetSums() of this or another process, in the same pass. */
  BytesPointer
  GetFramesOf(const BytesType * sums) const;

  /** Returns the fingerprints of the frames in pass 1: a row for each included frame, with 16 bytes for each plane.
   * Equal fingerprints mean that the frames are bit-identical. Equal frames are counted once: two processes that have
   * both counted such a frame cannot be merged. */
  BytesPointer
  GetFingerprints() const;

  /** Sets the frames that another process counts, because they are equal to one of its frames. The array \a flags has a
   * row for each plane, with a value for each frame. A value other than 0 means that another process counts the frame.
   * Call this in pass 1, before the frames are added. */
  void
  SetCountedElsewhere(const BytesType * flags);

  /** Returns the sums of the included frames as one row of bytes, after their version, length and checksum. */
  BytesPointer
  GetSums() const;

  /** Adds the sums of other frames and returns true. Returns false, and changes nothing, if all of these frames are
   * already included, which means that the sums were sent twice. Throws an ExceptionObject if a part of the frames is
   * already included, or if the sums belong to another stack, pass, start or version of the module. Throws an
   * ExceptionObject, too, if the bytes are damaged or incomplete. */
  bool
  MergeSums(const BytesType * sums);

  /** Removes all frames and sums that were added or merged in the current pass. */
  void
  ForgetSums();

  /** Ends the pass. Throws an ExceptionObject if a frame is missing. */
  void
  EndPass();

protected:
  SensorNoiseSums() = default;
  ~SensorNoiseSums() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Throws if no pass is in progress. */
  void
  RequirePass() const;

  typename EstimatorType::Pointer m_Estimator;
  unsigned int                    m_Pass{ 0 };
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseSums<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
