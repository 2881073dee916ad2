// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_FrameSample_h
#define sensornoise_correlation_FrameSample_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

/** The axis of lines of a frame whose pixels have noise or illumination in common. */
enum class LineAxis : std::uint8_t
{
  Rows,
  Columns
};

/** \class SampleTiles
 * \brief Square tiles, spread evenly over the frame without overlap, and the first frames of the stack, in which the
 * noise is sampled.
 *
 * They depend on the size of the stack alone. Pairs of pixels lie within a tile. The tiles are the blocks of the
 * jackknife. */
struct SensorNoise_EXPORT SampleTiles
{
  /** Largest number of pixels in all tiles (estimator.md, 3.12): the error of coefficients is 0.0004 for 100 frames.
   * Chosen empirically: half and twice the number change the errors by its square root, and the cost in proportion. */
  static constexpr std::size_t MostPixels = std::size_t{ 1 } << 17;
  /** Largest number of values in all tiles, of 2 or 4 bytes: 16 or 32 MiB, see MostValuesOf(). */
  static constexpr std::size_t MostValues = std::size_t{ 1 } << 23;
  /** Number of values for each pixel of a frame, and the number that a small frame may always have. Chosen empirically,
   * so that the four planes of a mosaic need no more memory than one frame of its size. With half the number, errors
   * are 1.4 times as large; with twice the number, a mosaic of 1.4 megapixels needs a tenth more memory than one
   * frame. */
  static constexpr std::size_t MostValuesPerPixel = 8;
  static constexpr std::size_t MostValuesOfSmall = std::size_t{ 1 } << 22;
  /** Largest number of frames. More frames would leave too few tiles to cover all levels, and would not improve the
   * temporal correlation. */
  static constexpr std::size_t MostFrames = 256;
  /** Number of tiles that a jackknife needs for an error to 20 %. */
  static constexpr std::size_t EnoughTiles = 16;
  /** Side of a tile [pixels], and its value where fewer than EnoughTiles tiles would fit. */
  static constexpr std::size_t Side = 32;
  static constexpr std::size_t SmallSide = 16;

  struct Origin
  {
    std::size_t x;
    std::size_t y;
  };

  /** Returns the largest number of values in all tiles, for frames of \a pixels pixels. */
  static constexpr std::size_t
  MostValuesOf(std::size_t pixels)
  {
    return std::clamp(MostValuesPerPixel * pixels, MostValuesOfSmall, MostValues);
  }

  std::size_t         side{ 0 };   ///< [pixels]
  std::size_t         frames{ 0 }; ///< number of frames, which are the first of the stack
  std::vector<Origin> origins;     ///< upper left pixels of the tiles

  /** Returns the number of pixels of one tile. */
  std::size_t
  Pixels() const
  {
    return side * side;
  }
  /** Returns the number of values of all tiles and frames. */
  std::size_t
  Values() const
  {
    return origins.size() * frames * this->Pixels();
  }
  /** Returns the index of the first value of tile \a i in frame \a t. Values are ordered by tile, frame and row. */
  std::size_t
  PlaceOf(std::size_t i, std::size_t t) const
  {
    return (i * frames + t) * this->Pixels();
  }
  /** Returns the index in its tile of pixel \a k of line \a line. */
  std::size_t
  InTile(LineAxis axis, std::size_t line, std::size_t k) const
  {
    return axis == LineAxis::Rows ? line * side + k : k * side + line;
  }
  /** Returns the index, in a frame of \a width columns, of pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p, std::size_t width) const
  {
    return (origins[i].y + p / side) * width + origins[i].x + p % side;
  }
};

/** Returns the tiles for a stack of \a frames frames; none if the frame is smaller than a tile. */
SensorNoise_EXPORT SampleTiles
MakeSampleTiles(const FrameGeometry & geometry, std::size_t frames);

/** Returns the tiles that lie in one line, group by group: the indices of the tiles at the same rows or columns. */
SensorNoise_EXPORT std::vector<std::vector<std::size_t>>
TilesInLine(const SampleTiles & tiles, LineAxis axis);

/** \class NoiseSample
 * \brief Time series of the sampled pixels above their means, on which the noise correlation is measured.
 *
 * FrameSample gathers it. Memory: at most 32 MiB. */
class SensorNoise_EXPORT NoiseSample
{
public:
  NoiseSample() = default;
  /** Makes a sample of frames of \a width columns. \a values are in the order of SampleTiles::PlaceOf() [DN above the
   * pixel's mean]. */
  NoiseSample(SampleTiles tiles, std::size_t width, Eigen::ArrayXf values)
    : m_Tiles(std::move(tiles))
    , m_Width(width)
    , m_Values(std::move(values))
  {}

  /** Leaves out the first \a frames frames. */
  void
  DropFirst(std::size_t frames);

  /** Leaves out all frames except \a frames, which must be in increasing order. */
  void
  KeepFrames(const std::vector<std::size_t> & frames);

  const SampleTiles &
  GetTiles() const
  {
    return m_Tiles;
  }
  /** Returns the values of tile \a i: frame by frame, row by row in each frame [DN above the pixel's mean]. */
  float *
  OfTile(std::size_t i)
  {
    return m_Values.data() + m_Tiles.PlaceOf(i, 0);
  }
  const float *
  OfTile(std::size_t i) const
  {
    return m_Values.data() + m_Tiles.PlaceOf(i, 0);
  }
  /** Returns the index in the frame of pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p) const
  {
    return m_Tiles.PixelOf(i, p, m_Width);
  }

private:
  SampleTiles    m_Tiles;
  std::size_t    m_Width{ 0 };
  Eigen::ArrayXf m_Values;
};

/** \class FrameSample
 * \brief Complete time series of the sampled pixels, which the third pass gathers to measure the noise correlation.
 *
 * Integers are stored unchanged in 2 bytes. Floating-point numbers are stored above the mean of their pixel in 4
 * bytes; values that are not finite are stored as 0. Frames may be added in any order, and samples merged in any
 * order, with identical results. Memory: at most 16 MiB for integers, 32 MiB for floating-point numbers. */
class SensorNoise_EXPORT FrameSample
{
public:
  FrameSample() = default;

  /** Returns the empty sample of a stack of \a frames frames of TPixel. */
  template <typename TPixel>
  static FrameSample
  Of(const FrameGeometry & geometry, std::size_t frames, const ParallelFor & parallelFor = SerialFor)
  {
    constexpr bool isInteger = std::is_integral_v<TPixel>;
    static_assert(!isInteger || sizeof(TPixel) <= sizeof(std::uint16_t));
    return FrameSample(geometry,
                       frames,
                       isInteger,
                       isInteger ? static_cast<double>(std::numeric_limits<TPixel>::lowest()) : 0.0,
                       parallelFor);
  }

  /** Sets the memory layout of the pixels of the frames that are added. Default: one frame after the other. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
  }

  /** Adds frames firstFrame ... firstFrame + count - 1, whose pixel type is the type of the sample. \a mean is the mean
   * of every pixel [DN]; empty: it is not known yet, and floating-point numbers are stored as they are. */
  template <typename TPixel>
  void
  AddFrames(const TPixel *              frames,
            std::size_t                 firstFrame,
            std::size_t                 count,
            const std::vector<double> & mean,
            const ParallelFor &         parallelFor = SerialFor);

  /** Removes all frames. */
  void
  Clear();

  /** Adds the sample of other frames of the same stack. Throws std::invalid_argument if the stack is not the stack of
   * the sample. */
  void
  Merge(const FrameSample & other);

  /** Writes the sample to a stream, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sample by the sample in a stream. Throws std::runtime_error, and changes nothing, if the stream holds
   * a sample of another stack or ends early. */
  void
  Restore(std::istream & in);

  /** Returns the fraction of the pixels of \a mask that repeat their value in the frame before, beyond the number that
   * noise explains [1]; 0 for floating-point numbers. Differences of noise are log-concave: the expected number of
   * zeros is at most the squared number of differences of one \a stepDn [DN], over the number of differences of two.
   * Estimator.md, 3.12. */
  double
  RepeatedFraction(const std::vector<std::uint8_t> & mask, double stepDn) const;

  /** Returns the fraction of the lines of the tiles that equal the line before them in single frames [1]; 0 for
   * floating-point numbers. A line counts if SampleTiles::SmallSide of its pixels and of their neighbours in the line
   * before are in \a mask. Tiles of a frame in which more than half of the pairs of neighbours are equal show nothing,
   * as quantization hides their noise. Otherwise so many pairs are equal with a probability of at most 2e-5. A line
   * that is a copy in more than half of the frames is a property of the sensor, and does not count. Estimator.md, 3.12.
   */
  double
  CopiedFraction(const std::vector<std::uint8_t> & mask, LineAxis axis) const;

  /** Returns the values above \a mean, the mean of every pixel [DN]. The sample gives up its memory and is empty
   * afterwards. */
  NoiseSample
  TakeNoise(const std::vector<double> & mean, const ParallelFor & parallelFor = SerialFor);

  /** Do the work of TakeNoise() in two steps, so that a tile can be processed while it is in the cache. StartNoise()
   * returns the memory of all values; FillNoise() writes the values of tile \a i to \a noise. */
  NoiseSample
  StartNoise();
  void
  FillNoise(std::size_t i, const std::vector<double> & mean, NoiseSample & noise) const;

private:
  FrameSample(const FrameGeometry & geometry,
              std::size_t           frames,
              bool                  isInteger,
              double                lowest,
              const ParallelFor &   parallelFor);

  SampleTiles m_Tiles;
  std::size_t m_Width{ 0 };
  std::size_t m_FramePixels{ 0 };
  PixelLayout m_Layout;
  double      m_Lowest{ 0.0 }; // value that the stored number 0 means [DN]: frames that are missing are 0 in a
                               // merge
  std::vector<std::uint16_t> m_Integers; // values of integer frames
  Eigen::ArrayXf             m_Values;   // values of floating-point frames
};

} // namespace sensornoise

#endif
