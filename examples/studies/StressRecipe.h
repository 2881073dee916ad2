// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StressRecipe_h
#define StressRecipe_h

#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "studies/StressStacks.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sensornoise::tools
{

/** Recipe for the stack of a case: settings of the simulator, and changes that the simulator does not support. */
struct StressRecipe
{
  using RowOfElectrons = std::vector<double>;

  SimulationSettings  settings; ///< camera B, condition 3, 100 frames
  std::size_t         size{ 0 };
  std::vector<double> scene;

  /** Changes the expected electrons of row y of frame t; empty: no change. */
  std::function<void(const SimulatedSeries & series, std::size_t t, std::size_t y, RowOfElectrons & electrons)>
    illuminate;
  /** Level of a pixel in frame t that is added to the offset [DN]; empty: 0. */
  std::function<double(std::size_t t, std::size_t pixel)> levelDn;
  /** Maps a grey value of the converter to a grey value of the file, before rounding; empty: no change. */
  std::function<double(double greyValue)> remap;
  /** Factor from true values of the converter [DN] to true values of the file [DN]. */
  double scale{ 1.0 };
  bool   isEightBit{ false };
  /** Grey values that are added to the middle sample of the stack [DN]. */
  std::uint16_t strayDn{ 0 };
};

/** Case and the function that makes its recipe. */
struct StressRecipeEntry
{
  StressCase                          description;
  std::function<void(StressRecipe &)> prepare;
};

/** Appends cases of the scene: rolling shutters, light sources, bleaching, moving objects, vibration, flicker and
 * length of the burst. */
void
AppendSceneRecipes(std::vector<StressRecipeEntry> & entries);

/** Appends cases of sensors with flaws, and of grey values that were changed after the converter. */
void
AppendSensorRecipes(std::vector<StressRecipeEntry> & entries);

/** Appends cases of charge that moves between pixels, and of cameras that process their frames. The noise is no
 * longer white. */
void
AppendProcessedRecipes(std::vector<StressRecipeEntry> & entries);

} // namespace sensornoise::tools

#endif
