// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Emva1288.h"
#include "sensornoise/Version.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

namespace
{
/** Returns the texts of all planes, one after the other: textOf(name of the plane, its report). */
template <typename TFunction>
std::string
OfPlanes(const EmvaMosaicReport & report, TFunction textOf)
{
  std::string text;
  for (std::size_t i = 0; i < BayerPlanes.size(); ++i)
  {
    text += textOf(std::string(NameOf(BayerPlanes[i])), report.planes[i]);
  }
  return text;
}
} // namespace

std::string
MakeTable(const EmvaMosaicReport & report)
{
  return OfPlanes(report, [](const std::string & name, const EmvaReport & plane) {
    return (name == "R" ? "" : "\n") + ("Plane " + name + "\n") + MakeTable(plane);
  });
}

std::string
ToJson(const EmvaMosaicReport & report)
{
  const std::string planes = OfPlanes(report, [](const std::string & name, const EmvaReport & plane) {
    std::string record = ToJson(plane);
    record.erase(record.find_last_not_of('\n') + 1);
    return (name == "R" ? "" : ",") + ("\n\"" + name + "\": " + record);
  });
  return std::string("{\"schema\": \"") + EmvaMosaicSchema + "\", \"version\": \"" + GetModuleVersion() +
         "\", \"bayer\": \"" + NameOf(report.pattern) + "\", \"planes\": {" + planes + "}}\n";
}

std::string
ToXml(const EmvaMosaicReport & report)
{
  return std::string("<mosaic pattern=\"") + NameOf(report.pattern) + "\">\n" +
         OfPlanes(report,
                  [](const std::string & name, const EmvaReport & plane) {
                    return "<plane name=\"" + name + "\">\n" + ToXml(plane) + "</plane>\n";
                  }) +
         "</mosaic>\n";
}

std::string
ToSvg(const EmvaMosaicReport & report)
{
  return ToSvg(report.planes[1]);
}

} // namespace sensornoise
