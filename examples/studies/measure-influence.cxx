// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures what the refined method's most influential constants do: half of each, and twice, in six cases of
// measure-robustness. Its library is compiled with SENSORNOISE_VARY_CONSTANTS. See --help.

#include "studies/InfluenceConstants.h"
#include "studies/InfluenceRun.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace sensornoise;
using tools::InfluenceCase;
using tools::InfluenceResult;
using tools::Run;
using tools::VariedConstant;

struct Options
{
  std::vector<std::string> cases{ "waving_quarter", "hot_pixels",      "bleach_mixed",
                                  "shoulder+4",     "brighter_fatter", "smoothed" };
  std::vector<std::string> constants;
  std::string              reference{ "texture" };
  std::uint64_t            seeds{ 8 };
  std::size_t              size{ 256 };
  unsigned int             threads{ std::max(1U, std::thread::hardware_concurrency()) };
  bool                     list{ false };
};

std::vector<VariedConstant>
ChooseConstants(const std::vector<std::string> & names)
{
  std::vector<VariedConstant> chosen;
  for (const VariedConstant & constant : tools::GetVariedConstants())
  {
    if (names.empty() || std::find(names.begin(), names.end(), constant.name) != names.end())
    {
      chosen.push_back(constant);
    }
  }
  if (chosen.size() < names.size())
  {
    throw std::invalid_argument("a constant is not known; --list names them all");
  }
  return chosen;
}

/** A row of the table: a constant's value, and what it gives in each case. */
struct Row
{
  std::string                  name;
  std::string                  value;
  std::vector<InfluenceResult> results;
};

std::string
ValueText(const VariedConstant & constant, double factor)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.4g", factor * *constant.value);
  return text;
}

std::string
CellText(const InfluenceResult & result, std::uint64_t seeds)
{
  if (!result.biasPercent)
  {
    return "0/" + std::to_string(seeds);
  }
  char text[96];
  std::snprintf(text,
                sizeof(text),
                "%+.2f ± %.2f, %.1f, %zu/%zu",
                *result.biasPercent,
                *result.errorPercent,
                *result.largestZ,
                result.right,
                result.told);
  return text;
}

/** Of a row that is \a isAsIs, and of cells in which a report changed; "=" where none did. */
void
PrintRow(const Row & row, std::uint64_t seeds, bool isAsIs)
{
  std::printf("| %s | %s |", row.name.c_str(), row.value.c_str());
  for (const InfluenceResult & result : row.results)
  {
    std::printf(" %s |", isAsIs || result.changed > 0 ? CellText(result, seeds).c_str() : "=");
  }
  std::printf("\n");
}

void
PrintTable(const Options & options, const std::vector<Row> & rows)
{
  std::printf("%llu stacks a case, %zu x %zu, %s; a cell: mean error of the gain [%%] ± mean standard error, largest "
              "error over standard error, stacks within 3 of them / stacks whose gain is told; = no report changes\n\n",
              static_cast<unsigned long long>(options.seeds),
              options.size,
              options.size,
              options.reference.c_str());
  std::printf("| constant | value |");
  for (const std::string & name : options.cases)
  {
    std::printf(" %s |", name.c_str());
  }
  std::printf("\n|---|---|");
  for (std::size_t c = 0; c < options.cases.size(); ++c)
  {
    std::printf("---|");
  }
  std::printf("\n");
  std::size_t changed = 0;
  for (const Row & row : rows)
  {
    PrintRow(row, options.seeds, &row == &rows.front());
    for (const InfluenceResult & result : row.results)
    {
      changed += result.changed;
    }
  }
  std::printf("\n%zu of %llu reports changed\n",
              changed,
              static_cast<unsigned long long>(options.seeds * options.cases.size() * (rows.size() - 1)));
}

void
Measure(const Options & options)
{
  const std::vector<VariedConstant> constants = ChooseConstants(options.constants);
  std::vector<Row>                  rows{ { "as they are", "", {} } };
  for (const VariedConstant & constant : constants)
  {
    for (const double factor : { 0.5, 2.0 })
    {
      rows.push_back({ constant.name, ValueText(constant, factor), {} });
    }
  }
  for (const std::string & name : options.cases)
  {
    const InfluenceCase stacks =
      tools::MakeInfluenceCase(name, options.reference, options.size, options.seeds, options.threads);
    const std::vector<Run> asIs = tools::MeasureCase(stacks, options.threads);
    rows[0].results.push_back(tools::SummariseInfluence(asIs, asIs));
    std::size_t row = 1;
    for (const VariedConstant & constant : constants)
    {
      for (const double factor : { 0.5, 2.0 })
      {
        const tools::ConstantChange change(*constant.value, factor * *constant.value);
        rows[row++].results.push_back(tools::SummariseInfluence(tools::MeasureCase(stacks, options.threads), asIs));
        std::fprintf(stderr, "%s %s x %g\n", name.c_str(), constant.name.c_str(), factor);
      }
    }
  }
  PrintTable(options, rows);
}
} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app("Measures what half and twice of the refined method's most influential constants do to the gain of\n"
               "simulated bursts (measure-robustness --list says what is wrong with them). Prints a table.\n"
               "About half a second a stack, constant, value and thread.");
  app.add_option("--cases", options.cases, "of measure-robustness")->delimiter(',')->capture_default_str();
  app.add_option(
    "--constant", options.constants, "this one alone, for example Significance.manyTests; may be repeated");
  app.add_option("--reference", options.reference)
    ->check(CLI::IsMember({ "target", "texture" }))
    ->capture_default_str();
  app.add_option("--seeds", options.seeds, "stacks of each case")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--size", options.size, "width and height [pixels]")
    ->check(CLI::Range(64, 4096))
    ->capture_default_str();
  app.add_option("--threads", options.threads, "stacks at a time")->check(CLI::Range(1, 1024));
  app.add_flag("--list", options.list, "the constants, and nothing else");
  CLI11_PARSE(app, argc, argv);
  try
  {
    if (options.list)
    {
      for (const VariedConstant & constant : tools::GetVariedConstants())
      {
        std::printf("%-32s %-8s %-3s %s\n",
                    constant.name.c_str(),
                    ValueText(constant, 1.0).c_str(),
                    constant.unit.c_str(),
                    constant.what.c_str());
      }
      return 0;
    }
    Measure(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
