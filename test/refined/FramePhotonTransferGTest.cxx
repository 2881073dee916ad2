// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"
#include "moments/Constants.h"
#include "refined/Constants.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr Eigen::Index Tiles = 24;
constexpr Eigen::Index Frames = 20;
constexpr double       Gain = 0.5;
constexpr double       OffsetDn = 100.0;
constexpr double       InterceptDn2 = 9.0 - Gain * OffsetDn;
constexpr double       ZeroDn = 40.0; // level from which the signal of tiles is measured
constexpr double       PixelsOfTile = 500.0;

/** Returns gamma from -1 to 1. */
std::vector<double>
Gamma()
{
  std::vector<double> gamma;
  for (Eigen::Index t = 0; t < Frames; ++t)
  {
    gamma.push_back(-1.0 + 2.0 * static_cast<double>(t) / static_cast<double>(Frames - 1));
  }
  return gamma;
}

Eigen::MatrixXd
BasisOf(const std::vector<double> & gamma)
{
  Eigen::MatrixXd basis(Frames, 2);
  basis.col(0).setConstant(1.0);
  basis.col(1) = Eigen::Map<const Eigen::VectorXd>(gamma.data(), Frames);
  basis.col(1).array() -= basis.col(1).mean();
  basis.col(0).normalize();
  if (basis.col(1).norm() > 0.0)
  {
    basis.col(1).normalize();
  }
  return basis;
}

/** Returns tiles of slightly different signal. Their squares follow from the line at their levels, times
 * \a factorOf(i, t). */
template <typename TFunction>
FrameEnergies
Energies(const std::vector<double> & gamma, TFunction factorOf)
{
  const TileLevels    levels(gamma, OffsetDn, ZeroDn);
  Eigen::VectorXd     signal(Tiles);
  Eigen::MatrixXd     squares = Eigen::MatrixXd::Zero(Tiles, Frames);
  const FrameEnergies model(squares, Eigen::VectorXd::Zero(Tiles), Eigen::VectorXd::Ones(Tiles), BasisOf(gamma));
  for (Eigen::Index i = 0; i < Tiles; ++i)
  {
    signal(i) = 1000.0 + static_cast<double>(i);
    Eigen::VectorXd variances = InterceptDn2 + Gain * levels.Of(signal(i)).array();
    squares.row(i) = model.ExpectedSquares(variances).transpose();
    for (Eigen::Index t = 0; t < Frames; ++t)
    {
      squares(i, t) *= factorOf(i, t);
    }
  }
  return { squares, signal, Eigen::VectorXd::Constant(Tiles, PixelsOfTile), BasisOf(gamma) };
}

VarianceLine
LineOf(double gain, double intercept)
{
  VarianceLine line;
  line.gain = gain;
  line.intercept = intercept;
  line.pivotDn = 1000.0;
  line.isDetermined = true;
  return line;
}

const auto Exactly = [](Eigen::Index, Eigen::Index) { return 1.0; };
} // namespace

TEST(SensorNoiseFramePhotonTransfer, OfExactSquaresIsTheirLineWhateverItStartsFrom)
{
  const FrameEnergies energies = Energies(Gamma(), Exactly);
  for (const VarianceLine & start : { LineOf(0.5, -41.0), LineOf(-3.0, 500.0), LineOf(40.0, -1e4), LineOf(0.0, 1.0) })
  {
    const VarianceLine line = FitFramePhotonTransfer(energies, { Gamma(), OffsetDn, ZeroDn }, start).line;
    ASSERT_TRUE(line.isDetermined) << start.gain;
    EXPECT_NEAR(line.gain, Gain, 1e-9) << start.gain;
    EXPECT_NEAR(line.intercept, InterceptDn2, 1e-6) << start.gain;
  }
}

TEST(SensorNoiseFramePhotonTransfer, DoesNotDependOnTheOffsetThatIsTakenForThatOfGamma)
{
  // The levels (1 + gamma)(level - offset) + offset of one tile are the same; the levels of the others differ by 2 %.
  const FrameEnergies energies = Energies(Gamma(), Exactly);
  const double        level = 1000.0 + 0.5 * static_cast<double>(Tiles) + ZeroDn;
  std::vector<double> gamma = Gamma();
  for (double & own : gamma)
  {
    own *= (level - OffsetDn) / level; // about an offset of 0
  }
  const VarianceLine line = FitFramePhotonTransfer(energies, { gamma, 0.0, ZeroDn }, LineOf(1.0, 0.0)).line;
  EXPECT_NEAR(line.gain, Gain, 1e-3 * Gain);
}

TEST(SensorNoiseFramePhotonTransfer, IsNotMovedByWhatTilesDifferBy)
{
  // Additional noise of a tile in all frames, as from the read noise of its pixels.
  const FrameEnergies plain = Energies(Gamma(), Exactly);
  Eigen::MatrixXd     squares = plain.SquaresDn2();
  for (Eigen::Index i = 0; i < Tiles; ++i)
  {
    squares.row(i) += 20.0 * static_cast<double>(i) * plain.RemainingFraction().transpose();
  }
  const FrameEnergies uneven(squares, plain.SignalDn(), plain.Pixels(), BasisOf(Gamma()));
  const VarianceLine  line = FitFramePhotonTransfer(uneven, { Gamma(), OffsetDn, ZeroDn }, LineOf(1.0, 0.0)).line;
  EXPECT_NEAR(line.gain, Gain, 1e-9);
}

TEST(SensorNoiseFramePhotonTransfer, IsNotDeterminedByFramesOfOneLevelOrTooFewTiles)
{
  const std::vector<double> steady(static_cast<std::size_t>(Frames), 0.0);
  const FrameEnergies       alike = Energies(steady, Exactly);
  EXPECT_FALSE(FitFramePhotonTransfer(alike, { steady, OffsetDn, ZeroDn }, LineOf(0.5, -41.0)).line.isDetermined);
  EXPECT_FALSE(
    FitFramePhotonTransfer(FrameEnergies(), { Gamma(), OffsetDn, ZeroDn }, LineOf(0.5, -41.0)).line.isDetermined);
}

TEST(SensorNoiseFramePhotonTransfer, IsNotDeterminedByAFifthOfTheFrames)
{
  // Frames of a second level: 4 of 20 may be frames of another gain, 8 of 20 are too many.
  for (const int lit : { 2, 4, 8 })
  {
    std::vector<double> gamma(static_cast<std::size_t>(Frames), 0.0);
    std::fill_n(gamma.begin(), lit, 1.0);
    const VarianceLine line =
      FitFramePhotonTransfer(Energies(gamma, Exactly), { gamma, OffsetDn, ZeroDn }, LineOf(1.0, 0.0)).line;
    EXPECT_EQ(line.isDetermined, lit == 8) << lit;
  }
}

TEST(SensorNoiseFramePhotonTransfer, ErrorsAreThoseOfItsScatter)
{
  constexpr int       draws = 300;
  CounterSeededRandom random(7, 1, 0);
  double              squares = 0.0;
  double              expected = 0.0;
  for (int draw = 0; draw < draws; ++draw)
  {
    // Means of PixelsOfTile squares have the relative standard deviation sqrt(2 / PixelsOfTile).
    const auto energies = Energies(
      Gamma(), [&](Eigen::Index, Eigen::Index) { return 1.0 + std::sqrt(2.0 / PixelsOfTile) * random.Normal(); });
    const auto line = FitFramePhotonTransfer(energies, { Gamma(), OffsetDn, ZeroDn }, LineOf(1.0, 0.0)).line;
    ASSERT_TRUE(line.isDetermined);
    squares += (line.gain - Gain) * (line.gain - Gain);
    expected += line.covariance(0, 0);
  }
  // The ratio of 300 squares to their variance has the standard deviation 8 %. Few tiles add 7 %, and chi-square some.
  EXPECT_NEAR(squares / expected, 0.9, 0.3);
}

TEST(SensorNoiseFramePhotonTransfer, HasTheDeviationsOfTheFramesInTheOrderOfTheirLevels)
{
  // Exact squares have no deviation. A frame with 20 % more noise deviates by 20 %, minus its own influence on the
  // line.
  const std::vector<double> gamma = Gamma();
  constexpr Eigen::Index    noisy = 7;
  const auto                fit = [&](double factor) {
    const auto energies = Energies(gamma, [&](Eigen::Index, Eigen::Index t) { return t == noisy ? factor : 1.0; });
    return FitFramePhotonTransfer(energies, { gamma, OffsetDn, ZeroDn }, LineOf(1.0, 0.0));
  };
  const VarianceCurve exact = fit(1.0);
  ASSERT_EQ(exact.bins.size(), gamma.size());
  std::vector<double> levels;
  for (const CurveBin & bin : exact.bins)
  {
    levels.push_back(exact.LevelOf(bin));
    EXPECT_NEAR(bin.excess / bin.weight, 0.0, 1e-6 * exact.line.At(levels.back()));
  }
  EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
  EXPECT_GT(levels.back(), 1.5 * levels.front());
  const VarianceCurve curve = fit(1.2);
  const auto          place = static_cast<std::size_t>(
    std::count_if(gamma.begin(), gamma.end(), [&](double other) { return other < gamma[noisy]; }));
  for (std::size_t b = 0; b < curve.bins.size(); ++b)
  {
    const double relative = curve.bins[b].excess / curve.bins[b].weight / curve.line.At(curve.LevelOf(curve.bins[b]));
    EXPECT_NEAR(relative, b == place ? 0.18 : 0.0, 0.04) << b;
  }
}

TEST(SensorNoiseFrameNoise, IsOneForAllFramesAndNamesTheOthers)
{
  const TileLevels levels(Gamma(), OffsetDn, ZeroDn);
  const auto       compare = [&](const FrameEnergies & energies) {
    return GroupFramesByNoise(
      NoiseOfFrames(energies, levels, LineOf(Gain, InterceptDn2), 0.0), 0.01, InRefined.leastUnlikeNoise);
  };
  const Eigen::VectorXd plain = NoiseOfFrames(Energies(Gamma(), Exactly), levels, LineOf(Gain, InterceptDn2), 0.0);
  for (Eigen::Index t = 0; t < Frames; ++t)
  {
    EXPECT_NEAR(plain(t), 1.0, 1e-9) << t;
  }
  const auto isOther = [](Eigen::Index t) { return t == 3 || t == 11; };
  const auto found = compare(Energies(Gamma(), [&](Eigen::Index, Eigen::Index t) { return isOther(t) ? 1.5 : 1.0; }));
  EXPECT_EQ(found.unlike, (std::vector<std::size_t>{ 3, 11 }));
  EXPECT_EQ(found.scatter, 0.0);
  // Changes in a few tiles belong to the scene.
  const auto local =
    compare(Energies(Gamma(), [&](Eigen::Index i, Eigen::Index t) { return isOther(t) && i < 8 ? 5.0 : 1.0; }));
  EXPECT_TRUE(local.unlike.empty());
  // A difference below the limit.
  const auto small = compare(Energies(Gamma(), [&](Eigen::Index, Eigen::Index t) { return isOther(t) ? 1.09 : 1.0; }));
  EXPECT_TRUE(small.unlike.empty());
}

TEST(SensorNoiseFrameNoise, OfTwoKindsMakesGroups)
{
  // Two halves differ by 20 %: the value between them is 10 % from each, and no frame has it.
  const TileLevels levels(Gamma(), OffsetDn, ZeroDn);
  const auto       energies = Energies(Gamma(), [](Eigen::Index, Eigen::Index t) { return t % 2 == 0 ? 1.0 : 1.2; });
  const FrameNoise found = GroupFramesByNoise(
    NoiseOfFrames(energies, levels, LineOf(Gain, InterceptDn2), 0.0), 0.01, InRefined.leastUnlikeNoise);
  ASSERT_EQ(found.groups.size(), 2U);
  EXPECT_EQ(found.groups[0].frames.size(), 10U);
  EXPECT_EQ(found.groups[1].frames.size(), 10U);
  EXPECT_NEAR(std::max(found.groups[0].noise, found.groups[1].noise) /
                std::min(found.groups[0].noise, found.groups[1].noise),
              1.2,
              0.05);
  EXPECT_EQ(found.unlike, found.groups[1].frames);
  EXPECT_TRUE(found.HasSeveralGroups());
}

TEST(SensorNoiseFrameNoise, OfGroupsThatOverlapIsOfTheNearerGroup)
{
  // 30 frames of each of two gains that differ by 12 %. Within 10 % of the median of the first gain are 35 frames.
  constexpr Eigen::Index ofGroup = 30;
  Eigen::VectorXd        noise(2 * ofGroup);
  noise << Eigen::VectorXd::LinSpaced(ofGroup, 0.935, 0.945), Eigen::VectorXd::LinSpaced(ofGroup, 1.02, 1.10);
  const FrameNoise found = GroupFramesByNoise(noise, 0.002, InRefined.leastUnlikeNoise);
  ASSERT_EQ(found.groups.size(), 2U);
  EXPECT_EQ(found.groups[0].frames.size(), static_cast<std::size_t>(ofGroup));
  EXPECT_GT(static_cast<double>(found.unlike.size()), InMoments.largestOtherGroup * static_cast<double>(noise.size()));
}

TEST(SensorNoiseFrameNoise, ThatVariesWithoutGroupsIsScatter)
{
  const TileLevels levels(Gamma(), OffsetDn, ZeroDn);
  const auto       energies = Energies(
    Gamma(), [](Eigen::Index, Eigen::Index t) { return std::exp(0.05 * static_cast<double>((7 * t) % Frames - 10)); });
  const FrameNoise found = GroupFramesByNoise(
    NoiseOfFrames(energies, levels, LineOf(Gain, InterceptDn2), 0.0), 0.01, InRefined.leastUnlikeNoise);
  EXPECT_TRUE(found.unlike.empty());
  EXPECT_GT(found.scatter, InRefined.leastUnlikeNoise);
}

TEST(SensorNoiseFrameNoise, ThatVariesMuchInFewFramesIsScatter)
{
  // 15 of 21 frames differ by less than the limit, and no gap separates the others. Rms 12 %.
  Eigen::VectorXd noise = Eigen::VectorXd::LinSpaced(21, 0.91, 1.09);
  noise.head(3) << 0.74, 0.78, 0.83;
  noise.tail(3) << 1.17, 1.22, 1.26;
  const FrameNoise found = GroupFramesByNoise(noise, 0.01, InRefined.leastUnlikeNoise);
  EXPECT_TRUE(found.unlike.empty());
  EXPECT_NEAR(found.scatter, std::sqrt((noise.array() - 1.0).square().mean()), 1e-12);
}

TEST(SensorNoiseFrameNoise, ThatIsKnownIsSubtractedFromTheOthers)
{
  // The projection distributes a part of the noise of a frame over the others.
  const TileLevels   levels(Gamma(), OffsetDn, ZeroDn);
  const VarianceLine line = LineOf(Gain, InterceptDn2);
  Eigen::VectorXd    known = Eigen::VectorXd::Ones(Frames);
  known(1) = 40.0;
  Eigen::MatrixXd       squares(Tiles, Frames);
  Eigen::VectorXd       signal(Tiles);
  const Eigen::VectorXd ofTile = Eigen::VectorXd::Constant(Tiles, PixelsOfTile);
  const FrameEnergies   model(squares, signal, ofTile, BasisOf(Gamma()));
  for (Eigen::Index i = 0; i < Tiles; ++i)
  {
    signal(i) = 1000.0 + static_cast<double>(i);
    const Eigen::VectorXd variances = InterceptDn2 + Gain * levels.Of(signal(i)).array();
    squares.row(i) = model.ExpectedSquares(variances.cwiseProduct(known)).transpose();
  }
  const FrameEnergies   energies(squares, signal, ofTile, BasisOf(Gamma()));
  const Eigen::VectorXd first = NoiseOfFrames(energies, levels, line, 0.0);
  EXPECT_GT((first - known).tail(Frames - 2).cwiseAbs().maxCoeff(), 0.1);
  const Eigen::VectorXd second = NoiseOfFrames(energies, levels, line, 0.0, known);
  EXPECT_LT((second - known).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SensorNoiseFrameNoise, NamesGroupsInWords)
{
  FrameNoise noise;
  noise.groups = { { { 0, 1, 2, 5 }, 0.8 }, { { 3 }, 1.6 } };
  EXPECT_EQ(noise.Text(0.5), "frames 0 to 2, 5: 0.8 times, about 0.4 DN/e-; frame 3: 1.6 times, about 0.8 DN/e-");
}

TEST(SensorNoiseFrameNoise, IsWithinTheErrorOfTheSlope)
{
  // With a slope that is wrong by its standard error no frame is left out. Frames without a prediction are not numbers.
  const auto largest = [](const Eigen::VectorXd & noise) {
    return noise.array().isFinite().select((noise.array() - 1.0).abs(), 0.0).maxCoeff();
  };
  const TileLevels    levels(Gamma(), OffsetDn, ZeroDn);
  const FrameEnergies energies = Energies(Gamma(), Exactly);
  VarianceLine        line = LineOf(2.0 * Gain, 0.0);
  line.intercept = InterceptDn2 + Gain * line.pivotDn - line.gain * line.pivotDn;
  const Eigen::VectorXd sure = NoiseOfFrames(energies, levels, line, 0.0);
  EXPECT_GT(largest(sure), 0.3);
  const Eigen::VectorXd unsure = NoiseOfFrames(energies, levels, line, Gain);
  EXPECT_LT(largest(unsure), 1e-9);
}

TEST(SensorNoiseFrameNoise, OfALineWithoutSlopeIsTestedBySlopesOfSensors)
{
  // Frames of different levels are then not compared; frames of one level are, with any slope.
  VarianceLine line = LineOf(0.5 * Gain, 0.0);
  line.intercept = InterceptDn2 + Gain * line.pivotDn - line.gain * line.pivotDn;
  const double          unknown = std::numeric_limits<double>::infinity();
  const TileLevels      levels(Gamma(), OffsetDn, ZeroDn);
  const Eigen::VectorXd plain = NoiseOfFrames(Energies(Gamma(), Exactly), levels, line, unknown);
  EXPECT_LT((plain.array() - 1.0).abs().maxCoeff(), 1e-9);
  const std::vector<double> steady(Frames, 0.0);
  const auto            energies = Energies(steady, [](Eigen::Index, Eigen::Index t) { return t == 4 ? 1.5 : 1.0; });
  const Eigen::VectorXd other = NoiseOfFrames(energies, { steady, OffsetDn, ZeroDn }, line, unknown);
  EXPECT_NEAR(other(4), 1.5, 1e-9);
}
