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
#ifndef itkNoiseProfileChecker_h
#define itkNoiseProfileChecker_h

#include "SensorNoiseExport.h"
#include "itkObjectFactory.h"
#include "itkSensorNoiseReportReader.h"
#include "sensornoise/NoiseExport.h"

#include <ostream>
#include <string>
#include <vector>

namespace itk
{

/** \class NoiseProfileChecker
 * \brief Compares the noise of frames with the noise profile of another program, intensity band by intensity band.
 *
 * SetNumber() and SetText() give the values of a report, or of a profile in JSON, by their JSON Pointers. SetReport()
 * ends the report, and SetProfileValues() the profile. SetProfileFile() names a profile of any other format: a DNG file
 * with the tag NoiseProfile, YAML, CAREamics' npz, XML, a macro, or a FITS header. Check() then compares both for each
 * channel of the report. If a band does not fit, the sentence of the check names the known mistakes with which the
 * profile would fit. Levels that were not set come from the report, or from the DNG file with the profile.
 *
 * \ingroup SensorNoise
 */
class SensorNoise_EXPORT NoiseProfileChecker : public SensorNoiseReportReader
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(NoiseProfileChecker);

  using Self = NoiseProfileChecker;
  using Superclass = SensorNoiseReportReader;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "NoiseProfileChecker";
  }

  /** Ends the values of the report of the frames. The \a name is the name of the report in messages. */
  void
  SetReport(const std::string & name);

  /** Ends the values of a profile in JSON. The \a name is the name of its file in messages. */
  void
  SetProfileValues(const std::string & name);

  /** Sets the name of a file with a profile that is not JSON. */
  void
  SetProfileFile(const std::string & name);

  /** Compares the frames with the profile. Throws an ExceptionObject with a sentence if the profile cannot be read, is
   * none, or does not determine the variance, or if the report is none. */
  void
  Check();

  /** Returns the number of channels of the report. */
  unsigned int
  GetNumberOfChannels() const
  {
    return static_cast<unsigned int>(m_Results.size());
  }

  /** Returns the name of a channel: "mono", "R", "G1", "G2" or "B". */
  std::string
  GetChannel(unsigned int index) const
  {
    return m_Results.at(index).channel;
  }

  /** Returns why a channel could not be compared, as a sentence. Empty: it was compared. */
  std::string
  GetReason(unsigned int index) const
  {
    return m_Results.at(index).reason;
  }

  /** Returns the check of a channel as JSON, schema "itk-sensornoise-check/1", or as a readable table. Empty if the
   * channel could not be compared. */
  std::string
  GetCheckAsJson(unsigned int index) const
  {
    return m_Results.at(index).json;
  }
  std::string
  GetCheckAsText(unsigned int index) const
  {
    return m_Results.at(index).table;
  }

protected:
  NoiseProfileChecker() = default;
  ~NoiseProfileChecker() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  /** Check of one channel, as it is returned. */
  struct Result
  {
    std::string channel;
    std::string reason;
    std::string json;
    std::string table;
  };

  /** Compares, with exceptions of the library. */
  std::vector<Result>
  MakeResults() const;

  sensornoise::StoredReport m_Report;
  sensornoise::StoredReport m_Profile;
  std::string               m_ProfileFile; // "": m_Profile has the values
  std::vector<Result>       m_Results;
};

} // namespace itk

#endif
