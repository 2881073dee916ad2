// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FitsFrames_h
#define sensornoise_files_FitsFrames_h

#include "sensornoise/FrameFile.h"
#include "files/FrameReader.h"

#include <cstdint>
#include <optional>

namespace sensornoise
{

/** Which numbers a FITS image holds, and what makes values of them: zero + factor * number. */
struct FitsScale
{
  int                         bitsOfPixel{ 16 }; // BITPIX; below 0: floating-point
  double                      factor{ 1.0 };     // BSCALE
  double                      zero{ 0.0 };       // BZERO
  std::optional<std::int64_t> blank{};           // the number of pixels without a value
};

/** The smallest type that holds each value exactly; double where the scale makes other values. */
FramePixel
PixelOf(const FitsScale & scale);

/** Reads frames of a FITS image. */
class FitsFrames : public FrameReader
{
public:
  /** \a begin: the byte of the first pixel. */
  FitsFrames(std::uint64_t begin, const FitsScale & scale)
    : m_Begin(begin)
    , m_Scale(scale)
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override;

private:
  std::uint64_t m_Begin;
  FitsScale     m_Scale;
};

} // namespace sensornoise

#endif
