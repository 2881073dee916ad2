// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"

#include "sensornoise/WarningCodes.h"
#include "report/JsonWriter.h"

#include <vector>

namespace sensornoise
{

/** Found by JsonWriter, as all that it writes. */
static void
WriteJson(JsonWriter & json, const WarningKind & kind)
{
  json.Object([&] {
    json.Member("code", kind.name).Member("severity", NameOf(kind.severity)).Member("sentence", kind.sentence);
  });
}

static void
WriteJson(JsonWriter & json, const QuantityEntry & entry)
{
  json.Object([&] {
    json.Member("path", entry.path).Member("label", entry.label).Member("unit", entry.unit);
    json.Member("meaning", entry.meaning);
  });
}

std::string
CatalogueAsJson()
{
  std::string text;
  JsonWriter  json(text);
  json.Object([&] { json.Member("warnings", WarningTable).Member("quantities", QuantityList()); });
  text += '\n';
  return text;
}

} // namespace sensornoise
