// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/StressStacks.h"

#include "simulation/Random.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "studies/StressRecipe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
constexpr std::uint64_t PixelStream = 100;

const std::vector<StressRecipeEntry> &
GetEntries()
{
  static const std::vector<StressRecipeEntry> entries = [] {
    std::vector<StressRecipeEntry> all;
    AppendSceneRecipes(all);
    AppendSensorRecipes(all);
    AppendProcessedRecipes(all);
    return all;
  }();
  return entries;
}

/** Renders a row as StackSimulator::RenderRow() does for a sensor without flaws, with the signal and the level of
 * the recipe. */
void
ComposeRow(const StackSimulator & simulator,
           const StressRecipe &   recipe,
           std::size_t            t,
           std::size_t            y,
           std::uint16_t *        out)
{
  const auto          range = StackSimulator::PixelRangeDn<std::uint16_t>(recipe.settings);
  const CameraModel & camera = recipe.settings.camera;
  CounterSeededRandom random(recipe.settings.seed, PixelStream, t, y);
  std::vector<double> electrons(recipe.size);
  simulator.ExpectedElectronsRow(t, y, electrons.data());
  if (recipe.illuminate)
  {
    recipe.illuminate(simulator.GetTruth().series, t, y, electrons);
  }
  for (std::size_t x = 0; x < recipe.size; ++x)
  {
    const double level = camera.offsetDn + (recipe.levelDn ? recipe.levelDn(t, y * recipe.size + x) : 0.0);
    const double signal = camera.gainDnPerElectron * static_cast<double>(random.Poisson(electrons[x]));
    const double value = signal + level + camera.readNoiseDn * random.Normal();
    out[x] = static_cast<std::uint16_t>(std::clamp(std::floor(value + 0.5), range.first, range.second));
  }
}

const StressRecipeEntry &
FindEntry(const std::string & name)
{
  const auto & entries = GetEntries();
  const auto   entry =
    std::find_if(entries.begin(), entries.end(), [&](const auto & other) { return other.description.name == name; });
  if (entry == entries.end())
  {
    throw std::invalid_argument("the case \"" + name + "\" is not known");
  }
  return *entry;
}

/** Returns the variance of row noise, column noise and banding [DN^2]. */
double
LineVarianceDn2(const LineNoiseSettings & lineNoise)
{
  return std::pow(lineNoise.rowNoiseSdDn, 2) + std::pow(lineNoise.columnNoiseSdDn, 2) +
         0.5 * std::pow(lineNoise.bandingAmplitudeDn, 2);
}

/** Returns the true values of each pixel. They are empty if gains, read noise and response are alike in all pixels,
 * apart from hot pixels and offsets. The estimate is then compared with the values of the camera. */
std::vector<StressTruth>
DescribePixels(const StackSimulator & simulator, const StressRecipe & recipe)
{
  const SensorFlaws & flaws = recipe.settings.flaws;
  const bool          areAlike = flaws.pattern.gainSd == 0.0 && flaws.pattern.columnGainSd == 0.0 &&
                        flaws.readNoise.spread == 0.0 && flaws.readNoise.tailFraction == 0.0 &&
                        flaws.response.shape == ResponseShape::Straight;
  std::vector<StressTruth> truths(areAlike ? 0 : recipe.size * recipe.size);
  for (std::size_t pixel = 0; pixel < truths.size(); ++pixel)
  {
    const double gain = simulator.LocalGainAt(pixel);
    const double offset = simulator.PixelOffsetDn(pixel);
    const double variance = std::pow(simulator.PixelReadNoiseDn(pixel), 2);
    const double scale = recipe.scale;
    truths[pixel] = { scale * gain, scale * offset, scale * scale * (variance - gain * offset) };
  }
  return truths;
}

/** Returns the grey values of the file, frame after frame [DN]. */
std::vector<std::uint16_t>
RenderGreyValues(const StackSimulator & simulator, const StressRecipe & recipe)
{
  const std::size_t          size = recipe.size;
  const std::size_t          frames = recipe.settings.frames;
  std::vector<std::uint16_t> greyValues(size * size * frames);
  for (std::size_t t = 0; t < frames; ++t)
  {
    std::uint16_t * const out = greyValues.data() + t * size * size;
    if (recipe.illuminate || recipe.levelDn)
    {
      SerialFor(size, [&](std::size_t y) { ComposeRow(simulator, recipe, t, y, out + y * size); });
    }
    else
    {
      simulator.RenderFrame(t, out);
    }
    if (recipe.remap)
    {
      std::transform(out, out + size * size, out, [&](double greyValue) {
        return static_cast<std::uint16_t>(std::lround(recipe.remap(greyValue)));
      });
    }
  }
  std::uint16_t & middle = greyValues[(frames / 2 * size + size / 2) * size + size / 2];
  middle = static_cast<std::uint16_t>(middle + recipe.strayDn);
  return greyValues;
}
} // namespace

double
StressTruth::InterceptNear(double found, double lineVarianceDn2) const
{
  return std::clamp(found, intercept, intercept + lineVarianceDn2);
}

StressTruth
StressStack::TruthOver(const std::vector<std::uint8_t> & isUsed) const
{
  StressTruth sum;
  double      count = 0.0;
  const bool  isAnyUsed = std::find(isUsed.begin(), isUsed.end(), 1) != isUsed.end();
  for (std::size_t pixel = 0; pixel < ofPixel.size(); ++pixel)
  {
    if (!isAnyUsed || isUsed[pixel] != 0)
    {
      sum.gain += ofPixel[pixel].gain;
      sum.offset += ofPixel[pixel].offset;
      sum.intercept += ofPixel[pixel].intercept;
      count += 1.0;
    }
  }
  return ofPixel.empty() ? StressTruth{ gain, offset, readNoise * readNoise - gain * offset }
                         : StressTruth{ sum.gain / count, sum.offset / count, sum.intercept / count };
}

std::vector<StressCase>
GetStressCases()
{
  std::vector<StressCase> cases;
  for (const StressRecipeEntry & entry : GetEntries())
  {
    cases.push_back(entry.description);
  }
  return cases;
}

StressStack
MakeStressStack(const std::string & name, const std::string & reference, std::size_t size, std::uint64_t seed)
{
  const StressRecipeEntry & entry = FindEntry(name);
  if (reference != "target" && reference != "texture")
  {
    throw std::invalid_argument("the reference is \"" + reference + "\"; expected target or texture");
  }
  StressRecipe recipe;
  recipe.size = size;
  recipe.settings.seed = seed;
  recipe.scene = reference == "target" ? MakeTargetScene(size, size) : MakeTextureScene(size, size);
  entry.prepare(recipe);

  const StackSimulator simulator(recipe.scene, size, size, recipe.settings);
  const CameraModel &  camera = recipe.settings.camera;
  StressStack          stack;
  stack.width = size;
  stack.height = size;
  stack.frames = recipe.settings.frames;
  stack.isEightBit = recipe.isEightBit;
  stack.gain = camera.gainDnPerElectron * recipe.scale;
  stack.offset = camera.offsetDn * recipe.scale;
  stack.readNoise = camera.readNoiseDn * recipe.scale;
  stack.lineVarianceDn2 = LineVarianceDn2(recipe.settings.flaws.lineNoise) * recipe.scale * recipe.scale;
  stack.ofPixel = DescribePixels(simulator, recipe);
  stack.greyValues = RenderGreyValues(simulator, recipe);
  return stack;
}

} // namespace sensornoise::tools
