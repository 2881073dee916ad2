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
#ifndef sensornoise_refined_RefinedFindings_h
#define sensornoise_refined_RefinedFindings_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/moments/StackMaps.h"
#include "sensornoise/pixels/LocalFlicker.h"
#include "sensornoise/pixels/LocalOffset.h"
#include "sensornoise/pixels/StaticPixels.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/refined/RefinedSettings.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/series/LocalIllumination.h"
#include "sensornoise/series/MotionSeries.h"
#include "sensornoise/series/OffsetLine.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** All that the refined method found out, from which its report is made. */
struct RefinedFindings
{
  ProvisionalModel                model;
  OffsetLine                      line;   ///< offset and flicker from all frames
  MotionSeries                    motion; ///< by least squares
  LocalIllumination               local;  ///< light that is not the same everywhere
  bool                            isOffsetDrift{ false };
  std::optional<LocalOffset>      localOffset;
  std::optional<InstrumentShifts> shifts;
  VarianceLine                    variance; ///< corrected for the noise of the means
  VarianceLine                    fromFlat; ///< of the smoother half of the pixels, not corrected
  Eigen::Matrix2d                 tailDisagreement{ Eigen::Matrix2d::Zero() }; ///< see VarianceFit
  ClassFit                        classes;
  double                          intensityChi2{ 1.0 }; ///< of the mean residuals of 64 intensity bins
  double                          motionPhi{ 1.0 };     ///< dispersion of the frames over all gradient classes
  LocalFlicker                    localFlicker;
  double                          centreDn{ 0.0 };
  double                          offsetInUse{ 0.0 }; ///< minus the centre: of the first line, or the darkest level
  std::string                     failureCode;        ///< why the stack cannot be measured; empty: it can
  std::string                     failure;
  double                          usable{ 0.0 }; ///< pixels that are free of clipping, its guard band and coarse codes
  std::size_t                     nearClip{ 0 };
  std::size_t                     notStatic{ 0 };
  std::size_t                     coarse{ 0 };

  void
  Fail(std::string code, std::string message)
  {
    failureCode = std::move(code);
    failure = std::move(message);
  }
};

/** What the refined method's report is made of. */
struct RefinedReportInput
{
  const RefinedSettings &           settings;
  const FrameGeometry &             geometry;
  std::size_t                       frames;
  const StackSummary &              summary;
  const std::vector<double> &       mean;
  const std::vector<double> &       variance;
  const std::vector<double> &       correctedVariance;
  const std::vector<std::uint8_t> & valid;
  const std::vector<std::uint8_t> & pixelUse;
  const RefinedFindings &           found;
};

} // namespace sensornoise

#endif
