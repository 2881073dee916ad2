// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_StoredReportTestHelper_h
#define sensornoise_test_StoredReportTestHelper_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

/** \file
 * The stored part of a report, and the comparison of two stored reports, see StoredReportsGTest.cxx. */

namespace sensornoise::test
{

/** Returns every 16th element of an array; null stays null. */
inline nlohmann::json
Thinned(const nlohmann::json & values)
{
  nlohmann::json thinned = values.is_array() ? nlohmann::json::array() : values;
  for (std::size_t i = 0; values.is_array() && i < values.size(); i += 16)
  {
    thinned.push_back(values[i]);
  }
  return thinned;
}

/** Returns the part of a report that is stored. */
inline nlohmann::json
StoredPartOf(const std::string & text)
{
  nlohmann::json report = nlohmann::json::parse(text);
  report.erase("version");
  for (nlohmann::json & values : report["scatter"])
  {
    values = Thinned(values);
  }
  for (nlohmann::json & frame : report["flicker_rows"])
  {
    frame = Thinned(frame);
  }
  return report;
}

/** Returns a message without its numbers. */
inline std::string
WordsOf(const std::string & message)
{
  static const std::regex number("[-+]?[0-9]+([.][0-9]+)?(e[-+]?[0-9]+)?");
  return std::regex_replace(message, number, "#");
}

/** Returns the tolerance of a number. The noise correlation is summed in 4 bytes, whose rounding depends on the
 * compiler. */
inline double
ToleranceOf(const std::string & path, double number)
{
  const bool isOfSingles = path.rfind("/noise_correlation/", 0) == 0;
  return isOfSingles ? 1e-6 * std::max(1.0, std::abs(number)) : 1e-9 * std::abs(number);
}

inline bool
AreAlike(const std::string & path, const nlohmann::json & stored, const nlohmann::json & found)
{
  if (stored.is_number() && found.is_number())
  {
    const double expected = stored.get<double>();
    return std::abs(found.get<double>() - expected) <= ToleranceOf(path, expected);
  }
  const std::string name = "/message";
  const bool isMessage = path.size() > name.size() && path.compare(path.size() - name.size(), name.size(), name) == 0;
  if (isMessage && stored.is_string() && found.is_string())
  {
    return WordsOf(stored.get<std::string>()) == WordsOf(found.get<std::string>());
  }
  return stored == found;
}

/** Returns where the reports differ, and how; nothing if they agree. */
inline std::string
DifferencesOf(const nlohmann::json & stored, const nlohmann::json & found, const std::string & path = "")
{
  if (stored.is_structured() && stored.type() == found.type() && stored.size() == found.size())
  {
    std::string differences;
    auto        others = found.items(); // members in the order of their names, as in stored
    auto        other = others.begin();
    for (const auto & item : stored.items())
    {
      const std::string below = path + '/' + item.key();
      differences += item.key() == other.key() ? DifferencesOf(item.value(), other.value(), below) : below + ": gone\n";
      ++other;
    }
    return differences;
  }
  return AreAlike(path, stored, found) ? "" : path + ": stored " + stored.dump() + ", found " + found.dump() + '\n';
}

/** Returns the value with a small change: numbers differ by ten times their tolerance. */
inline nlohmann::json
Changed(const std::string & path, const nlohmann::json & value)
{
  if (value.is_number())
  {
    const double number = value.get<double>();
    return number + std::max(1e-12, 10.0 * ToleranceOf(path, number));
  }
  if (value.is_boolean())
  {
    return !value.get<bool>();
  }
  return value.is_string() ? nlohmann::json(value.get<std::string>() + '~') : nlohmann::json(0.0);
}

} // namespace sensornoise::test

#endif
