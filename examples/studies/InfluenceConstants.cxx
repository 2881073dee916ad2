// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/InfluenceConstants.h"

#include "base/Significance.h"
#include "correlation/Constants.h"
#include "moments/Constants.h"
#include "pixels/Constants.h"
#include "refined/Constants.h"
#include "series/Constants.h"

namespace sensornoise::tools
{

const std::vector<VariedConstant> &
GetVariedConstants()
{
  static const std::vector<VariedConstant> constants{
    { "Significance.hint", &Significance.hint, "sd", "what widens an error" },
    { "Significance.oneTest", &Significance.oneTest, "sd", "what is tested once" },
    { "Significance.severalTests", &Significance.severalTests, "sd", "what is tested of lags, series and bins" },
    { "Significance.manyTests", &Significance.manyTests, "sd", "what is tested at many places" },
    { "Significance.everyPixel", &Significance.everyPixel, "sd", "what is tested of every pixel or frame" },
    { "InMoments.defectiveNoiseFactor", &InMoments.defectiveNoiseFactor, "1", "noise of a defective pixel" },
    { "InSeries.leastSignalShare", &InSeries.leastSignalShare, "1", "signal of a derivative that tells motion" },
    { "InSeries.edgeOfNoise", &InSeries.edgeOfNoise, "1", "edge of the noise, above which cells show light" },
    { "InCorrelation.unseenErrors", &InCorrelation.unseenErrors, "1", "error by neighbours that are not summed" },
    { "InRefined.leastSharedSquares",
      &InRefined.leastSharedSquares,
      "1",
      "shared noise from which pixels are judged once more" },
    { "InRefined.errorOfNonlinearity", &InRefined.errorOfNonlinearity, "1", "error by a bend, over its size" },
    { "InRefined.largestNonlinearity", &InRefined.largestNonlinearity, "1", "bend that is refused" },
  };
  return constants;
}

} // namespace sensornoise::tools
