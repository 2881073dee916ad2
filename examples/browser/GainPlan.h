// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef GainPlan_h
#define GainPlan_h

namespace sensornoise::browser
{

inline constexpr double MostContrast = 1000.0; ///< largest contrast that a plan proposes [1]
inline constexpr double MostFlickerSd = 0.5;   ///< largest flicker that a plan proposes [1]

/** A burst that is to be recorded. Its grey values are spread evenly between a dark and a bright level. */
struct PlannedBurst
{
  double megapixels{ 1.0 };        ///< pixels of a frame [10^6], above 0
  double frames{ 50.0 };           ///< number of frames, at least 2
  double electrons{ 3000.0 };      ///< electrons of the brightest pixels [e-], above 0
  double contrast{ 10.0 };         ///< ratio of the electrons of the brightest and the darkest pixels [1], above 1
  double flickerSd{ 0.02 };        ///< standard deviation of the illumination factor [1], 0 or more
  double gainDnPerElectron{ 1.0 }; ///< system gain [DN/e-], above 0
  double readNoiseDn{ 3.0 };       ///< read noise [DN], 0 or more
};

/** Smallest errors that an unbiased estimate of the planned burst can have, and the values of the plan that reach the
 * goals: a standard error of 1 % of the gain, and of 1 DN of the offset. Each of these values holds for the other
 * values as planned. */
struct GainPlan
{
  double gainPercent;       ///< standard error of the gain, relative to the gain [%]
  double offsetDn;          ///< standard error of the dark offset [DN]; infinity: it is not identifiable
  double framesForGain;     ///< smallest number of frames for the goal of the gain
  double framesForOffset;   ///< smallest number of frames for the goal of the offset; infinity: no number is enough
  double contrastForGain;   ///< smallest contrast for the goal of the gain [1]; infinity: above MostContrast
  double contrastForOffset; ///< smallest contrast for the goal of the offset [1]; infinity: above MostContrast
  double flickerForOffset;  ///< smallest flicker for the goal of the offset [1]; infinity: above MostFlickerSd
};

/** Computes the plan from ComputePrecisionLimit(), the Cramér-Rao bound in closed form. In it, the variances of gain
 * and offset are inversely proportional to the number of frames less one, and to the number of pixels. The smallest
 * contrast and the smallest flicker are found by bisection. Throws std::invalid_argument for values out of their range.
 */
GainPlan
PlanBurst(const PlannedBurst & burst);

} // namespace sensornoise::browser

#endif
