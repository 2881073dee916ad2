// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/InfluenceConstants.h"

#include "sensornoise/correlation/Constants.h"
#include "sensornoise/moments/Constants.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/refined/Constants.h"
#include "sensornoise/series/Constants.h"

namespace sensornoise::tools
{

const std::vector<VariedConstant> &
GetVariedConstants()
{
  static const std::vector<VariedConstant> constants{
    { "InMoments.defectiveNoiseFactor", &InMoments.defectiveNoiseFactor, "1", "noise of a defective pixel" },
    { "InSeries.leastSignalShare", &InSeries.leastSignalShare, "1", "signal of a derivative that tells motion" },
    { "InSeries.edgeOfNoise", &InSeries.edgeOfNoise, "1", "edge of the noise, above which cells show light" },
    { "InPixels.farZ", &InPixels.farZ, "sd", "variance of a pixel that is far off" },
    { "InPixels.misfitZ", &InPixels.misfitZ, "sd", "excess of a neighbourhood that does not fit" },
    { "InPixels.classZ", &InPixels.classZ, "sd", "excess of a class of roughness that does not fit" },
    { "InCorrelation.nearestZ", &InCorrelation.nearestZ, "sd", "what neighbours share that is no chance" },
    { "InCorrelation.unseenErrors", &InCorrelation.unseenErrors, "1", "error by neighbours that are not summed" },
    { "InRefined.leastSharedSquares",
      &InRefined.leastSharedSquares,
      "1",
      "shared noise from which pixels are judged once more" },
    { "InRefined.hausmanZ", &InRefined.hausmanZ, "sd", "difference of two fits that is no chance" },
    { "InRefined.errorOfNonlinearity", &InRefined.errorOfNonlinearity, "1", "error by a bend, over its size" },
    { "InRefined.largestNonlinearity", &InRefined.largestNonlinearity, "1", "bend that is refused" },
  };
  return constants;
}

} // namespace sensornoise::tools
