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
#ifndef itkEmva1288Evaluator_h
#define itkEmva1288Evaluator_h

#include "SensorNoiseExport.h"
#include "sensornoise/Emva1288.h"
#include "sensornoise/FrameGeometry.h"
#include "itkImage.h"
#include "itkObject.h"
#include "itkObjectFactory.h"

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class Emva1288Evaluator
 * \brief Evaluates flat fields and dark frames at several exposures by EMVA Standard 1288, Release 4.0 Linear.
 *
 * Add the frames of each exposure, flat fields by AddFlatFrames() and dark frames by AddDarkFrames(), in any order.
 * Then call Evaluate(). An exposure may have a pair of frames and a longer series: the pair gives the photon transfer
 * curve, and the longer series the non-uniformity. See sensornoise::EvaluateEmva1288() for the quantities.
 *
 * Each stack is read once, a few frames at a time, and no frames are kept. Memory, in addition to one chunk of 32 MiB:
 * 32 bytes for each pixel of a frame. The work is threaded; the result has the same bits for any number of threads.
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time) of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT Emva1288Evaluator : public Object
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(Emva1288Evaluator);

  using Self = Emva1288Evaluator;
  using Superclass = Object;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "Emva1288Evaluator";
  }

  /** Adds the flat fields of one exposure, two frames or more. \a exposure is an exposure time, or any other number
   * that is proportional to the exposure. Throws an ExceptionObject if there are fewer than two frames, or a value is
   * NaN or infinite. Then nothing is added. */
  void
  AddFlatFrames(TStack * frames, double exposure);

  /** Adds the flat fields of one exposure, during which \a photons photons reach a pixel, on average. If all flat
   * fields have photons, the evaluation also gives responsivity, quantum efficiency, and sensitivity threshold. */
  void
  AddFlatFrames(TStack * frames, double exposure, double photons);

  /** Adds the dark frames of one exposure, two frames or more. Throws as AddFlatFrames(). */
  void
  AddDarkFrames(TStack * frames, double exposure);

  /** Returns how many series of frames were added. */
  SizeValueType
  GetNumberOfSeries() const
  {
    return m_Series.size();
  }

  /** Quantization step [DN], above 0: the variance of the quantization is its square over 12. Default 1. */
  itkSetMacro(QuantisationStep, double);
  itkGetConstMacro(QuantisationStep, double);

  /** Bits of the sensor's digital numbers, at most 16, which decide whether the brightest frames are saturated. Digital
   * numbers beyond their range are an error. Default 0: not known. */
  itkSetMacro(BitDepth, unsigned int);
  itkGetConstMacro(BitDepth, unsigned int);

  /** Unit of the exposures, "s" or "" (default): not known. The dark current is given per unit of the exposure. */
  itkSetStringMacro(ExposureUnit);
  itkGetStringMacro(ExposureUnit);

  /** Number of threads. Default 0: ITK's default. */
  itkSetMacro(NumberOfWorkUnits, ThreadIdType);
  itkGetConstMacro(NumberOfWorkUnits, ThreadIdType);

  /** Evaluates all series that were added. Throws an ExceptionObject, which names what is missing or does not fit, if
   * the series cannot be evaluated. */
  void
  Evaluate();

  /** Returns the evaluation. Throws an ExceptionObject before Evaluate(). */
  const sensornoise::EmvaReport &
  GetReport() const;

  /** Returns the evaluation as JSON, schema "itk-sensornoise-emva1288/1". */
  std::string
  GetReportAsJson() const;

  /** Returns the evaluation as a table, with its notes. */
  std::string
  GetReportAsText() const;

  /** Returns the evaluation as one HTML page with its figures. \see sensornoise::ToHtml */
  std::string
  GetReportAsHtml() const;

  /** Returns the evaluation as XML with the names of the Python package emva1288. \see sensornoise::ToXml */
  std::string
  GetReportAsXml() const;

protected:
  Emva1288Evaluator() = default;
  ~Emva1288Evaluator() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Reads the frames and adds their statistics to the series. */
  void
  Add(TStack * frames, double exposure, std::optional<double> photons, bool isDark);

  double       m_QuantisationStep{ 1.0 };
  unsigned int m_BitDepth{ 0 };
  std::string  m_ExposureUnit;
  ThreadIdType m_NumberOfWorkUnits{ 0 };

  std::vector<sensornoise::EmvaSeries>   m_Series;
  std::optional<sensornoise::EmvaReport> m_Report;
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT Emva1288Evaluator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
