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
#ifndef itkNoiseModelExporter_h
#define itkNoiseModelExporter_h

#include "SensorNoiseExport.h"
#include "itkImage.h"
#include "itkObjectFactory.h"
#include "itkSensorNoiseReportReader.h"
#include "sensornoise/NoiseExport.h"

#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class NoiseModelExporter
 * \brief Writes the noise model of a stored report for the programs that use one, in their units.
 *
 * SetNumber() and SetText() give the values of a report by their JSON Pointers, and AddReport() ends the report.
 * Export() then makes the files of a format in memory. The table sensornoise::ExportFormats() has the formats.
 *
 * \ingroup SensorNoise
 */
class SensorNoise_EXPORT NoiseModelExporter : public SensorNoiseReportReader
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(NoiseModelExporter);

  using Self = NoiseModelExporter;
  using Superclass = SensorNoiseReportReader;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "NoiseModelExporter";
  }

  /** Ends a report, and begins the next one. The \a name is the name of the report in messages. */
  void
  AddReport(const std::string & name);

  /** ISO speed above which the gain is digital, for the format android. Default: NaN, none is. */
  itkSetMacro(MaxAnalogueIso, double);
  itkGetConstMacro(MaxAnalogueIso, double);

  /** Name of a DNG file, for the format dng. The result is then a copy of this file with the tag NoiseProfile, by the
   * black and the white level of the file. Default: empty, the result is text. */
  itkSetMacro(DngFile, std::string);
  itkGetConstReferenceMacro(DngFile, std::string);

  /** Sets the maps of the first report, for the format maps: dark offset and read noise of each pixel [DN]. */
  void
  SetMaps(const Image<double, 2> * offset, const Image<double, 2> * readNoise);

  /** Makes the files of a format. Throws an ExceptionObject with a sentence if the noise cannot be written in it. */
  void
  Export(const std::string & format);

  /** Returns the number of files of the last export. */
  unsigned int
  GetNumberOfFiles() const
  {
    return static_cast<unsigned int>(m_Export.files.size());
  }

  /** Returns the name of a file, without a folder. */
  std::string
  GetFileName(unsigned int index) const
  {
    return m_Export.files.at(index).name;
  }

  /** Returns the bytes of a file. In Python they are a str with surrogate escapes. */
  std::string
  GetFileBytes(unsigned int index) const
  {
    return m_Export.files.at(index).bytes;
  }

  /** Returns a sentence about the misfit or the use of the last export; it may be empty. */
  std::string
  GetNote() const
  {
    return m_Export.note;
  }

  /** Returns the table of all formats as JSON. \see sensornoise::ExportFormatsAsJson */
  static std::string
  GetFormatsAsJson()
  {
    return sensornoise::ExportFormatsAsJson();
  }

protected:
  NoiseModelExporter() = default;
  ~NoiseModelExporter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Makes the files, with exceptions of the library. */
  sensornoise::NoiseExport
  MakeExport(const std::string & format) const;

  std::vector<sensornoise::StoredReport> m_Reports;
  sensornoise::NoiseMaps                 m_Maps;
  sensornoise::NoiseExport               m_Export;
  std::string                            m_DngFile;
  double                                 m_MaxAnalogueIso{ std::numeric_limits<double>::quiet_NaN() };
};

} // namespace itk

#endif
