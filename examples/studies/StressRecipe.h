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

/** How to make the stack of one case: the simulator's settings, and what the simulator does not know. */
struct StressRecipe
{
  using RowOfElectrons = std::vector<double>;

  SimulationSettings  settings; ///< camera B, condition 3, 100 frames
  std::size_t         size{ 0 };
  std::vector<double> scene;

  /** Changes the expected electrons of row y of frame t; empty: none. */
  std::function<void(const SimulatedSeries & series, std::size_t t, std::size_t y, RowOfElectrons & electrons)> light;
  /** Level in frame t at a pixel, beside the offset [DN]; empty: none. */
  std::function<double(std::size_t t, std::size_t pixel)> levelDn;
  /** From the converter's code to that of the file, as a real number that is then rounded; empty: as it is. */
  std::function<double(double code)> recode;
  /** Truth of the file's codes in units of the converter's. */
  double scale{ 1.0 };
  bool   isEightBit{ false };
  /** Codes added to the middle sample of the stack. */
  std::uint16_t strayCodes{ 0 };
};

/** A case and how it is made. */
struct StressRecipeEntry
{
  StressCase                          description;
  std::function<void(StressRecipe &)> prepare;
};

/** Light: rolling shutters, lamps, bleaching, things that move; vibration, flicker, length of the burst. */
void
AppendSceneRecipes(std::vector<StressRecipeEntry> & entries);

/** Sensors with flaws, and codes that are not the sensor's own. */
void
AppendSensorRecipes(std::vector<StressRecipeEntry> & entries);

/** Charge that moves between pixels, and cameras that process their codes: the noise is not white any more. */
void
AppendProcessedRecipes(std::vector<StressRecipeEntry> & entries);

} // namespace sensornoise::tools

#endif
