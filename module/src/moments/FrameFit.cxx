// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameFit.h"

#include "moments/Constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sensornoise
{

std::vector<std::size_t>
AllBelow(std::size_t count)
{
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{ 0 });
  return all;
}

FrameFit
FitCells(const std::vector<double> & mean, const std::vector<double> & frame, const std::vector<std::size_t> & used)
{
  const auto count = static_cast<double>(used.size());
  FrameFit   fit;
  for (const std::size_t i : used)
  {
    fit.centre += mean[i];
    fit.level += frame[i];
  }
  fit.centre /= count;
  fit.level /= count;
  double ofMean = 0.0;
  double ofFrame = 0.0;
  double ofBoth = 0.0;
  for (const std::size_t i : used)
  {
    ofMean += (mean[i] - fit.centre) * (mean[i] - fit.centre);
    ofFrame += (frame[i] - fit.level) * (frame[i] - fit.level);
    ofBoth += (mean[i] - fit.centre) * (frame[i] - fit.level);
  }
  fit.factor = ofMean > 0.0 ? ofBoth / ofMean : 0.0;
  fit.misfit = std::max(0.0, ofFrame - fit.factor * ofBoth) / count;
  return fit;
}

FrameFit
FitMostCells(const std::vector<double> & mean, const std::vector<double> & frame)
{
  std::vector<std::size_t> cells = AllBelow(mean.size());
  const FrameFit           all = FitCells(mean, frame, cells);
  const auto               few = static_cast<std::ptrdiff_t>(InMoments.fewCells * static_cast<double>(cells.size()));
  const auto               difference = [&](std::size_t i) { return std::abs(all.DifferenceOf(mean[i], frame[i])); };
  std::nth_element(cells.begin(), cells.end() - 1 - few, cells.end(), [&](std::size_t a, std::size_t b) {
    return difference(a) < difference(b) || (!(difference(b) < difference(a)) && a < b);
  });
  cells.resize(cells.size() - static_cast<std::size_t>(few));
  std::sort(cells.begin(), cells.end()); // the same order of summation with every standard library
  return FitCells(mean, frame, cells);
}

} // namespace sensornoise
