// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/StoredReportFile.h"

#include "tools/ReportFile.h"

#include <nlohmann/json.hpp>

namespace sensornoise::tools
{

StoredReport
ReadStoredReport(const std::string & file)
{
  StoredReport stored;
  stored.name = file;
  const nlohmann::json flat = ReadReportRecord(file).flatten();
  for (const auto & [pointer, value] : flat.items())
  {
    if (value.is_number())
    {
      stored.numbers[pointer] = value.get<double>();
    }
    else if (value.is_string())
    {
      stored.texts[pointer] = value.get<std::string>();
    }
  }
  return stored;
}

} // namespace sensornoise::tools
