// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/SensorFlaws.h"
#include "studies/StressRecipe.h"

#include <vector>

namespace sensornoise::tools
{
namespace
{
template <typename TChange>
StressRecipeEntry
MakeProcessedEntry(const char * name, const char * what, TChange change)
{
  return { { name, what, StressExpectation::Processed },
           [change](StressRecipe & recipe) { change(recipe.settings.flaws); } };
}
} // namespace

void
AppendProcessedRecipes(std::vector<StressRecipeEntry> & entries)
{
  entries.push_back(MakeProcessedEntry("coupling",
                                       "a pixel gives 1.2 % of its charge to each of its four neighbours",
                                       [](SensorFlaws & flaws) { flaws.coupling.fraction = 0.012; }));
  entries.push_back(MakeProcessedEntry("brighter_fatter",
                                       "charge spreads in proportion to its square: 5 % of the variance at the top",
                                       [](SensorFlaws & flaws) { flaws.brighterFatter.perElectron = 2e-6; }));
  entries.push_back(MakeProcessedEntry("smoothed",
                                       "the camera smooths its frames, Gaussian of 0.6 pixels",
                                       [](SensorFlaws & flaws) { flaws.smoothing.sdPixels = 0.6; }));
  entries.push_back(MakeProcessedEntry("resampled",
                                       "the camera moves its frames by half a pixel in x and y",
                                       [](SensorFlaws & flaws) { flaws.resampling = { 0.5, 0.5 }; }));
  entries.push_back(MakeProcessedEntry("temporal_filter",
                                       "the camera blends each frame with half of the last one",
                                       [](SensorFlaws & flaws) { flaws.temporalFilter.weight = 0.5; }));
  entries.push_back(MakeProcessedEntry(
    "repeated", "every frame is written twice", [](SensorFlaws & flaws) { flaws.repetition.count = 2; }));
  entries.push_back(MakeProcessedEntry("defects_corrected",
                                       "pixels 1.5 sd of their neighbours off become the neighbours' median",
                                       [](SensorFlaws & flaws) { flaws.defectCorrection.thresholdSd = 1.5; }));
  entries.push_back(MakeProcessedEntry(
    "companded", "square-root companding to 8 bits and back", [](SensorFlaws & flaws) { flaws.companding.bits = 8; }));
}

} // namespace sensornoise::tools
