// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/HelpText.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <sys/ioctl.h>
#include <unistd.h>

namespace sensornoise::tools
{

std::size_t
TerminalWidth()
{
  constexpr long narrowest = 40;
  constexpr long widest = 1000;
  // getenv() is safe: no other thread runs yet
  const char * const text = std::getenv("COLUMNS"); // NOLINT(concurrency-mt-unsafe)
  winsize            window{};
  long               columns = 80;
  if (isatty(STDOUT_FILENO) != 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0)
  {
    columns = window.ws_col;
  }
  else if (text != nullptr && std::atol(text) > 0)
  {
    columns = std::atol(text);
  }
  return static_cast<std::size_t>(std::clamp(columns, narrowest, widest));
}

std::string
WrapText(const std::string & text, std::size_t width, std::size_t indent)
{
  std::string        wrapped;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t  first = std::min(line.find_first_not_of(' '), line.size());
    std::size_t        used = first;
    std::istringstream words(line);
    wrapped += (wrapped.empty() ? "" : "\n") + std::string(first, ' ');
    bool isFirst = true;
    for (std::string word; words >> word; isFirst = false)
    {
      if (!isFirst && used + 1 + word.size() > width)
      {
        wrapped += '\n' + std::string(indent, ' ');
        used = indent;
      }
      else if (!isFirst)
      {
        wrapped += ' ';
        ++used;
      }
      wrapped += word;
      used += word.size();
    }
  }
  return wrapped;
}

std::string
HelpFormatter::make_description(const CLI::App * app) const
{
  return WrapText(app->get_description(), m_Width, 0) + '\n';
}

std::string
HelpFormatter::make_positionals(const CLI::App * /*app*/) const
{
  return "";
}

std::string
HelpFormatter::make_usage(const CLI::App * app, std::string name) const
{
  std::string usage = "\nUsage: " + name;
  for (const CLI::Option * const option : app->get_options())
  {
    usage += option->get_positional() ? " " + make_option_name(option, true) + "..." : "";
  }
  return usage + " [OPTIONS]\n\n";
}

std::string
HelpFormatter::make_group(std::string group, bool isPositional, std::vector<const CLI::Option *> options) const
{
  std::string text = group + ":\n";
  for (const CLI::Option * const option : options)
  {
    text += this->make_option(option, isPositional);
  }
  return text;
}

std::string
HelpFormatter::make_option_opts(const CLI::Option * option) const
{
  if (option->get_type_size() == 0)
  {
    return "";
  }
  const std::string type = option->get_type_name(); // "NAME:{refined,published}"
  const bool        isList = option->get_expected_max() > 2;
  return " " + type.substr(0, type.find(':')) + (isList ? "..." : "");
}

std::string
HelpFormatter::make_option_desc(const CLI::Option * option) const
{
  const std::string byDefault = option->get_type_size() == 0 ? "" : option->get_default_str();
  return option->get_description() + (option->get_required() ? " (required)" : "") +
         (byDefault.empty() ? "" : " (default: " + byDefault + ")");
}

std::string
HelpFormatter::make_option(const CLI::Option * option, bool isPositional) const
{
  constexpr std::size_t column = 24; // column in which the explanations begin
  const std::string     name = "  " + make_option_name(option, isPositional) + make_option_opts(option);
  const std::string     text = make_option_desc(option);
  // a long name gets a separate line
  const std::string start = name.size() + 2 > column ? WrapText(name, m_Width, 6) + '\n' + std::string(column, ' ')
                                                     : name + std::string(column - name.size(), ' ');
  const std::string wrapped = WrapText(std::string(column, ' ') + text, m_Width, column);
  return start + wrapped.substr(std::min(column, wrapped.size())) + '\n';
}

} // namespace sensornoise::tools
