// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Runs the simulations of Tables 2 and 3 and Figures 6 to 8 of Sur & Gredi'ac 2015 and prints the estimates' mean and
// twice their standard deviation beside the truth and the paper's own figures. See --help.

#include "published/FlickerEstimate.h"
#include "studies/PaperTables.h"
#include "studies/TableRun.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using namespace sensornoise;
using tools::TableOptions;
using tools::TableParameters;
using tools::TableRun;

/** One line a parameter: truth, mean and 2 sd over the runs that identify it, and the paper's. */
void
PrintRows(const std::vector<TableRun> & runs, const std::string & label, int table)
{
  const auto figures = tools::PaperFigures(table, label.substr(0, 2));
  for (std::size_t k = 0; k < TableParameters.size(); ++k)
  {
    std::vector<double> values;
    for (const TableRun & run : runs)
    {
      if (run.estimates[k])
      {
        values.push_back(*run.estimates[k]);
      }
    }
    const double truth = runs.front().truth[k];
    const double mean = values.empty() ? NAN : Mean(values);
    const double sd = values.size() < 2 ? NAN : std::sqrt(SampleVariance(values));
    std::printf("%-8s %-15s %9.5g  %10.5g +- %-10.3g %8.2f %%  %3zu/%-3zu  %s\n",
                k == 0 ? label.c_str() : "",
                TableParameters[k],
                truth,
                mean,
                2.0 * sd,
                100.0 * (mean / truth - 1.0),
                values.size(),
                runs.size(),
                figures[k].c_str());
  }
  std::fflush(stdout);
}

void
WriteCsv(const std::string & name, const std::vector<TableRun> & runs)
{
  std::ofstream file(name);
  file << "reference,camera,condition,frames,seed,parameter,truth,estimate\n";
  file.precision(10);
  for (const TableRun & run : runs)
  {
    for (std::size_t k = 0; k < TableParameters.size(); ++k)
    {
      file << run.reference << ',' << run.camera << ',' << run.condition << ',' << run.frames << ',' << run.seed << ','
           << TableParameters[k] << ',' << run.truth[k] << ',';
      if (run.estimates[k])
      {
        file << *run.estimates[k];
      }
      file << '\n';
    }
  }
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + name);
  }
}

void
Reproduce(const TableOptions & options)
{
  const int table = options.reference == "target" ? 2 : options.reference == "texture" ? 3 : 0;
  std::printf("reference %s, %zu x %zu, %u seeds; n/N: runs that identify the parameter; paper: Table %d\n",
              options.reference.c_str(),
              options.size,
              options.size,
              options.seeds,
              table);
  std::printf("%-8s %-15s %9s  %10s +- %-10s %10s  %-7s  %s\n",
              "exp.",
              "parameter",
              "truth",
              "mean",
              "2 sd",
              "bias",
              "n/N",
              "paper");
  // Figure 6: camera A, condition 3, more and more frames.
  const std::vector<std::string> experiments = options.figure6 ? std::vector<std::string>{ "A3" } : options.experiments;
  const std::vector<std::size_t> lengths = options.figure6 ? std::vector<std::size_t>{ 10, 20, 50, 100, 200, 500 }
                                                           : std::vector<std::size_t>{ options.frames };
  std::vector<TableRun>          all;
  for (const std::string & experiment : experiments)
  {
    for (const std::size_t frames : lengths)
    {
      std::vector<TableRun> runs;
      for (std::uint64_t seed = 1; seed <= options.seeds; ++seed)
      {
        runs.push_back({ options.reference, experiment[0], experiment[1] - '0', frames, seed });
      }
      tools::ExecuteAll(runs, options);
      PrintRows(
        runs, options.figure6 ? experiment + " T=" + std::to_string(frames) : experiment, options.figure6 ? 0 : table);
      all.insert(all.end(), runs.begin(), runs.end());
      if (!options.csv.empty())
      {
        WriteCsv(options.csv, all);
      }
    }
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  TableOptions options;
  CLI::App     app(
    "Tables 2 and 3 and the data of Figures 6 to 8 of Sur & Grediac 2015, by simulation.\n"
        "Table 2: --reference target. Table 3's pattern: --reference texture. Figures 7 and 8: --seeds 50 --csv\n"
        "for each reference. Figure 6: --figure6 --seeds 50 --csv FILE.");
  app.add_option("--reference", options.reference)
    ->check(CLI::IsMember({ "target", "texture", "bars" }))
    ->capture_default_str();
  app.add_option("--experiments", options.experiments, "for example A1,B3")
    ->delimiter(',')
    ->check(CLI::IsMember({ "A1", "A2", "A3", "B1", "B2", "B3", "C1", "C2", "C3" }));
  app.add_option("--seeds", options.seeds)->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--size", options.size, "width and height [pixels]")
    ->check(CLI::Range(32, 4096))
    ->capture_default_str();
  app.add_option("--frames", options.frames)->check(CLI::Range(5, 10000))->capture_default_str();
  app.add_option("--rolling-shutter", options.rollingShutterPeriod, "bands of the flicker [rows]; 0: global");
  app.add_option("--flicker-sd", options.flickerSd, "instead of the condition's");
  app.add_option("--clip", options.clip, "LOW,HIGH: levels that the sensor attains [DN]")->delimiter(',')->expected(2);
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 1024));
  app.add_flag("--figure6", options.figure6, "camera A, condition 3, 10 to 500 frames");
  app.add_option("--csv", options.csv, "every single run, one line a parameter");
  CLI11_PARSE(app, argc, argv);
  try
  {
    Reproduce(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
