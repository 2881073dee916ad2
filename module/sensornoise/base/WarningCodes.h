// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_WarningCodes_h
#define sensornoise_base_WarningCodes_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** What a warning is about. */
enum class WarningCode : std::uint8_t
{
  FewFrames,
  Mosaic,
  RedOrBlue,
  BayerPatternDiffers,
  GreensDiffer,
  OffsetsDiffer,
  RepeatedFrames,
  FramesLeftOut,
  IrregularCodes,
  Companded,
  ClipLevelFound,
  NotFinitePixels,
  NearClipLevel,
  NotStatic,
  NoisyPixels,
  LocalLight,
  RollingShutter,
  LinesWithoutFlicker,
  OffsetDrift,
  StrongVibration,
  NoiseCorrelated,
  ResponseNotStraight,
  ResponseUnchecked,
  FlickerNotIdentifiable,
  OffsetNotIdentifiable,
  ReadNoiseUpperLimit,
  ReadNoiseNotIdentifiable,
  SteadyLight,
  OffsetOutOfRange,
  DarkFramesDiffer,
  OffsetAboveDarkest,
  OffsetLineMisfit,
  PoorFit,
  CorrectedVarianceCurved,
  BrightSetWidened,
  DarkSetWidened,
  SceneChanges,
  NothingToMeasure,
  TooLittleToMeasure,
  CodesTooCoarse,
  IntensityRangeTooSmall,
  NoiseNotLinear,
  FramesEnlarged,
  VarianceNotAffine,
  Contradicted,
  GainNotUniform,
  VarianceSteps,
  BorderLeftOut,
  LightSeriesLeft
};

/** What a warning does to the measurement. */
enum class Severity : std::uint8_t
{
  Note,    ///< allowed for: every number stands
  Warning, ///< some number is missing, or rests on something that was not seen or does not fit
  Error    ///< no gain
};

inline const char *
NameOf(Severity severity)
{
  return severity == Severity::Note ? "note" : severity == Severity::Warning ? "warning" : "error";
}

/** A line of the table of warnings. */
struct WarningKind
{
  WarningCode  code;
  const char * name; ///< in the JSON record; stable, for programs
  Severity     severity;
  const char * sentence; ///< what it means, and what helps
};

/** All that a report can warn of, in the order of WarningCode. README and Python show this table; a warning's own
 * message has the numbers. */
inline constexpr std::array<WarningKind, 49> WarningTable{ {
  { WarningCode::FewFrames, "few-frames", Severity::Warning, "Fewer than 20 different frames: indicative only." },
  { WarningCode::Mosaic,
    "mosaic",
    Severity::Warning,
    "The levels of neighbouring pixels alternate as behind the colour filters of a Bayer mosaic: measure its planes, "
    "by "
    "the option bayer." },
  { WarningCode::RedOrBlue,
    "red-or-blue",
    Severity::Note,
    "The pattern of the mosaic was found from the levels, which tell green; R and B may be exchanged." },
  { WarningCode::BayerPatternDiffers,
    "bayer-pattern-differs",
    Severity::Warning,
    "The levels contradict the Bayer pattern that was given: the planes called green differ, and the two others are "
    "alike. Give the pattern of the sensor, or `bayer=\"auto\"`." },
  { WarningCode::GreensDiffer,
    "greens-differ",
    Severity::Warning,
    "The two greens of a mosaic, which are alike, have different gains: another pattern, or rows that are read in "
    "different ways." },
  { WarningCode::OffsetsDiffer,
    "offsets-differ",
    Severity::Warning,
    "The offsets of a mosaic's channels differ by more than their errors, and have no common value: coloured light "
    "that "
    "does not flicker, or a black level for each." },
  { WarningCode::RepeatedFrames,
    "repeated-frames",
    Severity::Note,
    "Frames are equal to earlier ones, as where a recorder runs faster than its camera: each is counted once, and all "
    "else is that of a stack without them." },
  { WarningCode::FramesLeftOut,
    "frames-left-out",
    Severity::Warning,
    "Frames are unlike the others and are left out, as `frames_left_out` says: their pixels are not finite, have no "
    "noise (zeros, saturated), or show another scene, a shadow, or light of another shape; or their "
    "noise is not that of the others at their level, as of another gain." },
  { WarningCode::IrregularCodes,
    "irregular-codes",
    Severity::Warning,
    "The spacing of the codes varies: the frames were rescaled, and the noise of rounding is not known." },
  { WarningCode::Companded,
    "companded",
    Severity::Note,
    "Codes lie farther apart at bright levels than at dark ones: a tone curve to fewer bits, undone. `gain` is the "
    "sensor's; `variance_slope` holds the noise of rounding, too (the published method's gain does). `--step` says "
    "that "
    "the codes are even." },
  { WarningCode::ClipLevelFound,
    "clip-level-found",
    Severity::Note,
    "The sensor saturates inside the code range, or the frames are floating-point: pixels that reach the level are "
    "left "
    "out." },
  { WarningCode::NotFinitePixels,
    "not-finite-pixels",
    Severity::Note,
    "Pixels are NaN or infinite in a frame: they are left out." },
  { WarningCode::NearClipLevel,
    "near-clip-level",
    Severity::Note,
    "More than 1 % of the pixels reach a clip level, or noise and flicker could carry them there: they are left out." },
  { WarningCode::NotStatic,
    "not-static",
    Severity::Note,
    "More than 1 % of the pixels lie where something moves or changes: they are left out." },
  { WarningCode::NoisyPixels,
    "noisy-pixels",
    Severity::Note,
    "More than 0.2 % of the pixels have another noise than the others: they are left out." },
  { WarningCode::LocalLight,
    "local-light",
    Severity::Note,
    "The light changes differently over the frame: a rolling shutter, several lamps, bleaching, a filter between "
    "frames, "
    "or strong noise of whole rows. Gain and intercept allow for it." },
  { WarningCode::RollingShutter,
    "rolling-shutter",
    Severity::Note,
    "The flicker differs from row to row, and is estimated so (published method)." },
  { WarningCode::LinesWithoutFlicker,
    "lines-without-flicker",
    Severity::Note,
    "Bright pixels do not reach some rows, whose flicker is not known: they are left out (published method)." },
  { WarningCode::OffsetDrift, "offset-drift", Severity::Note, "A level common to all pixels drifts over the burst." },
  { WarningCode::StrongVibration,
    "strong-vibration",
    Severity::Warning,
    "The scene moves by more than 0.4 pixels rms, as far as the table's limits allow: register the frames to whole "
    "pixels first." },
  { WarningCode::NoiseCorrelated,
    "noise-correlated",
    Severity::Warning,
    "Neighbours or frames share noise: `gain` is of the sensor, by the sum over lags, `variance_slope` of the frames. "
    "Ask "
    "the camera for raw frames." },
  { WarningCode::ResponseNotStraight,
    "response-not-straight",
    Severity::Warning,
    "The variance departs from its line by 1 to 12 %: the response bends. `gain` is the mean of the local gain, and "
    "its "
    "interval holds the gains of the parts of the levels." },
  { WarningCode::ResponseUnchecked,
    "response-unchecked",
    Severity::Warning,
    "The darkest levels have more than a tenth of the brightest's light, and there are no dark frames: a bend could "
    "not "
    "be seen." },
  { WarningCode::FlickerNotIdentifiable,
    "flicker-not-identifiable",
    Severity::Warning,
    "The light is not told from the offset, so the flicker relative to it is not known: a known offset would help, or "
    "a "
    "scene with dark and bright areas." },
  { WarningCode::OffsetNotIdentifiable,
    "offset-not-identifiable",
    Severity::Warning,
    "Too little flicker, light too complicated, or a ramp, whose motion looks like an offset: more flicker or frames, "
    "dark frames or a known offset would help." },
  { WarningCode::ReadNoiseUpperLimit,
    "read-noise-upper-limit",
    Severity::Warning,
    "The read noise cannot be told from 0, or from the rounding to codes." },
  { WarningCode::ReadNoiseNotIdentifiable,
    "read-noise-not-identifiable",
    Severity::Warning,
    "Gain, intercept and offset give a read noise whose square is below 0 (published method)." },
  { WarningCode::SteadyLight,
    "steady-light",
    Severity::Warning,
    "The level that does not flicker is not the given offset: light that does not flicker, dark current, or another "
    "offset." },
  { WarningCode::OffsetOutOfRange,
    "offset-out-of-range",
    Severity::Warning,
    "The given offset is above the darkest level, or where the read noise would be imaginary." },
  { WarningCode::DarkFramesDiffer,
    "dark-frames-differ",
    Severity::Warning,
    "The dark frames have another noise than the bright ones at the offset: another exposure, gain or temperature." },
  { WarningCode::OffsetAboveDarkest,
    "offset-above-darkest",
    Severity::Warning,
    "The offset is above the darkest level, so its error is larger than that: more frames or flicker would help "
    "(published method)." },
  { WarningCode::OffsetLineMisfit,
    "offset-line-misfit",
    Severity::Warning,
    "Dark pixels do not follow the bright ones' flicker: the offset is doubtful (published method)." },
  { WarningCode::PoorFit,
    "poor-fit",
    Severity::Warning,
    "The corrected variance scatters about its line more than sampling noise does (published method)." },
  { WarningCode::CorrectedVarianceCurved,
    "corrected-variance-curved",
    Severity::Warning,
    "The corrected variance bends: vibrations, several lamps, or frames that are not linear (published method)." },
  { WarningCode::BrightSetWidened,
    "bright-set-widened",
    Severity::Note,
    "Too few pixels had the bright intensity, and more levels were taken (published method)." },
  { WarningCode::DarkSetWidened,
    "dark-set-widened",
    Severity::Note,
    "Too few pixels had the dark intensity, and more levels were taken (published method)." },
  { WarningCode::SceneChanges,
    "scene-changes",
    Severity::Error,
    "The frames do not show one still scene: another axis than time was taken for time, or the scene changes, or the "
    "camera moves by many pixels." },
  { WarningCode::NothingToMeasure,
    "nothing-to-measure",
    Severity::Error,
    "Fewer than 5 different frames, or no pixels to measure." },
  { WarningCode::TooLittleToMeasure,
    "too-little-to-measure",
    Severity::Error,
    "Too few pixels fit a static scene, or too few frames have light: choose a static part of it, or record more "
    "frames with light." },
  { WarningCode::CodesTooCoarse,
    "codes-too-coarse",
    Severity::Error,
    "The noise is below half a code step: more gain, or more bits, would show it." },
  { WarningCode::IntensityRangeTooSmall,
    "intensity-range-too-small",
    Severity::Error,
    "The scene has one intensity: one with dark and bright areas would help, or dark frames." },
  { WarningCode::NoiseNotLinear,
    "noise-not-linear",
    Severity::Error,
    "The noise is not as a linear filter leaves it: the camera corrects defects, takes medians or compresses (ask it "
    "for raw frames), or places of the scene move by themselves (choose a smooth part)." },
  { WarningCode::FramesEnlarged,
    "frames-enlarged",
    Severity::Error,
    "The frames were enlarged or a mosaic was interpolated: they have fewer samples than pixels. Give the frames as "
    "the "
    "camera read them." },
  { WarningCode::VarianceNotAffine,
    "variance-not-affine",
    Severity::Error,
    "The variance departs from its line by more than 12 %, falls with the mean, or bends so that gain and read noise "
    "cannot be told apart: not raw (gamma, compression), not linear, or saturated at a level that was not found." },
  { WarningCode::Contradicted,
    "contradicted",
    Severity::Error,
    "What else was found contradicts the gain: a variance that scatters less than chance allows, or an interval that "
    "holds 0. The frames are no burst of one scene, or the light of one or two frames is all there is." },
  { WarningCode::GainNotUniform,
    "gain-not-uniform",
    Severity::Warning,
    "Parts of the frame have different gains, as behind several amplifiers, in stitched blocks, or of a mosaic given "
    "as mono; or parts of the burst have, as where the camera changed while it recorded. `gain` is the mean over all, "
    "its interval holds the gains of the parts, and `gain_by_parts` has each. Measure the parts by themselves (--roi, "
    "--mask, --bayer, --frames)." },
  { WarningCode::VarianceSteps,
    "variance-steps",
    Severity::Warning,
    "The variance steps at a level: pixels are read by two amplifiers, each for a part of the levels (dual gain, HDR). "
    "`gain` is that of both sides, its interval holds both; intercept, offset and read noise are those of the levels "
    "below the step. Measure either side by itself (--level-range), or ask the camera for one amplifier." },
  { WarningCode::BorderLeftOut,
    "border-left-out",
    Severity::Note,
    "Columns or rows along the border are no part of the scene, as optical-black pixels or masked regions: they have "
    "one level and end within a pixel along the whole border. They are left out." },
  { WarningCode::LightSeriesLeft,
    "light-series-left",
    Severity::Warning,
    "The illumination changes in more independent ways over the frame than can be taken out of so many frames, as with "
    "cells that flash one by one or lamps that pulse under a rolling shutter. What is left may add to the gain, and "
    "its "
    "interval holds that. Record more frames, or choose a part that is lit evenly (--roi)." },
} };

/** The line of \a code. */
constexpr const WarningKind &
KindOf(WarningCode code)
{
  return WarningTable[static_cast<std::size_t>(code)];
}

namespace detail
{
constexpr bool
IsInOrder()
{
  for (std::size_t i = 0; i < WarningTable.size(); ++i)
  {
    if (static_cast<std::size_t>(WarningTable[i].code) != i || WarningTable[i].sentence == nullptr)
    {
      return false;
    }
  }
  return static_cast<std::size_t>(WarningCode::LightSeriesLeft) + 1 == WarningTable.size();
}
static_assert(IsInOrder(), "the table has a line for every code, in their order");
} // namespace detail

} // namespace sensornoise

#endif
