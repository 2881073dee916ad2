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
#include "studies/StressStacks.h"

#include "sensornoise/simulation/Random.h"
#include "sensornoise/simulation/Scenes.h"
#include "sensornoise/simulation/SimulationSettings.h"
#include "sensornoise/simulation/Simulator.h"
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
    return all;
  }();
  return entries;
}

/** As StackSimulator::RenderRow, with the recipe's light and level. */
void
ComposeRow(const StackSimulator & simulator,
           const StressRecipe &   recipe,
           std::size_t            t,
           std::size_t            y,
           std::uint16_t *        out)
{
  const auto          range = StackSimulator::CodeRange<std::uint16_t>(recipe.settings);
  const CameraModel & camera = recipe.settings.camera;
  CounterSeededRandom random(recipe.settings.seed, PixelStream, t, y);
  std::vector<double> electrons(recipe.size);
  simulator.ExpectedElectronsRow(t, y, electrons.data());
  if (recipe.light)
  {
    recipe.light(simulator.GetTruth().series, t, y, electrons);
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

/** The codes of the file, frame after frame. */
std::vector<std::uint16_t>
RenderCodes(const StressRecipe & recipe)
{
  const std::size_t          size = recipe.size;
  const std::size_t          frames = recipe.settings.frames;
  const StackSimulator       simulator(recipe.scene, size, size, recipe.settings);
  std::vector<std::uint16_t> codes(size * size * frames);
  for (std::size_t row = 0; row < size * frames; ++row)
  {
    std::uint16_t * const out = codes.data() + row * size;
    if (recipe.light || recipe.levelDn)
    {
      ComposeRow(simulator, recipe, row / size, row % size, out);
    }
    else
    {
      simulator.RenderRow(row / size, row % size, out);
    }
    if (recipe.recode)
    {
      std::transform(out, out + size, out, [&](double code) {
        return static_cast<std::uint16_t>(std::lround(recipe.recode(code)));
      });
    }
  }
  std::uint16_t & middle = codes[(frames / 2 * size + size / 2) * size + size / 2];
  middle = static_cast<std::uint16_t>(middle + recipe.strayCodes);
  return codes;
}
} // namespace

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

  const CameraModel & camera = recipe.settings.camera;
  StressStack         stack;
  stack.width = size;
  stack.height = size;
  stack.frames = recipe.settings.frames;
  stack.isEightBit = recipe.isEightBit;
  stack.gain = camera.gainDnPerElectron * recipe.scale;
  stack.offset = camera.offsetDn * recipe.scale;
  stack.readNoise = camera.readNoiseDn * recipe.scale;
  stack.codes = RenderCodes(recipe);
  return stack;
}

} // namespace sensornoise::tools
