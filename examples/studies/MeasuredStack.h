// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MeasuredStack_h
#define MeasuredStack_h

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Report of a stack, and the PixelUse of each pixel. */
struct MeasuredStack
{
  Report                    report;
  std::vector<std::uint8_t> pixelUse;

  /** Returns the report as JSON. */
  nlohmann::ordered_json
  ReportRecord() const
  {
    return nlohmann::ordered_json::parse(ToJson(report));
  }
};

/** Passes all \a frames frames of a stack, which follow one another in \a greyValues, to a method in each of its
 * passes. Returns the result. */
template <typename TMethod, typename TPixel>
MeasuredStack
MeasureBy(TMethod && method, const std::vector<TPixel> & greyValues, std::size_t frames)
{
  while (!method.IsDone())
  {
    method.AddFrames(greyValues.data(), frames);
    method.EndPass();
  }
  return { method.GetReport(), method.GetPixelUse() };
}

/** Measures a stack with the method "refined" or "published" and its default settings. */
template <typename TPixel>
MeasuredStack
MeasureBy(const std::string &         methodName,
          const std::vector<TPixel> & greyValues,
          const FrameGeometry &       geometry,
          std::size_t                 frames)
{
  return methodName == "refined" ? MeasureBy(RefinedMethod<TPixel>({}, geometry, frames), greyValues, frames)
                                 : MeasureBy(PublishedMethod<TPixel>({}, geometry, frames), greyValues, frames);
}

} // namespace sensornoise::tools

#endif
