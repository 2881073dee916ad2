// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSensorNoiseEstimator.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/FrameFile.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "sensornoise/Version.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"

#include "itkImage.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>

// A program of another project: the core and a filter of the installed library measure the same simulated stack, and an
// error that is thrown inside of the library is caught by its type. Run by run.sh.

namespace
{
using StackImage = itk::Image<unsigned short, 3>;
constexpr std::size_t Width = 96;
constexpr std::size_t Height = 80;
constexpr std::size_t Frames = 30;

StackImage::Pointer
Simulate(const sensornoise::SimulationSettings & settings)
{
  const sensornoise::StackSimulator simulator(sensornoise::MakeTargetScene(Width, Height), Width, Height, settings);
  const auto                        stack = StackImage::New();
  stack->SetRegions(StackImage::SizeType{ { Width, Height, Frames } });
  stack->Allocate();
  for (std::size_t row = 0; row < Frames * Height; ++row)
  {
    simulator.RenderRow(row / Height, row % Height, stack->GetBufferPointer() + row * Width);
  }
  return stack;
}

sensornoise::Quantity
GainByCore(const StackImage & stack)
{
  const sensornoise::FrameGeometry           geometry{ Width, Height, 1 };
  sensornoise::RefinedMethod<unsigned short> method(sensornoise::RefinedSettings{}, geometry, Frames);
  while (!method.IsDone())
  {
    method.AddFrames(stack.GetBufferPointer(), Frames);
    method.EndPass();
  }
  return method.GetReport().gain;
}

sensornoise::Quantity
GainByFilter(StackImage * stack)
{
  const auto estimator = itk::SensorNoiseEstimator<StackImage>::New();
  estimator->SetInput(stack);
  estimator->Update();
  return estimator->GetReport().gain;
}

bool
IsRefusedByItsType()
{
  try
  {
    sensornoise::InspectFrameFile("no-such-file.tif");
  }
  catch (const sensornoise::FileError & error)
  {
    std::cout << "refused: " << error.what() << '\n';
    return true;
  }
  return false;
}

bool
Expect(bool isTrue, const char * what)
{
  if (!isTrue)
  {
    std::cerr << "failed: " << what << '\n';
  }
  return isTrue;
}
} // namespace

int
main()
try
{
  sensornoise::SimulationSettings settings;
  settings.frames = Frames;
  const auto                  stack = Simulate(settings);
  const sensornoise::Quantity core = GainByCore(*stack);
  const sensornoise::Quantity filter = GainByFilter(stack);
  const double                gain = core.value.value_or(std::nan(""));
  const double                error = core.standardError.value_or(std::nan(""));
  std::cout << "SensorNoise " << sensornoise::GetModuleVersion() << ": gain " << gain << " \u00B1 " << error
            << " DN/e\u207B\n";

  bool isGood = Expect(std::abs(gain - settings.camera.gainDnPerElectron) < 5.0 * error, "the gain is the camera's");
  isGood &= Expect(filter.value == core.value && filter.standardError == core.standardError,
                   "filter and core have the same gain, to the bit");
  isGood &= Expect(IsRefusedByItsType(), "an error of the library is caught by its type");
  return isGood ? EXIT_SUCCESS : EXIT_FAILURE;
}
catch (const std::exception & error)
{
  std::cerr << "failed: " << error.what() << '\n';
  return EXIT_FAILURE;
}
