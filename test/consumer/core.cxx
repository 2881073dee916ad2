// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

// A program that measures frames and writes the record, and no page: run.sh looks for the page's code in it.

int
main()
{
  constexpr std::size_t                      frames = 5;
  const sensornoise::FrameGeometry           geometry{ 16, 16, 1 };
  const std::vector<unsigned short>          pixels(frames * geometry.Pixels(), 100);
  sensornoise::RefinedMethod<unsigned short> method(sensornoise::RefinedSettings{}, geometry, frames);
  while (!method.IsDone())
  {
    method.AddFrames(pixels.data(), frames);
    method.EndPass();
  }
  const std::string record = sensornoise::ToJson(method.GetReport());
  std::cout << "a record of " << record.size() << " bytes\n";
  return record.empty() ? EXIT_FAILURE : EXIT_SUCCESS;
}
