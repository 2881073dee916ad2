// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_FlickerCorrectionTestHelper_h
#define sensornoise_test_FlickerCorrectionTestHelper_h

#include "itkFlickerCorrectionImageFilter.h"
#include "itkImage.h"
#include "itkTemporalStatisticsImageFilter.h"
#include "itkVibrationMaskImageFilter.h"
#include "helpers/PipelineTestHelper.h"

/** \file
 * The correction of flicker on a simulated stack, with what comes before it. */

namespace sensornoisetest::flicker
{
using StackType = itk::Image<unsigned short, 3>;
using DoubleStackType = itk::Image<double, 3>;
inline constexpr unsigned int Width = 65;
inline constexpr unsigned int Height = 63;
inline constexpr unsigned int Frames = 25;

/** The filter with the mean, variance and vibration mask of the stack itself, all from one source. */
template <typename TStack>
struct Chain
{
  explicit Chain(TStack * stack, unsigned int frames = Frames)
  {
    statistics->SetInput(stack);
    mask->SetInput(statistics->GetMean());
    mask->SetVariance(statistics->GetVariance());
    mask->SetValidMask(statistics->GetValidMask());
    mask->SetNumberOfFrames(frames);
    filter->SetInput(stack);
    filter->SetMean(statistics->GetMean());
    filter->SetVariance(statistics->GetVariance());
    filter->SetMask(mask->GetOutput());
  }
  typename itk::TemporalStatisticsImageFilter<TStack>::Pointer statistics =
    itk::TemporalStatisticsImageFilter<TStack>::New();
  itk::VibrationMaskImageFilter<>::Pointer                    mask = itk::VibrationMaskImageFilter<>::New();
  typename itk::FlickerCorrectionImageFilter<TStack>::Pointer filter = itk::FlickerCorrectionImageFilter<TStack>::New();
};
template <typename TStack>
Chain(TStack *, unsigned int) -> Chain<TStack>;

inline StackType::Pointer
SimulatedStack()
{
  static const StackType::Pointer stack = TargetStack<StackType>(Width, Height, Frames);
  return stack;
}

} // namespace sensornoisetest::flicker

#endif
