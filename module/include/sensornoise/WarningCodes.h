// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_WarningCodes_h
#define sensornoise_WarningCodes_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Subject of a warning. */
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
  MotionNotUniform,
  PeriodicInterference,
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
  DarkSignalVaries,
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
  LightSeriesLeft,
  TextureDominates,
  LineOnly
};

/** Severity of a warning: its effect on the measurement. */
enum class Severity : std::uint8_t
{
  Note,    ///< the effect is corrected for, and every number is valid
  Warning, ///< a number is missing, or depends on an assumption that was not confirmed or does not fit
  Error    ///< the report has no gain
};

/** Returns the name of the severity: "note", "warning" or "error". */
inline const char *
NameOf(Severity severity)
{
  return severity == Severity::Note ? "note" : severity == Severity::Warning ? "warning" : "error";
}

/** Row of the table of warnings. */
struct WarningKind
{
  WarningCode  code;     ///< subject of the warning
  const char * name;     ///< name in the JSON record; stable, for programs
  Severity     severity; ///< effect on the measurement
  const char * sentence; ///< meaning of the warning, and what to do
};

/** All warnings that a report can have, in the order of WarningCode. documentation/reference/warnings.md and the Python
 * package show this table. The message of a warning has the numbers. */
inline constexpr std::array<WarningKind, 54> WarningTable{ {
  { WarningCode::FewFrames,
    "few-frames",
    Severity::Warning,
    "Fewer than 20 distinct frames: treat the results as indicative. Record at least 20." },
  { WarningCode::Mosaic,
    "mosaic",
    Severity::Warning,
    "The levels of neighbouring pixels alternate as behind the colour filters of a Bayer mosaic, but the frames were "
    "measured as monochrome ones. Measure each colour by itself (--bayer)." },
  { WarningCode::RedOrBlue,
    "red-or-blue",
    Severity::Note,
    "The pattern of the mosaic was found from the levels, which distinguish only green: R and B may be exchanged. Give "
    "the pattern of the sensor (--bayer)." },
  { WarningCode::BayerPatternDiffers,
    "bayer-pattern-differs",
    Severity::Warning,
    "The levels contradict the given Bayer pattern: its greens differ, and its red and blue are alike. Give the "
    "pattern of the sensor (--bayer), or auto." },
  { WarningCode::GreensDiffer,
    "greens-differ",
    Severity::Warning,
    "The gains of a mosaic's two greens differ: the pattern is wrong, or rows are read by different amplifiers. "
    "Check the pattern (--bayer)." },
  { WarningCode::OffsetsDiffer,
    "offsets-differ",
    Severity::Warning,
    "The offsets of a mosaic's channels differ by more than their errors: steady coloured illumination, or a black "
    "level for each channel. Give dark frames (--dark)." },
  { WarningCode::RepeatedFrames,
    "repeated-frames",
    Severity::Note,
    "Frames are equal to earlier ones, as where a recorder runs faster than its camera. Each distinct frame is counted "
    "once, because a repetition has no new noise. Set the recorder to the frame rate of the camera." },
  { WarningCode::FramesLeftOut,
    "frames-left-out",
    Severity::Warning,
    "Frames that are unlike the others would change the variance of all pixels. They are left out, and "
    "`frames_left_out` names them: not finite, without noise (zeros, saturated), of another scene, dark offset, gain "
    "or "
    "processing, or with a shadow. Check how these frames were recorded." },
  { WarningCode::IrregularCodes,
    "irregular-codes",
    Severity::Warning,
    "The quantization step varies: the frames were rescaled, and their quantization noise is not known. Give the "
    "frames as the camera recorded them." },
  { WarningCode::Companded,
    "companded",
    Severity::Note,
    "The quantization step grows with the level, as after a tone curve to fewer bits: `gain` is the sensor's, and "
    "`variance_slope` (with the published method `gain`, too) includes the quantization noise. Give the size of "
    "the steps (--step) if all are equal." },
  { WarningCode::ClipLevelFound,
    "clip-level-found",
    Severity::Note,
    "The sensor saturates inside the range of its digital numbers, or the frames are floating-point. Pixels that reach "
    "the level are left out, because clipping reduces their variance. Check the level, and give the correct "
    "level (--clip) if it is wrong." },
  { WarningCode::NotFinitePixels,
    "not-finite-pixels",
    Severity::Note,
    "Pixels that are NaN or infinite in a frame are left out, because they have no variance. Check the processing that "
    "wrote these values, as cameras do not record them." },
  { WarningCode::NearClipLevel,
    "near-clip-level",
    Severity::Note,
    "More than 1 % of the pixels reach a clip level, or could reach it by noise and flicker. These pixels are left "
    "out, "
    "because clipping reduces their variance. Change the exposure to keep them." },
  { WarningCode::NotStatic,
    "not-static",
    Severity::Note,
    "More than 1 % of the pixels lie where something moves or changes. They are left out, because the change adds to "
    "their variance. Look at the map of pixel use (--maps) to see where they are." },
  { WarningCode::NoisyPixels,
    "noisy-pixels",
    Severity::Note,
    "More than 0.2 % of the pixels are noisier or quieter than the others, or computed from their neighbours. They are "
    "left out, because their variance is not the variance of a typical pixel. Look at the map of pixel use (--maps) to "
    "see where they are." },
  { WarningCode::LocalLight,
    "local-light",
    Severity::Note,
    "The illumination changes differently over the frame: a rolling shutter, several light sources, bleaching, a "
    "filter between frames, or strong row noise. Gain and intercept allow for it, at larger errors. Use one light "
    "source without pulses if they are too large." },
  { WarningCode::RollingShutter,
    "rolling-shutter",
    Severity::Note,
    "The flicker differs from row to row, and is estimated for each row, which needs bright pixels in all of them "
    "(published method). Use constant illumination to avoid this." },
  { WarningCode::LinesWithoutFlicker,
    "lines-without-flicker",
    Severity::Note,
    "Some rows have no bright pixels, so that their flicker is not known: they are left out (published method). "
    "Include bright areas in all rows, or use --method refined." },
  { WarningCode::OffsetDrift,
    "offset-drift",
    Severity::Note,
    "The dark offset of all pixels drifts over the burst, which gain and intercept allow for, at larger errors. Let "
    "the "
    "camera warm up before the recording." },
  { WarningCode::StrongVibration,
    "strong-vibration",
    Severity::Warning,
    "The scene may move by more than 0.4 pixels rms, so that rough areas are left out. Choose a smooth part "
    "of the scene (--roi), or keep camera and scene still." },
  { WarningCode::MotionNotUniform,
    "motion-not-uniform",
    Severity::Note,
    "Blocks of the frame do not share the shifts of the scene, so that there is no common vibration: a part of the "
    "frame "
    "does not move with the scene, or changes of the illumination resemble motion. Gain and intercept allow for both. "
    "Choose a part of the frame that moves as a whole (--roi)." },
  { WarningCode::PeriodicInterference,
    "periodic-interference",
    Severity::Note,
    "The frames contain sine waves with a phase of their own in each frame: pickup from a power supply or a clock. "
    "Gain, intercept and read noise are without them. Look for their source in cables, power supply and read-out "
    "clock." },
  { WarningCode::NoiseCorrelated,
    "noise-correlated",
    Severity::Warning,
    "The noise of neighbouring pixels or of frames is correlated: `gain` is the sensor's, from the covariance over all "
    "lags, and `variance_slope` belongs to the frames. Set the camera to raw frames." },
  { WarningCode::ResponseNotStraight,
    "response-not-straight",
    Severity::Warning,
    "The variance deviates from its line by 1 to 12 %: the response is non-linear, and the interval of `gain` contains "
    "the gains of parts of the levels. Fit a linear part alone (--level-range)." },
  { WarningCode::ResponseUnchecked,
    "response-unchecked",
    Severity::Warning,
    "The darkest areas have more than a tenth of the signal of the brightest, and no dark frames were given, so that a "
    "non-linear response would not be noticed. Give dark frames (--dark), or include dark areas in the scene." },
  { WarningCode::FlickerNotIdentifiable,
    "flicker-not-identifiable",
    Severity::Warning,
    "The illumination change is not known well enough, as signal and offset are not distinguished. Give the offset "
    "(--offset) or dark frames (--dark), or include dark and bright areas in the scene." },
  { WarningCode::OffsetNotIdentifiable,
    "offset-not-identifiable",
    Severity::Warning,
    "The illumination does not determine the offset: too little flicker, complicated illumination, or a ramp, whose "
    "motion resembles an offset. Give dark frames (--dark) or the offset (--offset), or record more flicker or more "
    "frames." },
  { WarningCode::ReadNoiseUpperLimit,
    "read-noise-upper-limit",
    Severity::Warning,
    "The read noise is not distinguished from 0 or from the quantization noise, and only its limit is given. Record "
    "more frames or dark frames (--dark), or use a higher analogue gain." },
  { WarningCode::ReadNoiseNotIdentifiable,
    "read-noise-not-identifiable",
    Severity::Warning,
    "Gain, intercept and offset give a squared read noise below 0, within their errors (published method). Record more "
    "frames, or use --method refined." },
  { WarningCode::SteadyLight,
    "steady-light",
    Severity::Warning,
    "The level that does not flicker differs from the given offset: steady illumination, dark current, or an offset of "
    "another setting. "
    "Switch steady light sources off, or give an offset of the same exposure and temperature." },
  { WarningCode::OffsetOutOfRange,
    "offset-out-of-range",
    Severity::Warning,
    "The given offset is above the darkest level, or makes the squared read noise negative. Leave it out, or record "
    "dark frames with the setting of the frames (--dark)." },
  { WarningCode::DarkFramesDiffer,
    "dark-frames-differ",
    Severity::Warning,
    "The dark frames hold signal of the scene, or their noise differs from the noise of the frames at the offset, so "
    "the gain is measured without them. Record dark frames in the dark, with the black level, exposure, gain and "
    "temperature of the frames." },
  { WarningCode::DarkSignalVaries,
    "dark-signal-varies",
    Severity::Warning,
    "The dark frames hold charge that differs from place to place (dark current, glow or light): offset and read noise "
    "have errors that contain it. Cover the sensor and record them again, or cool it." },
  { WarningCode::OffsetAboveDarkest,
    "offset-above-darkest",
    Severity::Warning,
    "The offset is above the darkest level, because its error is large (published method). Record more flicker or more "
    "frames." },
  { WarningCode::OffsetLineMisfit,
    "offset-line-misfit",
    Severity::Warning,
    "Dark pixels do not follow the flicker of the bright ones, so that the offset is doubtful (published method). Use "
    "one light source, or --method refined." },
  { WarningCode::PoorFit,
    "poor-fit",
    Severity::Warning,
    "The corrected variance scatters about its line more than sampling noise does: vibrations, local flicker or moving "
    "objects (published method). Use --method refined." },
  { WarningCode::CorrectedVarianceCurved,
    "corrected-variance-curved",
    Severity::Warning,
    "The corrected variance is a curve of the mean, so that the gain depends on the range of levels: vibrations, "
    "several "
    "light sources, or a non-linear response (published method). Use --method refined." },
  { WarningCode::BrightSetWidened,
    "bright-set-widened",
    Severity::Note,
    "Too few pixels have the bright intensity. The method takes a less bright intensity or a wider range of levels, "
    "which "
    "determines flicker and offset less well (published method). Include larger areas of one brightness in the "
    "scene." },
  { WarningCode::DarkSetWidened,
    "dark-set-widened",
    Severity::Note,
    "Too few pixels have the dark intensity. The method takes a less dark intensity or a wider range of levels, which "
    "determines the offset less well (published method). Include larger areas of one brightness in the scene." },
  { WarningCode::SceneChanges,
    "scene-changes",
    Severity::Error,
    "The frames do not show one static scene. Check whether another axis was taken for time, the scene or camera "
    "moves, the illumination is off in some frames (leave them out: --frames), or the bytes of each pixel are swapped "
    "(--raw)." },
  { WarningCode::NothingToMeasure,
    "nothing-to-measure",
    Severity::Error,
    "Fewer than 5 distinct frames, or no pixels that can be measured. Record more frames, of a static scene between "
    "the clip levels." },
  { WarningCode::TooLittleToMeasure,
    "too-little-to-measure",
    Severity::Error,
    "Too few pixels fit a static scene, or too few frames are illuminated. Choose a static part of the scene (--roi), "
    "or record more illuminated frames." },
  { WarningCode::CodesTooCoarse,
    "codes-too-coarse",
    Severity::Error,
    "The noise of more than a fifth of the pixels is below half the quantization step, which hides it. Use more bits, "
    "or a higher analogue gain." },
  { WarningCode::IntensityRangeTooSmall,
    "intensity-range-too-small",
    Severity::Error,
    "The levels of the scene do not determine the gain. Record more frames, include dark and bright areas in the "
    "scene, or give dark frames (--dark)." },
  { WarningCode::NoiseNotLinear,
    "noise-not-linear",
    Severity::Error,
    "The noise does not fit sensor noise after a linear filter: the camera corrects defects, takes medians, "
    "compresses, or "
    "mixes frames only where they differ little, parts of the scene move by themselves, or the illumination changes in "
    "fine patterns. Set the camera to raw frames, or choose a smooth and evenly lit part of the scene (--roi)." },
  { WarningCode::FramesEnlarged,
    "frames-enlarged",
    Severity::Error,
    "The frames were enlarged, or interpolated in another way (a mosaic, a change of size or shape): their pixels are "
    "not the samples of the sensor. Give the frames as the camera read them." },
  { WarningCode::VarianceNotAffine,
    "variance-not-affine",
    Severity::Error,
    "The variance deviates from its line by more than 12 %, falls with the mean, or is a curve, so that gain and read "
    "noise are not distinguished: not raw, not linear, or saturated. Record raw frames, or give the saturation level "
    "(--clip)." },
  { WarningCode::Contradicted,
    "contradicted",
    Severity::Error,
    "The gain is contradicted: the variance scatters less than by chance, the interval of the gain contains 0, or rows "
    "have illumination of their own. Record one unprocessed burst of one scene, with more lit frames and without "
    "pulsed illumination." },
  { WarningCode::GainNotUniform,
    "gain-not-uniform",
    Severity::Warning,
    "Parts of the frame or of the burst have different gains, as behind several amplifiers: `gain` is their mean, its "
    "interval contains them, and `gain_by_parts` lists them. Measure the parts by themselves (--roi, --mask, --bayer, "
    "--frames)." },
  { WarningCode::VarianceSteps,
    "variance-steps",
    Severity::Warning,
    "The variance steps at a level, as where two amplifiers read the pixels (dual gain, HDR): the interval of `gain` "
    "contains both gains, and intercept, offset and read noise are of the levels below. Measure either side by itself "
    "(--level-range)." },
  { WarningCode::BorderLeftOut,
    "border-left-out",
    Severity::Note,
    "Columns or rows along the border, as optical-black pixels or masked regions, do not show the scene, which begins "
    "within a pixel. They are left out. Use the results as they are, or choose the lit area (--roi)." },
  { WarningCode::LightSeriesLeft,
    "light-series-left",
    Severity::Warning,
    "The illumination changes in more independent ways than so many frames allow to remove, as with cells that flash "
    "one by one: the interval of `gain` contains what is left. Record more frames, or choose an evenly lit part "
    "(--roi)." },
  { WarningCode::TextureDominates,
    "texture-dominates",
    Severity::Warning,
    "Texture, edges, fixed-pattern noise or filtered noise are in the variance of a single image, so that the gain may "
    "be off by more than its error (single-image method). Include even areas in the scene, or record a burst and use "
    "--method refined." },
  { WarningCode::LineOnly,
    "line-only",
    Severity::Warning,
    "A single image determines only slope and intercept of the variance: offset and read noise are not identifiable "
    "(single-image method). Record a burst under changing illumination, or dark frames, and use --method refined." },
} };

/** Returns the row of the table for \a code. */
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
  return static_cast<std::size_t>(WarningCode::LineOnly) + 1 == WarningTable.size();
}
static_assert(IsInOrder(), "the table has a line for every code, in their order");
} // namespace detail

} // namespace sensornoise

#endif
