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
#ifndef itkSensorNoiseSweep_h
#define itkSensorNoiseSweep_h

#include "SensorNoiseExport.h"
#include "itkObjectFactory.h"
#include "itkSensorNoiseReportReader.h"
#include "sensornoise/NoiseExport.h"

#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class SensorNoiseSweep
 * \brief Summarises the noise of a camera over its ISO speeds, gains or exposures, and exports it.
 *
 * SetNumber() and SetText() give the values of a report by their JSON Pointers, and AddReport() ends the report and
 * gives its setting. Summarise() then finds the line of the gains with the settings that leave it, the switch of the
 * conversion gain, and for ISO speeds the noise model of Android. The gains of exposures are tested for equality, and
 * pooled. Export() makes the files of a format of one setting, also between measured ones, or of all.
 *
 * \ingroup SensorNoise
 */
class SensorNoise_EXPORT SensorNoiseSweep : public SensorNoiseReportReader
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseSweep);

  using Self = SensorNoiseSweep;
  using Superclass = SensorNoiseReportReader;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseSweep";
  }

  /** Ends the report of a setting, and begins the next one. Settings are above 0 and in ascending order. */
  void
  AddReport(const std::string & name, double setting);

  /** Adds a setting that was not measured, with the reason as a sentence. NaN: the setting is not known. */
  void
  AddUnmeasured(const std::string & name, double setting, const std::string & reason);

  /** Kind of the settings: "iso" (default), "gain", a factor, or "exposure", an exposure time [s]. */
  itkSetMacro(SettingKind, std::string);
  itkGetConstReferenceMacro(SettingKind, std::string);

  /** Summarises the reports. Throws an ExceptionObject with a sentence if a report is none, or the settings are not in
   * ascending order. */
  void
  Summarise();

  /** Returns the summary as JSON. \see sensornoise::ToJson */
  std::string
  GetSummaryAsJson() const
  {
    return m_SummaryAsJson;
  }

  /** Returns the table of all settings and what was found, as text. */
  std::string
  GetSummaryAsText() const
  {
    return m_SummaryAsText;
  }

  /** Returns the summary as one HTML page with its figures. */
  std::string
  GetSummaryAsHtml() const
  {
    return m_SummaryAsHtml;
  }

  /** The only channel of a mosaic that is exported: "R", "G1", "G2" or "B". Default: empty, all. */
  itkSetMacro(Channel, std::string);
  itkGetConstReferenceMacro(Channel, std::string);

  /** ISO speed above which the gain is digital, for the format android. Default: NaN, no gain is digital. */
  itkSetMacro(MaxAnalogueIso, double);
  itkGetConstMacro(MaxAnalogueIso, double);

  /** Makes the files of a format, of the noise at a \a setting: a measured one, or an interpolation between its
   * neighbours. NaN: all measured settings. Throws an ExceptionObject with a sentence if the noise cannot be written.
   */
  void
  Export(const std::string & format, double setting);

  /** Returns the number of files of the last export, their names and bytes, and a note. \see NoiseModelExporter */
  unsigned int
  GetNumberOfFiles() const
  {
    return static_cast<unsigned int>(m_Export.files.size());
  }
  std::string
  GetFileName(unsigned int index) const
  {
    return m_Export.files.at(index).name;
  }
  std::string
  GetFileBytes(unsigned int index) const
  {
    return m_Export.files.at(index).bytes;
  }
  std::string
  GetNote() const
  {
    return m_Export.note;
  }

  /** Returns the setting in the name of a folder or a file as JSON, for example {"kind": "iso", "value": 800} of
   * "iso800"; "null" if there is none. \see sensornoise::SettingInName */
  static std::string
  GetSettingInNameAsJson(const std::string & name);

protected:
  SensorNoiseSweep() = default;
  ~SensorNoiseSweep() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** A setting and its burst. */
  struct Entry
  {
    std::string               name;
    double                    setting;
    std::string               reason; ///< reason why it was not measured; "": it has a report
    sensornoise::StoredReport report;
  };

  /** Makes the files, with exceptions of the library. */
  sensornoise::NoiseExport
  MakeExport(const std::string & format, double setting) const;

  std::vector<Entry>       m_Entries;
  std::string              m_SettingKind{ "iso" };
  std::string              m_SummaryAsJson;
  std::string              m_SummaryAsText;
  std::string              m_SummaryAsHtml;
  sensornoise::NoiseExport m_Export;
  std::string              m_Channel;
  double                   m_MaxAnalogueIso{ std::numeric_limits<double>::quiet_NaN() };
};

} // namespace itk

#endif
