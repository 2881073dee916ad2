// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Runs the published method filter by filter, as an ITK pipeline that streams from one reader:
//
//   reader -> TemporalStatistics -> VibrationMask -> FlickerCorrection(reader) -> TemporalStatistics -> NoiseRegression
//
// This is Figure 2 of F. Sur, M. Gredi'ac, SIAM J. Imaging Sci. 8(1), 2015. SensorNoiseEstimator gives the same numbers
// with fewer passes over the stack.

#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"
#include "itkFlickerCorrectionImageFilter.h"
#include "itkNoiseRegressionEstimator.h"
#include "itkSensorNoiseFrameListSource.h"
#include "itkTemporalStatisticsImageFilter.h"
#include "itkVibrationMaskImageFilter.h"

#include <cstdlib>
#include <iostream>
#include <string>

int
main(int argc, char * argv[])
{
  if (argc < 2)
  {
    std::cerr << "usage: " << argv[0] << " STACK.mha   or   FRAME.tif ...   (16-bit frames in time order)\n";
    return 2;
  }
  try
  {
    using StackType = itk::Image<unsigned short, 3>;
    auto reader = itk::SensorNoiseFrameListSource<StackType>::New();
    reader->SetFileNames({ argv + 1, argv + argc });

    auto statistics = itk::TemporalStatisticsImageFilter<StackType>::New();
    statistics->SetInput(reader->GetOutput());
    reader->UpdateOutputInformation();
    const auto frames = reader->GetOutput()->GetLargestPossibleRegion().GetSize(2);

    auto mask = itk::VibrationMaskImageFilter<>::New();
    mask->SetInput(statistics->GetMean());
    mask->SetVariance(statistics->GetVariance());
    mask->SetValidMask(statistics->GetValidMask());
    mask->SetNumberOfFrames(frames);

    auto flicker = itk::FlickerCorrectionImageFilter<StackType>::New();
    flicker->SetInput(reader->GetOutput());
    flicker->SetMean(statistics->GetMean());
    flicker->SetVariance(statistics->GetVariance());
    flicker->SetMask(mask->GetOutput());

    auto corrected = itk::TemporalStatisticsImageFilter<itk::Image<double, 3>>::New();
    corrected->SetInput(flicker->GetOutput());

    auto regression = itk::NoiseRegressionEstimator<>::New();
    regression->SetMean(statistics->GetMean());
    regression->SetVariance(corrected->GetVariance());
    regression->SetMask(mask->GetOutput());
    regression->SetOffsetInput(flicker->GetOffsetOutput());
    regression->Update();

    const sensornoise::Report & report = regression->GetReport();
    for (const sensornoise::QuantityEntry & entry : sensornoise::QuantityList())
    {
      const sensornoise::Quantity * quantity = entry.of(report);
      if (quantity != nullptr && quantity->value)
      {
        std::cout << entry.label << ' ' << *quantity->value << ' ' << entry.unit << '\n';
      }
    }
    std::cout << "flicker sd " << flicker->GetFlicker().flickerSd << '\n';
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << error.GetDescription() << '\n';
    return 2;
  }
  return EXIT_SUCCESS;
}
