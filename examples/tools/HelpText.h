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

/** Returns the width of the terminal [characters], from 40 to 1000. It is the width of standard output if that is a
 * terminal, else the environment variable COLUMNS, else 80. */
std::size_t
TerminalWidth();

/** Breaks each line of a text between words. Lines have at most \a width characters unless a word is longer. The
 * continuation lines of a paragraph begin with \a indent blanks. */
std::string
WrapText(const std::string & text, std::size_t width, std::size_t indent);

/** Formatter that writes --help at the width of the terminal. Positional arguments are explained only in the
 * description. */
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
  /** Returns the name of the value of an option, without the permitted values. */
  std::string
  make_option_opts(const CLI::Option * option) const override;
  /** Returns the explanation of an option, then its default. */
  std::string
  make_option_desc(const CLI::Option * option) const override;

private:
  std::size_t m_Width;
};

} // namespace sensornoise::tools

#endif
