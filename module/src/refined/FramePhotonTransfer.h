// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_FramePhotonTransfer_h
#define sensornoise_refined_FramePhotonTransfer_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "pixels/GainByParts.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/StaticVariance.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"
#include "scene/StaticScene.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** \class FrameEnergies
 * \brief Mean squared residuals of every frame in each tile of the noise sample, and their expectation by a noise
 * model.
 *
 * With P = I - Q Q' the residuals r = P u of a pixel whose noise has the variance V_s in frame s have
 *
 *     E[r_t^2] = sum_s M_ts V_s,   M = diag(1 - 2 h) + (Q Q') o (Q Q'),
 *
 * where h is the diagonal of Q Q' and o the product of the elements. Rows of M add up to 1 - h. Estimator.md, 3.14. */
class SensorNoise_EXPORT FrameEnergies
{
public:
  /** Makes an object without tiles. */
  FrameEnergies() = default;
  /** Sums over the pixels that have a weight in \a residuals and whose \a take is not 0. A tile without these pixels is
   * left out. */
  FrameEnergies(const NoiseResiduals &            residuals,
                const std::vector<std::uint8_t> & take,
                const ParallelFor &               parallelFor);
  /** Takes given numbers. \a squaresDn2 is tiles x frames [DN^2]; \a signalDn [DN] and \a pixels have a value for each
   * tile. \a basis is the orthonormal Q, frames x series, which includes the constant. */
  FrameEnergies(Eigen::MatrixXd squaresDn2, Eigen::VectorXd signalDn, Eigen::VectorXd pixels, Eigen::MatrixXd basis);

  Eigen::Index
  Tiles() const
  {
    return m_SquaresDn2.rows();
  }
  Eigen::Index
  Frames() const
  {
    return m_SquaresDn2.cols();
  }
  /** Returns the mean squared residuals, tiles x frames [DN^2]. */
  const Eigen::MatrixXd &
  SquaresDn2() const
  {
    return m_SquaresDn2;
  }
  /** Returns the mean signal of each tile's pixels, above the black level of the residuals [DN]. */
  const Eigen::VectorXd &
  SignalDn() const
  {
    return m_SignalDn;
  }
  /** Returns the change of the level of each tile in every frame that the projection removed, tiles x frames [DN];
   * empty if the numbers were given. */
  const Eigen::MatrixXd &
  LevelChangesDn() const
  {
    return m_LevelChangesDn;
  }
  /** Returns the number of pixels in each tile. */
  const Eigen::VectorXd &
  Pixels() const
  {
    return m_Pixels;
  }
  /** Returns M times \a variances, the expected squared residuals; \a variances has a value for each frame [DN^2]. */
  Eigen::VectorXd
  ExpectedSquares(const Eigen::VectorXd & variances) const;
  /** Returns the fraction 1 - h_t of the noise variance that remains in the residuals of each frame, for noise that is
   * the same in all frames [1]. */
  const Eigen::VectorXd &
  RemainingFraction() const
  {
    return m_RemainingFraction;
  }

  /** Returns the quadrant of the sample that contains each tile: 2 for the lower half, plus 1 for the right half. Given
   * numbers count as tiles of each quadrant in turn. */
  const std::vector<std::size_t> &
  Quadrants() const
  {
    return m_Quadrants;
  }

  /** Divides the squared residuals of each frame in all tiles by its factor [1]. */
  void
  DivideBy(const Eigen::VectorXd & factors);

private:
  void
  FillRemainingFraction();

  Eigen::MatrixXd          m_SquaresDn2;
  Eigen::MatrixXd          m_LevelChangesDn;
  Eigen::VectorXd          m_SignalDn;
  Eigen::VectorXd          m_Pixels;
  Eigen::MatrixXd          m_Basis;
  Eigen::VectorXd          m_RemainingFraction;
  std::vector<std::size_t> m_Quadrants;
};

/** \class TileLevels
 * \brief Level of every tile in every frame. */
class SensorNoise_EXPORT TileLevels
{
public:
  /** \a gamma + 1 is the illumination factor of each frame of the stack about the dark offset \a offsetDn [DN]; the
   * sample contains the first of these frames. \a zeroDn is the level from which FrameEnergies measures the signal
   * [DN]. If the illumination changes differently between tiles (\a isLocal), Of(energies, tile) takes the changes
   * that were measured in each tile. */
  TileLevels(const std::vector<double> & gamma, double offsetDn, double zeroDn, bool isLocal = false);

  /** Returns the levels in every frame of a tile whose signal in the mean frame is \a signalDn [DN]. */
  Eigen::VectorXd
  Of(double signalDn) const;
  /** Returns the levels of a \a tile in every frame of \a energies [DN]. */
  Eigen::VectorXd
  Of(const FrameEnergies & energies, Eigen::Index tile) const;

  /** Returns the dark offset about which the illumination factors are given [DN]. */
  double
  OffsetDn() const
  {
    return m_OffsetDn;
  }

private:
  Eigen::VectorXd m_Illumination;
  double          m_OffsetDn;
  double          m_ZeroDn;
  bool            m_IsLocal;
};

/** Returns InRefined.leastWeighedVariance of the mean square of a \a tile [DN^2]. */
double
LeastVarianceDn2(const FrameEnergies & energies, Eigen::Index tile);

/** Returns the variance by \a line at the level of a \a tile in every frame, at least LeastVarianceDn2() [DN^2]. */
SensorNoise_EXPORT Eigen::VectorXd
VariancesOfFrames(const FrameEnergies & energies,
                  const TileLevels &    levels,
                  const VarianceLine &  line,
                  Eigen::Index          tile);

/** Fits the photon transfer line of the frames: the noise variance over the level, from the differences between bright
 * and dark frames at each place. A flat field determines it as well as a scene with contrast, and differences between
 * pixels do not influence it. Estimator.md, 3.14.
 *
 * Each tile gives a slope, and the scatter of the slopes between tiles is the error. Slope and value at the pivot are
 * uncorrelated. \a start gives the initial weights. Returns the line, and the deviations of the frames from it in one
 * bin for each frame.
 *
 * The line is not determined if there are too few tiles or frames, or if all frames have one level. It is not
 * determined either if the frames have two levels, and one of them only in a fifth of the frames or fewer. */
SensorNoise_EXPORT VarianceCurve
FitFramePhotonTransfer(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & start);

/** Returns the group of a frame among the even and the odd frames of each quarter of the \a frames, see PartOf(). */
std::size_t
GroupOfFrame(Eigen::Index frame, Eigen::Index frames);

/** Returns the excess noise of each group of frames in each tile, relative to the line of \a reference at the level.
 * The groups are the even and the odd frames of each quarter of the burst. Estimator.md, 3.15. */
SensorNoise_EXPORT std::vector<TileExcess>
MakeFrameParts(const FrameEnergies & energies, const TileLevels & levels, const PartReference & reference);

/** Returns the noise variance of every frame over its expectation by the noise of the others and its level [1]: 1
 * except for statistical scatter.
 *
 * The ratios are medians over the tiles, so that motion in some of them has no influence. NaN where the projection
 * leaves less than InRefined.leastRemainingFraction of a frame, or where the illumination of a frame is so low that the
 * line does not predict its noise; empty if there are too few tiles. \a slopeError is the standard error of the slope
 * of \a line [DN/e-]; it may be infinite. Among the slopes within Significance.hint of these errors that a sensor may
 * have, the ratio nearest to 1 is taken. \a known has the ratios found before: the projection leaves some of the noise
 * of a frame in the others, which is corrected by them. Default: all are 1. */
SensorNoise_EXPORT Eigen::VectorXd
NoiseOfFrames(const FrameEnergies &   energies,
              const TileLevels &      levels,
              const VarianceLine &    line,
              double                  slopeError,
              const Eigen::VectorXd & known = {});

/** Frames that have the same noise at their level. */
struct FrameGroup
{
  std::vector<std::size_t> frames;
  double                   noise{ 1.0 }; ///< median of NoiseOfFrames() [1]
};

/** Returns "frames 0 to 29, 31, 33, ...": the first of \a frames in words. */
std::string
TextOfFrames(const std::vector<std::size_t> & frames);

/** Gains of single frames, by their squared residuals over the prediction of the line at their level. Estimator.md,
 * 3.15. */
struct SensorNoise_EXPORT GainsOfFrames
{
  /** The frames of either gain, if there are two; else the frames of the lowest and of the highest gain. `noise` is
   * the gain relative to the mean gain [1]. */
  std::vector<FrameGroup> groups;
  bool                    areGroups{ false };  ///< whether there are two gains
  Eigen::VectorXd         excess;              ///< gain of every frame relative to the mean gain, minus 1 [1]
  double                  error{ 0.0 };        ///< standard error of the excess of one frame by chance [1]
  double                  errorOfScale{ 0.0 }; ///< relative error that all excesses have in common [1]
  double                  size{ 0.0 };         ///< rms of the excess, beyond chance [1]
  double                  z{ 0.0 };            ///< significance of the differences, in standard deviations [1]

  /** Returns whether the gains differ by more than InParts.leastDifference, and beyond chance. */
  bool
  Differ() const;
};

/** Compares the gains of single frames. A difference counts as far as quadrants of the sample without a common row or
 * column have it, and as far as it is in proportion to the shot noise of the tiles. \a slopeError is the standard error
 * of the slope of the line of \a reference [DN/e-]. \a known has the excess of every frame that is known already, and
 * is not counted [1]. */
SensorNoise_EXPORT GainsOfFrames
CompareGainsOfFrames(const FrameEnergies &   energies,
                     const TileLevels &      levels,
                     const PartReference &   reference,
                     double                  slopeError,
                     const Eigen::VectorXd & known = {});

/** Returns the excess of the gain of each of \a count frames by the groups of \a parts [1]. */
SensorNoise_EXPORT Eigen::VectorXd
ExcessOfFrames(const PartGains & parts, Eigen::Index count);

/** Frames whose noise at their level differs from the noise of the others: by another gain or another processing. */
struct SensorNoise_EXPORT FrameNoise
{
  /** Indices from 0 of all frames outside the largest group. The difference is larger than a threshold, and
   * significant. */
  std::vector<std::size_t> unlike;
  /** Groups of frames: first the largest, about the densest half of the frames, then the others by increasing noise.
   * One group if all frames agree. */
  std::vector<FrameGroup> groups;
  /** Whether the frames have about one level. If so, the model of their illumination cannot be the cause of the groups.
   */
  bool areFramesEqual{ false };
  /** Root mean square difference from 1, if it exceeds the threshold without groups: the noise varies from frame to
   * frame; else 0 [1]. */
  double scatter{ 0.0 };
  /** Differences of the gains that are too small for groups. Default: none. */
  GainsOfFrames gains;

  /** Returns whether there are several groups, or the noise varies. */
  bool
  HasSeveralGroups() const
  {
    return scatter > 0.0 || groups.size() > 1;
  }
  /** Returns the noise of each of \a frames frames, by its group [1]. */
  Eigen::VectorXd
  OfFrames(Eigen::Index frames) const;
  /** Returns the groups in words: the frames, their noise, and their approximate gain, where the common gain is \a gain
   * [DN/e-]. */
  std::string
  Text(double gain) const;
};

/** Sorts the frames into groups. The largest group is found by the shortest interval that contains half of the frames.
 * It contains all frames that differ from its median by less than the threshold, or not significantly, except frames
 * that are nearer to another group. The other frames are divided where the noise differs by more than the threshold.
 * Estimator.md, 3.14. \a ofFrames is the result of NoiseOfFrames(), \a chance its standard deviation by the number of
 * pixels [1], \a least the threshold, as InRefined.leastUnlikeNoise [1]. */
SensorNoise_EXPORT FrameNoise
GroupFramesByNoise(const Eigen::VectorXd & ofFrames, double chance, double least);

/** Data by which the noise of the frames of the sample is compared. */
struct FrameComparison
{
  const NoiseResiduals &   residuals;
  const ProjectedSquares & squares;
  const StaticScene &      scene;
  TileLevels               levels;
  bool                     isIlluminationLocal{ false }; ///< the illumination changes differently between tiles
  bool                     areLevelsKnown{ true };       ///< the projection removes all changes of the illumination

  /** Returns whether the noise variance differs between frames by as much as counts. */
  bool
  AreUnequal() const
  {
    return scene.changesStrongly || squares.HasUnequalNoise();
  }
};

/** Returns the photon transfer of the frames. It is not determined if the frames are about equal, or if the
 * illumination changes differently between tiles. */
VarianceCurve
LineOfFrames(const StaticVariance & variance, const FrameComparison & by, const ParallelFor & parallelFor);

/** A line and the standard error of its slope. */
struct SlopeOfLine
{
  const VarianceLine & line;
  double               error; ///< [DN/e-]
};

/** Returns the line of frames or pixels with the more precise slope. */
SlopeOfLine
BetterLine(const StaticVariance & variance);

/** Returns whether the scene moves so little that no motion remains in the residuals. */
bool
MovesLittle(const InitialNoiseModel & model);

/** Finds the frames whose noise differs from the noise of the others. If frames of two gains have two levels, the line
 * of the frames fits them all; the line of the pixels then contradicts it. */
FrameNoise
CompareFrames(const StaticVariance &   variance,
              const FrameComparison &  by,
              const NoiseCorrelation & correlation,
              const ParallelFor &      parallelFor);

} // namespace sensornoise

#endif
