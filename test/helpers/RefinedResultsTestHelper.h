// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_RefinedResultsTestHelper_h
#define sensornoise_test_RefinedResultsTestHelper_h

#include "sensornoise/Report.h"
#include "refined/GainEstimate.h"
#include "refined/RefinedEstimate.h"
#include "refined/RefinedResults.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * Possible results of the passes of the refined method, made without a stack. */

namespace sensornoise::test
{

/** A frame of 32 x 32 pixels, a ramp from 150 to 3150 DN, of a sensor of 1 DN/e-, 100 DN and 8 DN whose response is
 * straight; 20 frames. The flicker, which is seen well, puts the offset at 100 +- 0.5 DN. */
struct HandMadeResults
{
  static constexpr std::size_t Size = 32;

  RefinedSettings       settings;
  StaticScene           scene;
  SceneSeries           series;
  StaticVariance        variance;
  ReestimatedComponents reestimated;
  std::vector<double>   correctedVariance;
  NoiseCorrelation      correlation;

  HandMadeResults()
  {
    constexpr std::size_t pixels = Size * Size;
    constexpr double      lowDn = 150.0;
    constexpr double      highDn = 3150.0;
    std::vector<double>   own;
    for (std::size_t p = 0; p < pixels; ++p)
    {
      scene.frame.mean.push_back(lowDn + (highDn - lowDn) * static_cast<double>(p) / (pixels - 1.0));
      own.push_back(scene.frame.mean.back() - 100.0 + 64.0);
    }
    scene.frame.variance = own;
    scene.valid = pixels;
    scene.pixelUse.assign(pixels, static_cast<std::uint8_t>(PixelUse::Used));
    scene.usable = pixels;
    scene.frame.geometry = { Size, Size, 1 };
    scene.frame.frames = 20;
    scene.frame.neighbourMean.assign(scene.frame.mean.begin(), scene.frame.mean.end());
    scene.frame.usable.assign(pixels, 1);
    scene.model.darkestDn = lowDn;
    scene.model.brightestDn = highDn;
    scene.model.centreDn = 1100.0;
    correctedVariance = own;

    VarianceLine & line = variance.line;
    line.gain = 1.0;
    line.intercept = -36.0;
    line.isDetermined = true;
    line.pivotDn = 1100.0;
    // Uncorrelated at the pivot: 0.01 DN/e- and 5 DN^2.
    line.covariance << 1e-4, -1e-4 * line.pivotDn, -1e-4 * line.pivotDn, 25.0 + 1e-4 * line.pivotDn * line.pivotDn;
    variance.curve.line = line;
    for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
    {
      const double level = lowDn + (highDn - lowDn) * (static_cast<double>(b) + 0.5) / VarianceCurve::Bins;
      variance.curve.bins.push_back({ 16.0, 1e-4, 1e-4 * (level - line.pivotDn), 0.0 });
    }
    variance.pixelUse = scene.pixelUse;
    variance.mask = scene.frame.usable;

    reestimated.line.offset = -1000.0;
    reestimated.line.standardError = 0.5;
    reestimated.line.low = -1001.0;
    reestimated.line.high = -999.0;
    reestimated.line.flickerZ = 100.0;
    reestimated.line.contrast = 0.99;
    for (std::size_t t = 0; t < 20; ++t)
    {
      reestimated.line.gamma.push_back(t % 2 == 0 ? 0.02 : -0.02);
    }
    // Any offset gives the same flicker, of precision 1e8.
    reestimated.line.illumination << 0.0, 0.0, 0.0, 1e8;
    reestimated.line.response = Eigen::MatrixX2d::Zero(20, 2);
    for (Eigen::Index t = 0; t < 20; ++t)
    {
      reestimated.line.response(t, 1) = 1e8 * reestimated.line.gamma[static_cast<std::size_t>(t)];
    }
  }
  /** Makes illumination that differs over the frame, with an offset of its own: 102 +- 1 DN. */
  void
  MakeLocal()
  {
    series.local.series = Eigen::MatrixXd::Ones(20, 1);
    reestimated.localOffset = LocalOffset{ -998.0, 1.0, -1000.0, -996.0, 1.0, 16, true };
  }
  RefinedResults
  Get() const
  {
    return { settings, scene, series, variance, reestimated, correctedVariance, 100.0, correlation };
  }
};

} // namespace sensornoise::test

#endif
