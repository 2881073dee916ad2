// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"

#include "moments/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

namespace
{
constexpr std::size_t BlockSize = 32; // width and height of a block [pixel]

/** Returns a Hann window: weights that fall to 0 at both ends, so that patterns of the scene have no effect at the
 * borders of a block. */
std::vector<double>
MakeWindow(std::size_t size)
{
  std::vector<double> window(size);
  for (std::size_t k = 0; k < size; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * (static_cast<double>(k) + 0.5) / static_cast<double>(size);
    window[k] = 0.5 - 0.5 * std::cos(angle);
  }
  return window;
}

/** Weighted means over the pixels of a block that have a finite neighbourhood. */
struct BlockLevels
{
  double rough{ 0.0 };       ///< absolute difference of a pixel to the mean of its four neighbours [DN]
  double main{ 0.0 };        ///< upper left minus lower right pixel of the 2 x 2 [DN]
  double anti{ 0.0 };        ///< upper right minus lower left pixel [DN]
  double ofDiagonals{ 0.0 }; ///< main diagonal minus the other diagonal [DN]
  bool   isKnown{ false };
};

/** Returns the levels of the block whose first pixel is \a first, at (left, top), of rows \a width pixels apart. */
BlockLevels
LevelsOfBlock(const double *              first,
              std::size_t                 width,
              std::size_t                 left,
              std::size_t                 top,
              const std::vector<double> & window)
{
  const std::size_t size = window.size();
  // by phase, 2 * (y % 2) + x % 2: difference to the mean of the four diagonal neighbours, and of the four adjacent
  // neighbours
  std::array<double, 4> aslant{};
  std::array<double, 4> beside{};
  std::array<double, 4> weight{};
  double                rough = 0.0;
  for (std::size_t y = top; y < top + size; ++y)
  {
    for (std::size_t x = left; x < left + size; ++x)
    {
      const double *    pixel = first + (y - top) * width + (x - left);
      const auto        row = static_cast<std::ptrdiff_t>(width);
      const double      diagonal = 0.25 * (pixel[-row - 1] + pixel[-row + 1] + pixel[row - 1] + pixel[row + 1]);
      const double      cross = 0.25 * (pixel[-row] + pixel[row] + pixel[-1] + pixel[1]);
      const std::size_t phase = 2 * (y % 2) + x % 2;
      if (std::isfinite(*pixel + diagonal + cross))
      {
        const double taper = window[x - left] * window[y - top];
        aslant.at(phase) += taper * (*pixel - diagonal);
        beside.at(phase) += taper * (*pixel - cross);
        rough += taper * std::abs(*pixel - cross);
        weight.at(phase) += taper;
      }
    }
  }
  BlockLevels  block;
  const double all = weight[0] + weight[1] + weight[2] + weight[3];
  block.isKnown = *std::min_element(weight.begin(), weight.end()) > 0.0;
  if (block.isKnown)
  {
    const auto mean = [&weight](const std::array<double, 4> & sums, std::size_t phase) {
      return sums.at(phase) / weight.at(phase);
    };
    block.rough = rough / all;
    block.main = 0.5 * (mean(aslant, 0) - mean(aslant, 3));
    block.anti = 0.5 * (mean(aslant, 1) - mean(aslant, 2));
    block.ofDiagonals = 0.25 * (mean(beside, 0) + mean(beside, 3) - mean(beside, 1) - mean(beside, 2));
  }
  return block;
}

/** Returns the levels of all blocks that lie in the frame with their neighbours. A frame that is too small for a block
 * has a single smaller block. */
template <typename TPixel>
std::vector<BlockLevels>
LevelsOfBlocks(const TPixel * frame, std::size_t width, std::size_t height, const ParallelFor & parallelFor)
{
  std::vector<BlockLevels> blocks;
  const std::size_t        side = std::min(width, height);
  if (side < 4)
  {
    return blocks;
  }
  const std::size_t size = std::min(BlockSize, (side - 2) / 2 * 2);
  const std::size_t columns = (width - 2) / size;
  const std::size_t rows = (height - 2) / size;
  blocks.resize(columns * rows);
  const std::vector<double> window = MakeWindow(size);
  parallelFor(rows, [&](std::size_t row) {
    const std::size_t   top = row * size;           // first row of the neighbours of the block
    std::vector<double> levels((size + 2) * width); // a copy of the whole frame would take longer than the comparison
    std::copy(frame + top * width, frame + top * width + levels.size(), levels.begin());
    for (std::size_t column = 0; column < columns; ++column)
    {
      const std::size_t left = 1 + column * size;
      blocks[row * columns + column] = LevelsOfBlock(levels.data() + width + left, width, left, top + 1, window);
    }
  });
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(), [](const BlockLevels & block) { return !block.isKnown; }),
               blocks.end());
  return blocks;
}

} // namespace

template <typename TPixel>
std::optional<BayerPattern>
RecogniseMosaic(const TPixel * frameDn, std::size_t width, std::size_t height, const ParallelFor & parallelFor)
{
  const std::vector<BlockLevels> blocks = LevelsOfBlocks(frameDn, width, height, parallelFor);
  if (blocks.empty())
  {
    return std::nullopt;
  }
  double main = 0.0;
  double anti = 0.0;
  for (const BlockLevels & block : blocks)
  {
    main += std::abs(block.main);
    anti += std::abs(block.anti);
  }
  const bool isGreenMain = main < anti;
  double     contrast = 0.0; // difference of green to the mean of the other colours
  double     rough = 0.0;
  double     sumOfOne = 0.0; // difference of green to the colour beside the pixel of the main diagonal, and to the
                             // other colour
  double sumOfOther = 0.0;
  double oneLessOther = 0.0;
  for (const BlockLevels & block : blocks)
  {
    const double green = isGreenMain ? block.ofDiagonals : -block.ofDiagonals;
    const double colours = isGreenMain ? block.anti : block.main; // one colour minus the other
    contrast += std::abs(green);
    rough += block.rough;
    sumOfOne += std::abs(green - 0.5 * colours);
    sumOfOther += std::abs(green + 0.5 * colours);
    oneLessOther += colours;
  }
  // The greens differ by noise only: another colour must differ by more than that.
  const double greens = std::min(main, anti);
  const double least = std::max(InMoments.leastColourDifference * contrast, InMoments.leastColourOverNoise * greens);
  const bool   isMosaic = contrast > 0.0 && contrast >= InMoments.leastMosaicContrast * rough &&
                        greens <= InMoments.largestGreenDifference * contrast &&
                        std::min({ std::max(main, anti), sumOfOne, sumOfOther }) >= least;
  if (!isMosaic)
  {
    return std::nullopt;
  }
  // The first colour is the upper right pixel where green is on the main diagonal, else the upper left.
  if (isGreenMain)
  {
    return oneLessOther > 0.0 ? BayerPattern::GRBG : BayerPattern::GBRG;
  }
  return oneLessOther > 0.0 ? BayerPattern::RGGB : BayerPattern::BGGR;
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template std::optional<BayerPattern> RecogniseMosaic(const TPixel *, std::size_t, std::size_t, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
