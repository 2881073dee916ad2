// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StudyCase_h
#define StudyCase_h

#include "sensornoise/Simulator.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Options of measure-cases that change how the stacks of its cases are simulated and measured. */
struct StudyOptions
{
  std::optional<std::size_t> size;   ///< width and height of the frames [pixels]; null: as the case has it
  std::optional<std::size_t> frames; ///< frames of a stack; null: as the case has them
  std::string                method{ "refined" };

  // Options of the efficiency study only; null or empty: values of camera and condition.
  std::uint64_t         sceneSeed{ DefaultSceneSeed }; ///< seed of the target's or the texture's random numbers
  std::optional<double> flickerSd;                     ///< standard deviation of the illumination factor [1]
  std::vector<double>   vibrationSd;                   ///< standard deviations along x and y [pixels]
  std::optional<double> gain;                          ///< system gain [DN/e-]
  std::optional<double> offset;                        ///< dark offset [DN]
  std::optional<double> readNoise;                     ///< [DN]
  std::optional<double> electrons;                     ///< expected photoelectrons of the brightest pixel [e-]
  std::vector<double>   clip;                          ///< lowest and highest level that the sensor attains [DN]
  double                rollingShutterPeriod{ 0.0 };   ///< period of the illumination bands [rows]; 0: global shutter
  std::string           bayer{ "none" };               ///< pattern of a mosaic, whose planes are measured each
  bool                  isFullBound{ false };          ///< the Cramér-Rao bound itself, instead of its closed forms
};

/** Kind of simulated stack, and how it is measured. */
struct StudyCase
{
  /** Simulates and measures the stack of one seed. Returns a record for each report: its truth, the report, and what
   * the tables of its study need. The records of a case, a seed and options are the same on every call. */
  using Measure = std::function<std::vector<nlohmann::ordered_json>(const StudyOptions &, std::uint64_t seed)>;

  std::string name; ///< study, case and scene: "robustness/gamma2.2/target"
  std::string what; ///< one-line description
  Measure     measure;
};

/** Appends the cameras and conditions of Table 1 of Sur & Grédiac 2015, in front of three scenes. */
void
AppendEfficiencyCases(std::vector<StudyCase> & cases);

/** Appends the bursts with faults of recording and processing. */
void
AppendRobustnessCases(std::vector<StudyCase> & cases);

/** Appends the sensors that deviate from the noise model as real sensors do. */
void
AppendSensorCases(std::vector<StudyCase> & cases);

/** Appends the noise models that are compared with another burst of their camera. */
void
AppendCheckCases(std::vector<StudyCase> & cases);

/** Appends the single images: scenes without and with texture, clipped frames, and composites of bursts. */
void
AppendSingleImageCases(std::vector<StudyCase> & cases);

/** Returns all cases, in the order in which they are listed. */
std::vector<StudyCase>
GetStudyCases();

} // namespace sensornoise::tools

#endif
