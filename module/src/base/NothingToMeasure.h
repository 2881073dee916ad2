// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_NothingToMeasure_h
#define sensornoise_base_NothingToMeasure_h

#include "SensorNoiseExport.h"
#include "sensornoise/WarningCodes.h"

#include <stdexcept>
#include <string>

namespace sensornoise
{

/** \class NothingToMeasure
 * \brief Exception for a stack that is read without error, but cannot be measured: the result is a report with the
 * reason.
 *
 * Every other exception is an error and passes through the methods. */
class SensorNoise_EXPORT NothingToMeasure : public std::runtime_error
{
public:
  /** \a code is the code of the warning in the report, \a message one sentence for the user. */
  explicit NothingToMeasure(const std::string & message, WarningCode code = WarningCode::NothingToMeasure)
    : std::runtime_error(message)
    , m_Code(code)
  {}

  WarningCode
  GetCode() const
  {
    return m_Code;
  }

private:
  WarningCode m_Code;
};

} // namespace sensornoise

#endif
