// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_SharpScene_h
#define sensornoise_scene_SharpScene_h

#include "SensorNoiseExport.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Returns the largest squared difference between the pixels before and after a pixel, along x and along y, among the
 * 3 x 3 pixels around pixel \a p of a \a mean of \a width columns [DN^2]. The pixel is at least StencilMargin pixels
 * from the border.
 *
 * The variance that motion by a standard deviation of one pixel adds to one pixel is at most their sum. An edge that is
 * sharper than a pixel lies within one pixel, which changes by the whole step; its central difference is half of it,
 * and the next pixel, which does not change at all, has the same difference. */
SensorNoise_EXPORT std::array<double, 2>
SquaredStepsNear(const double * mean, std::size_t width, std::size_t p);

/** Fits the initial noise model to a scene whose edges are sharper than a pixel. Null: they are not.
 *
 * If a fit excludes pixels that hold more than a tenth of the squared derivatives of the mean, but hardly any of the
 * smoother half of the pixels, it has excluded the motion itself. This fit starts from the motion that sums over 3 x 3
 * pixels show, and excludes the pixels whose variance is far above the largest that motion explains. Estimator.md, 3.2.
 * \param sample of \a pixels, at least one
 * \param prediction of the fit without sharp edges, with the pixels that it keeps
 * \param ratio of raw to explained variance above which a pixel is excluded [1] */
SensorNoise_EXPORT std::optional<VarianceSample::Coefficients>
FitSharpScene(const ReferenceFrame &           frame,
              const std::vector<std::size_t> & pixels,
              const VarianceSample &           sample,
              const VariancePrediction &       prediction,
              double                           ratio);

} // namespace sensornoise

#endif
