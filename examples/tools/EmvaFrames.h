// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EmvaFrames_h
#define EmvaFrames_h

#include "sensornoise/Emva1288.h"
#include "itkSensorNoiseFrameFiles.h"

#include <variant>

namespace sensornoise::tools
{

struct EmvaSourceList;
struct EstimateOptions;

/** Evaluation of a monochrome camera, or of the planes of a mosaic. */
using EmvaEvaluation = std::variant<EmvaReport, EmvaMosaicReport>;

/** Evaluation, and the files of its frames. */
struct EmvaMeasured
{
  EmvaEvaluation evaluation;
  /** Files of flat fields, or of flat fields and dark frames, each once: in the order of a list, or of the exposures
   * that the files record. */
  FrameList frames;
  FrameList dark; ///< files that hold dark frames only, in the same order
};

/** Reads the frames of all exposures, and evaluates them: the part that --roi selects, and each plane of a mosaic by
 * itself. A mosaic is what --bayer or the files say. Throws std::exception if frames cannot be read, differ, or do
 * not have the size that the list says. */
EmvaMeasured
EvaluateFrames(const EstimateOptions & options, const EmvaSourceList & all);

} // namespace sensornoise::tools

#endif
