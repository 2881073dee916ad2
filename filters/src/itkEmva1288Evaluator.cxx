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
#include "itkEmva1288Evaluator.h"

#include "itkSensorNoiseChunks.h"
#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseThreads.h"

#include <algorithm>

namespace itk
{

template <typename TStack>
void
Emva1288Evaluator<TStack>::AddFlatFrames(TStack * frames, double exposure)
{
  this->Add(frames, exposure, std::nullopt, false);
}

template <typename TStack>
void
Emva1288Evaluator<TStack>::AddFlatFrames(TStack * frames, double exposure, double photons)
{
  this->Add(frames, exposure, photons, false);
}

template <typename TStack>
void
Emva1288Evaluator<TStack>::AddDarkFrames(TStack * frames, double exposure)
{
  this->Add(frames, exposure, 0.0, true);
}

template <typename TStack>
void
Emva1288Evaluator<TStack>::Add(TStack * frames, double exposure, std::optional<double> photons, bool isDark)
{
  if (frames == nullptr)
  {
    itkExceptionMacro("there are no frames; expected an image of two or more frames");
  }
  frames->UpdateOutputInformation();
  const auto          largest = frames->GetLargestPossibleRegion();
  const SizeValueType pixels = largest.GetSize(0) * largest.GetSize(1);
  const SizeValueType step = SensorNoiseFramesPerChunk(pixels * sizeof(typename TStack::PixelType));
  const auto          threads = SensorNoiseThreads(m_NumberOfWorkUnits);
  WithItkErrors(this, [&] {
    sensornoise::EmvaSeriesSums sums(largest.GetSize(0), largest.GetSize(1));
    for (SizeValueType first = 0; first < largest.GetSize(2); first += step)
    {
      auto region = largest;
      region.SetIndex(2, largest.GetIndex(2) + static_cast<IndexValueType>(first));
      region.SetSize(2, std::min(step, largest.GetSize(2) - first));
      frames->SetRequestedRegion(region);
      frames->Update();
      RequirePixels(frames, "the image of frames");
      const auto * pixel = frames->GetBufferPointer() + frames->ComputeOffset(region.GetIndex());
      for (SizeValueType t = 0; t < region.GetSize(2); ++t, pixel += pixels)
      {
        sums.AddFrame(pixel, threads);
      }
    }
    frames->SetRequestedRegionToLargestPossibleRegion();
    sensornoise::EmvaSeries series = sums.Measure(threads);
    series.exposure = exposure;
    series.photons = photons;
    series.isDark = isDark;
    m_Series.push_back(series);
  });
  m_Report.reset();
  this->Modified();
}

template <typename TStack>
void
Emva1288Evaluator<TStack>::Evaluate()
{
  m_Report = WithItkErrors(this, [this] {
    return sensornoise::EvaluateEmva1288(m_Series, { m_QuantisationStep, m_BitDepth, m_ExposureUnit });
  });
}

template <typename TStack>
const sensornoise::EmvaReport &
Emva1288Evaluator<TStack>::GetReport() const
{
  if (!m_Report)
  {
    itkExceptionMacro("there is no evaluation: Evaluate() comes first, after all frames were added");
  }
  return *m_Report;
}

template <typename TStack>
std::string
Emva1288Evaluator<TStack>::GetReportAsJson() const
{
  return sensornoise::ToJson(this->GetReport());
}

template <typename TStack>
std::string
Emva1288Evaluator<TStack>::GetReportAsText() const
{
  return sensornoise::MakeTable(this->GetReport());
}

template <typename TStack>
std::string
Emva1288Evaluator<TStack>::GetReportAsHtml() const
{
  return sensornoise::ToHtml(this->GetReport());
}

template <typename TStack>
std::string
Emva1288Evaluator<TStack>::GetReportAsXml() const
{
  return sensornoise::ToXml(this->GetReport());
}

template <typename TStack>
void
Emva1288Evaluator<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "QuantisationStep: " << m_QuantisationStep << std::endl;
  os << indent << "BitDepth: " << m_BitDepth << std::endl;
  os << indent << "ExposureUnit: " << m_ExposureUnit << std::endl;
  os << indent << "NumberOfWorkUnits: " << m_NumberOfWorkUnits << std::endl;
  os << indent << "Series: " << m_Series.size() << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class Emva1288Evaluator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
