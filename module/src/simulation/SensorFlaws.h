// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_SensorFlaws_h
#define sensornoise_simulation_SensorFlaws_h

#include "simulation/BlockQuantisation.h"
#include "simulation/BrighterFatter.h"
#include "simulation/ChargeCoupling.h"
#include "simulation/ColourFilters.h"
#include "simulation/Companding.h"
#include "simulation/DefectCorrection.h"
#include "simulation/FrameBinning.h"
#include "simulation/FrameRepetition.h"
#include "simulation/FrameResampling.h"
#include "simulation/FrameSmoothing.h"
#include "simulation/GainPattern.h"
#include "simulation/LineNoise.h"
#include "simulation/MedianFilter.h"
#include "simulation/ReadNoisePattern.h"
#include "simulation/ResponseCurve.h"
#include "simulation/TemporalFilter.h"

namespace sensornoise
{

/** What a real sensor does beside the model, and what its camera does to the codes, in the order in which it happens:
 * light, charge, analogue signal, code, processing. Each piece has a file of its own; all are off by default, and any
 * may be combined. The pieces of the processing work on real numbers; rounding and clipping to codes come last. */
struct SensorFlaws
{
  ColourFilterSettings     filters{};
  PatternSettings          pattern{};
  BrighterFatterSettings   brighterFatter{};
  CouplingSettings         coupling{};
  ReadNoiseSettings        readNoise{};
  ResponseSettings         response{};
  LineNoiseSettings        lineNoise{};
  DefectCorrectionSettings defectCorrection{};
  TemporalFilterSettings   temporalFilter{};
  MedianSettings           median{};
  SmoothingSettings        smoothing{};
  BinningSettings          binning{};
  ResamplingSettings       resampling{};
  BlockSettings            blocks{};
  CompandingSettings       companding{};
  RepetitionSettings       repetition{};
};

} // namespace sensornoise

#endif
