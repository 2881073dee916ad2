// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef HelpText_h
#define HelpText_h

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** The columns of the terminal that standard output is, else COLUMNS of the environment, else 80. At least 40. */
std::size_t
TerminalWidth();

/** Breaks each line of a text between words, so that it has at most \a width characters where words allow. Further
 * lines of a paragraph begin with \a indent blanks. */
std::string
WrapText(const std::string & text, std::size_t width, std::size_t indent);

/** Writes --help at the width of the terminal. Positional arguments are explained by the description alone. */
class HelpFormatter : public CLI::Formatter
{
public:
  explicit HelpFormatter(std::size_t width)
    : m_Width(width)
  {}

  std::string
  make_description(const CLI::App * app) const override;
  std::string
  make_positionals(const CLI::App * app) const override;
  std::string
  make_usage(const CLI::App * app, std::string name) const override;
  std::string
  make_group(std::string group, bool isPositional, std::vector<const CLI::Option *> options) const override;
  std::string
  make_option(const CLI::Option * option, bool isPositional) const override;
  /** The name of the value alone. */
  std::string
  make_option_opts(const CLI::Option * option) const override;
  /** The explanation, then the default. */
  std::string
  make_option_desc(const CLI::Option * option) const override;

private:
  std::size_t m_Width;
};

} // namespace sensornoise::tools

#endif
