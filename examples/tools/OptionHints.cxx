// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/OptionHints.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Returns the edit distance: the smallest number of insertions, deletions and replacements that change one word
 * into the other. */
std::size_t
EditDistance(const std::string & a, const std::string & b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({ row[j + 1] + 1, row[j] + 1, replaced });
    }
  }
  return row.back();
}

/** Returns a word without its leading hyphens and without the part from "=" on. */
std::string
NameIn(const std::string & word)
{
  const std::size_t first = std::min(word.find_first_not_of('-'), word.size());
  return word.substr(first, word.find('=') - first);
}
} // namespace

std::string
UnknownOption(const CLI::App & app, const std::string & word)
{
  constexpr std::size_t farthest = 2; // edits
  std::string           nearest;
  std::size_t           least = farthest + 1;
  for (const CLI::Option * const option : app.get_options())
  {
    const std::string name = option->get_name();
    const std::size_t distance = EditDistance(NameIn(word), NameIn(name));
    if (name.rfind("--", 0) == 0 && distance < least)
    {
      least = distance;
      nearest = name;
    }
  }
  return "there is no option " + word + (nearest.empty() ? "" : "; is " + nearest + " meant?") +
         (nearest.empty() ? "; --help lists all options" : " --help lists all options");
}

bool
IsWholeNumber(const std::string & text)
{
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

std::string
ReasonNotWhole(const std::string & text)
{
  return IsWholeNumber(text) ? "" : "it is \"" + text + "\"; expected a whole number of 0 or more";
}

void
RequireValues(const CLI::App & app)
{
  for (const CLI::Option * const option : app.get_options())
  {
    for (const std::string & value : option->results())
    {
      if (value.rfind("--", 0) == 0 && app.get_option_no_throw(value) != nullptr)
      {
        throw CLI::ValidationError(option->get_name(),
                                   value + " is an option; expected a value: " + option->get_name() + " " +
                                     option->get_type_name());
      }
      if (value.empty() && option->get_expected_max() == 1)
      {
        throw CLI::ValidationError(option->get_name(),
                                   "its value is empty, as of a shell's variable that is not set; expected " +
                                     option->get_name() + " " + option->get_type_name());
      }
    }
  }
}

} // namespace sensornoise::tools
