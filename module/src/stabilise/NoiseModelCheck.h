// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_NoiseModelCheck_h
#define sensornoise_stabilise_NoiseModelCheck_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "sensornoise/NoiseModel.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** \class NoiseModelCheck
 * \brief Whether frames have the noise that a model says: their variance over the model's, level by level.
 *
 * This ratio is the variance after the generalized Anscombe transform, up to what the transform itself lacks, which is
 * known by integration and stands beside it. The frames are not transformed for it: their variance without flicker and
 * motion, which the refined method finds for every pixel, is exact for flicker of any strength, whereas the root of a
 * flickering level cannot be freed of it exactly.
 *
 * A band fits where the ratio is within 0.02 of 1 (at both ends more, for the noise of the means that pixels are sorted
 * by) or within four standard errors. The errors are those of a variance
 * of as many pixels and frames, times what neighbouring bins differ by in excess of that: shared noise, pixels that
 * differ, tails. The model's own errors are not in them. */
struct NoiseModelCheck
{
  /** Neighbouring levels. */
  struct Band
  {
    double                lowDn{ 0.0 };
    double                highDn{ 0.0 };
    std::size_t           pixels{ 0 };
    std::optional<double> ratio; ///< variance over the model's [1]; null: the model's is not above 0
    double                standardError{ 0.0 };
    /** Variance after the transform if the model is right [1]; null: in the dark, where the read noise is not known. */
    std::optional<double> transformVariance;
    bool                  fits{ false };
  };

  enum class Verdict : std::uint8_t
  {
    Fits,       ///< in all bands
    DoesNotFit, ///< in some
    NotTold     ///< nothing was measured, or with errors above 5 % in most bands
  };

  std::vector<Band> bands; ///< dark to bright
  Verdict           verdict{ Verdict::NotTold };
  std::string       sentence; ///< for people
};

/** Compares \a frames, what the refined method says of the frames to be checked, with \a model. \a readNoiseElectrons
 * serves Band::transformVariance only. */
SensorNoise_EXPORT NoiseModelCheck
CheckNoiseModel(const Report &        frames,
                const NoiseModel &    model,
                std::optional<double> readNoiseElectrons = std::nullopt);

/** The same with the model of a \a report; says so where the frames are of another scale. Throws as NoiseModelOf(). */
SensorNoise_EXPORT NoiseModelCheck
CheckReport(const Report & frames, const Report & report);

/** "fits", "does-not-fit" or "not-told". */
SensorNoise_EXPORT const char *
NameOf(NoiseModelCheck::Verdict verdict);

/** As JSON, schema "itk-sensornoise-check/1". */
SensorNoise_EXPORT std::string
ToJson(const NoiseModelCheck & check);

/** The bands as a table, and the sentence. */
SensorNoise_EXPORT std::string
MakeTable(const NoiseModelCheck & check);

} // namespace sensornoise

#endif
