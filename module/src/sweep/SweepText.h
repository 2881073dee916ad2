// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_SweepText_h
#define sensornoise_sweep_SweepText_h

#include "sweep/SweepSummary.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise
{

/** Columns of the table of a sweep. */
inline constexpr std::size_t SweepColumns = 8;

using SweepCellRow = std::array<std::string, SweepColumns>;
using SweepCells = std::vector<SweepCellRow>;

/** Returns the table of the measured settings as text, with the names of its columns in the first row. */
SweepCells
SweepCellsOf(const SweepSummary & summary);

/** Returns the camera and how many settings were measured. */
std::string
SweepTitle(const SweepSummary & summary);

} // namespace sensornoise

#endif
