// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_SensorFlaws_h
#define sensornoise_simulation_SensorFlaws_h

#include "sensornoise/simulation/BlockQuantisation.h"
#include "sensornoise/simulation/BrighterFatter.h"
#include "sensornoise/simulation/ChargeCoupling.h"
#include "sensornoise/simulation/ColourFilters.h"
#include "sensornoise/simulation/Companding.h"
#include "sensornoise/simulation/DefectCorrection.h"
#include "sensornoise/simulation/FrameBinning.h"
#include "sensornoise/simulation/FrameRepetition.h"
#include "sensornoise/simulation/FrameResampling.h"
#include "sensornoise/simulation/FrameSmoothing.h"
#include "sensornoise/simulation/GainPattern.h"
#include "sensornoise/simulation/LineNoise.h"
#include "sensornoise/simulation/MedianFilter.h"
#include "sensornoise/simulation/ReadNoisePattern.h"
#include "sensornoise/simulation/ResponseCurve.h"
#include "sensornoise/simulation/TemporalFilter.h"

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
