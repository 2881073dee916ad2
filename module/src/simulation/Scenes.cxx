// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"

#include "base/FreeMemory.h"
#include "base/BytesFingerprint.h"
#include "simulation/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{
namespace
{
void
CheckSceneSize(const char * scene,
               std::size_t  width,
               std::size_t  height,
               std::size_t  leastWidth,
               std::size_t  leastHeight)
{
  if (width < leastWidth || height < leastHeight)
  {
    throw std::invalid_argument(std::string("the ") + scene + " scene was asked for with " + std::to_string(width) +
                                " x " + std::to_string(height) + " pixels; it needs at least " +
                                std::to_string(leastWidth) + " x " + std::to_string(leastHeight));
  }
  RequireMemory(16.0 * static_cast<double>(width) * static_cast<double>(height), // the scene, and a copy of it
                std::string("the ") + scene + " scene of " + std::to_string(width) + " x " + std::to_string(height) +
                  " pixels");
}

/** Returns the levels 0, 1/15, ..., 1 in an order drawn from the seed (Fisher-Yates). */
std::array<double, 16>
ShuffledLevels(std::uint64_t seed)
{
  std::array<double, 16> levels{};
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    levels[i] = static_cast<double>(i) / 15.0;
  }
  CounterSeededRandom random(seed);
  for (std::size_t i = levels.size() - 1; i > 0; --i)
  {
    std::swap(levels[i], levels[static_cast<std::size_t>(random.Uniform() * static_cast<double>(i + 1))]);
  }
  return levels;
}

/** Returns value noise with a 1/f spectrum, in [-1, 1]. It has octaves of wavelength 2, 4, ..., 32 pixels and of equal
 * amplitude. (In two dimensions equal power per octave is an amplitude spectrum of 1/f.) Different keys have
 * independent noise. */
double
FractalNoise(std::uint64_t key, std::size_t x, std::size_t y)
{
  constexpr int octaves = 5;
  const auto    lattice = [](std::uint64_t octaveKey, std::uint64_t column, std::uint64_t row) {
    return static_cast<double>(MixBits(octaveKey + (column << 32) + row) >> 11) * 0x1p-52 - 1.0;
  };
  double sum = 0.0;
  for (int octave = 1; octave <= octaves; ++octave)
  {
    const std::uint64_t octaveKey = MixBits(key + static_cast<std::uint64_t>(octave));
    const std::size_t   mask = (std::size_t{ 1 } << octave) - 1;
    const std::size_t   column = x >> octave;
    const std::size_t   row = y >> octave;
    const double        fx = static_cast<double>(x & mask) / static_cast<double>(mask + 1);
    const double        fy = static_cast<double>(y & mask) / static_cast<double>(mask + 1);
    const double        above = (1.0 - fx) * lattice(octaveKey, column, row) + fx * lattice(octaveKey, column + 1, row);
    const double        below =
      (1.0 - fx) * lattice(octaveKey, column, row + 1) + fx * lattice(octaveKey, column + 1, row + 1);
    sum += (1.0 - fy) * above + fy * below;
  }
  return sum / octaves;
}
} // namespace

std::vector<double>
ScaleToRange(std::vector<double> image, double low, double high)
{
  if (image.empty())
  {
    return image;
  }
  const auto   extremes = std::minmax_element(image.begin(), image.end());
  const double least = *extremes.first;
  const double range = *extremes.second - least;
  for (double & value : image)
  {
    value = range > 0.0 ? low + (value - least) / range * (high - low) : high;
  }
  return image;
}

std::vector<double>
GaussianBlur(const std::vector<double> & image,
             std::size_t                 width,
             std::size_t                 height,
             double                      sdPixels,
             const ParallelFor &         parallelFor)
{
  const auto          radius = static_cast<std::ptrdiff_t>(std::lround(4.0 * sdPixels));
  std::vector<double> kernel;
  double              sum = 0.0;
  for (std::ptrdiff_t k = -radius; k <= radius; ++k)
  {
    const double distance = static_cast<double>(k);
    kernel.push_back(radius > 0 ? std::exp(-0.5 * distance * distance / (sdPixels * sdPixels)) : 1.0);
    sum += kernel.back();
  }
  const auto blurAlong = [&](bool isVertical, const std::vector<double> & in) {
    std::vector<double> out(in.size());
    const auto          last = static_cast<std::ptrdiff_t>(isVertical ? height : width) - 1;
    parallelFor(height, [&](std::size_t y) {
      for (std::size_t x = 0; x < width; ++x)
      {
        const auto position = static_cast<std::ptrdiff_t>(isVertical ? y : x);
        double     value = 0.0;
        for (std::ptrdiff_t k = -radius; k <= radius; ++k)
        {
          const auto neighbour = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(position + k, 0, last));
          const auto pixel = isVertical ? neighbour * width + x : y * width + neighbour;
          value += kernel[static_cast<std::size_t>(k + radius)] * in[pixel];
        }
        out[y * width + x] = value / sum;
      }
    });
    return out;
  };
  return blurAlong(false, blurAlong(true, image));
}

std::vector<double>
MakeTargetScene(std::size_t width, std::size_t height, std::uint64_t seed)
{
  CheckSceneSize("target", width, height, 32, 32);
  constexpr double    surround = 0.12;
  const auto          levels = ShuffledLevels(seed);
  const auto          marginOf = [](std::size_t cell) { return std::max<std::size_t>(2, cell * 7 / 100); };
  const std::size_t   cellWidth = width / 4;
  const std::size_t   cellHeight = height / 4;
  const std::size_t   marginX = marginOf(cellWidth);
  const std::size_t   marginY = marginOf(cellHeight);
  std::vector<double> image(width * height, surround);
  for (std::size_t patch = 0; patch < levels.size(); ++patch)
  {
    const std::size_t top = patch / 4 * cellHeight;
    const std::size_t left = patch % 4 * cellWidth;
    for (std::size_t y = top + marginY; y < top + cellHeight - marginY; ++y)
    {
      for (std::size_t x = left + marginX; x < left + cellWidth - marginX; ++x)
      {
        image[y * width + x] = levels[patch];
      }
    }
  }
  return image;
}

std::vector<double>
MakeBarsScene(std::size_t width, std::size_t height)
{
  CheckSceneSize("bars", width, height, 16, 1);
  const auto          levels = ShuffledLevels(DefaultSceneSeed);
  std::vector<double> image(width * height);
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    image[i] = levels[i % width * levels.size() / width];
  }
  return image;
}

std::vector<double>
MakeTextureScene(std::size_t width, std::size_t height, std::uint64_t seed)
{
  CheckSceneSize("texture", width, height, 16, 16);
  constexpr double    leastRadius = 4.0;
  const double        greatestRadius = static_cast<double>(std::max<std::size_t>(32, std::min(width, height))) / 4.0;
  const double        leastPower = 1.0 / (leastRadius * leastRadius);
  const double        greatestPower = 1.0 / (greatestRadius * greatestRadius);
  std::vector<double> image(width * height);
  std::vector<char>   isCovered(image.size(), 0);
  CounterSeededRandom random(seed);
  // From the front leaf to the back: a pixel keeps the first leaf that covers it, until no pixel is uncovered.
  for (std::size_t bare = image.size(); bare > 0;)
  {
    const double radius = 1.0 / std::sqrt(leastPower - random.Uniform() * (leastPower - greatestPower));
    const double centreX = random.Uniform() * (static_cast<double>(width) + 2.0 * radius) - radius;
    const double centreY = random.Uniform() * (static_cast<double>(height) + 2.0 * radius) - radius;
    const double grey = random.Uniform();
    const double contrast = 0.03 + 0.12 * random.Uniform();
    const auto   key = random.Bits();
    const auto   first = [&](double centre) {
      return static_cast<std::size_t>(std::max(0.0, std::ceil(centre - radius)));
    };
    const auto end = [&](double centre, std::size_t size) {
      return static_cast<std::size_t>(std::clamp(std::floor(centre + radius) + 1.0, 0.0, static_cast<double>(size)));
    };
    for (std::size_t y = first(centreY); y < end(centreY, height); ++y)
    {
      for (std::size_t x = first(centreX); x < end(centreX, width); ++x)
      {
        const std::size_t i = y * width + x;
        const double      dx = static_cast<double>(x) - centreX;
        const double      dy = static_cast<double>(y) - centreY;
        if (isCovered[i] == 0 && dx * dx + dy * dy <= radius * radius)
        {
          isCovered[i] = 1;
          image[i] = grey + contrast * FractalNoise(key, x, y);
          --bare;
        }
      }
    }
  }
  return ScaleToRange(std::move(image), 0.0, 1.0);
}

std::vector<double>
MakeFlatScene(std::size_t width, std::size_t height)
{
  CheckSceneSize("flat", width, height, 1, 1);
  return std::vector<double>(width * height, 1.0);
}

} // namespace sensornoise
