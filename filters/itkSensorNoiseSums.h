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
 * \brief The sums of SensorNoiseEstimator by themselves: several processes, each with a part of the frames, share them.
 *
 * The estimator goes over the stack three times or more, see IsDone(). In each pass every
 * process adds its frames and hands the sums, a row of bytes, to the others, or to one that merges all; when all frames
 * are in, every process merges the sums of the whole and ends the pass, and all of them start the next one alike. After
 * the last pass the estimator has the report and the maps. With 8- and 16-bit pixels they are those of one process that
 * reads all frames, bit by bit, whatever part is read by whom and merged when; with floating point they agree to
 * rounding, and the same parts, merged in the same order, give the same bits.
 *
 * Bytes of the sums: in pass 1, 20 a pixel (floating point: 32) and 2 kB a frame that is in; in pass 2, 16 kB a frame;
 * in pass 3, 8 a pixel and series (4 to 20), and a sample of at most 32 MiB; in the pass that strong changes of the
 * illumination add after pass 1, 8 a pixel. Method Published: 32 a frame and 8 a frame
 * and row in pass 2, 8 a pixel in pass 3. They are for the same version of the module on the same kind of machine. Up
 * to 2^22 frames, for which sums of integers are exact. Memory: that of the estimator, and twice the sums.
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

  /** Starts the first pass with an estimator's settings, mask and dark frames, which are read. Of its stack only the
   * size and the metadata are looked at: it needs no pixels. A Bayer pattern "auto" is what the metadata say, else what
   * \a recognised says of the first frame, see RecogniseBayerPattern(); an ExceptionObject where neither does. The
   * estimator is not to be changed or updated from then on. */
  void
  Start(EstimatorType * estimator, const std::string & recognised = "");

  /** "RGGB", "GRBG", "GBRG" or "BGGR", as the levels of the first frame tell, or "none". */
  static std::string
  RecogniseBayerPattern(const TStack * frames);

  /** The current pass, from 0: how many have ended. */
  unsigned int
  GetPass() const
  {
    return m_Pass;
  }

  /** Whether all passes have ended, and the estimator has the results: after three, and one more each where frames are
   * left out, as they are unlike the others, and where the illumination changes strongly. */
  bool
  IsDone() const;

  /** Of a mosaic 4, which are measured each by itself, else 1. */
  unsigned int
  GetNumberOfPlanes() const;

  /** Adds the frames of an image in memory to the sums of the current pass, the first as frame \a first of the stack.
   * Frames may come in any order; those of floating-point pixels are summed in the order in which they come. An
   * ExceptionObject, and nothing is added, if they are not of the stack's size, or one is in. */
  void
  AddFrames(const TStack * frames, SizeValueType first);

  /** A row with a value for each frame: 1 if it is in, else 0. */
  BytesPointer
  GetFrames() const;
  /** The same of what GetSums() wrote, here or elsewhere, in the same pass. */
  BytesPointer
  GetFramesOf(const BytesType * sums) const;

  /** Pass 1: a row for each frame that is in, of 16 bytes a plane, which are equal where frames are equal, bit by bit.
   * Equal frames are counted once: two processes that have counted one each cannot be merged. */
  BytesPointer
  GetFingerprints() const;

  /** Pass 1, before the frames are added: a row for each plane with a value for each frame, not 0 where it is left to
   * another process to count the frame, because it has an equal one. */
  void
  SetCountedElsewhere(const BytesType * flags);

  /** The sums of the frames that are in, as one row of bytes, behind their version, length and checksum. */
  BytesPointer
  GetSums() const;

  /** Adds the sums of other frames. Returns false, and changes nothing, if all of these are in: then they were handed
   * over twice. An ExceptionObject if some are in, if the sums are of another stack, pass, start or version of the
   * module, and if the bytes are damaged or not all that GetSums() returned. */
  bool
  MergeSums(const BytesType * sums);

  /** Takes back what was added and merged in the current pass. */
  void
  ForgetSums();

  /** Ends the pass. An ExceptionObject if a frame is missing. */
  void
  EndPass();

protected:
  SensorNoiseSums() = default;
  ~SensorNoiseSums() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Throws unless a pass is under way. */
  void
  RequirePass() const;

  typename EstimatorType::Pointer m_Estimator;
  unsigned int                    m_Pass{ 0 };
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseSums<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
