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
#ifndef itkSensorNoiseReportReader_h
#define itkSensorNoiseReportReader_h

#include "SensorNoiseExport.h"
#include "itkObject.h"
#include "sensornoise/NoiseExport.h"

#include <limits>
#include <optional>
#include <ostream>
#include <string>

namespace itk
{

/** \class SensorNoiseReportReader
 * \brief Base class of the classes that read stored reports: their values, and the levels that a report may lack.
 *
 * SetNumber() and SetText() give the values of a report by their JSON Pointers. A method of the subclass ends the
 * report.
 *
 * \ingroup SensorNoise
 */
class SensorNoise_EXPORT SensorNoiseReportReader : public Object
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseReportReader);

  using Self = SensorNoiseReportReader;
  using Superclass = Object;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseReportReader";
  }

  /** Sets a number of the report, for example "/gain/value". Values that are null are left out. */
  void
  SetNumber(const std::string & pointer, double number);

  /** Sets a text of the report, for example "/gain/status". */
  void
  SetText(const std::string & pointer, const std::string & text);

  /** Black level of the frames [DN]. Default: NaN, the level in the report. */
  itkSetMacro(BlackLevel, double);
  itkGetConstMacro(BlackLevel, double);

  /** White level of the frames [DN]. Default: NaN, the level in the report. */
  itkSetMacro(WhiteLevel, double);
  itkGetConstMacro(WhiteLevel, double);

  /** Analogue gain of the frames [1], above 0, for the format libcamera. Default: 1. */
  itkSetMacro(AnalogueGain, double);
  itkGetConstMacro(AnalogueGain, double);

protected:
  SensorNoiseReportReader() = default;
  ~SensorNoiseReportReader() override = default;

  /** Returns the values since the last report as the report \a name, and begins the next one. */
  sensornoise::StoredReport
  EndReport(const std::string & name);

  /** Returns the number of a setting; null where it is NaN, the value of a setting that was not given. */
  static std::optional<double>
  IfKnown(double number);
  /** Returns the settings BlackLevel, WhiteLevel and AnalogueGain. A level that was not given is null. */
  sensornoise::ExportSettings
  MakeExportSettings() const;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  sensornoise::StoredReport m_Values;
  double                    m_BlackLevel{ std::numeric_limits<double>::quiet_NaN() };
  double                    m_WhiteLevel{ std::numeric_limits<double>::quiet_NaN() };
  double                    m_AnalogueGain{ 1.0 };
};

} // namespace itk

#endif
