// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameSums.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "series/FrameRegressors.h"
#include "helpers/FrameTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 70;
constexpr std::size_t Height = 45;

/** Returns 70 frames with noise and changes. */
const SyntheticFrames &
Frames()
{
  static const SyntheticFrames frames(Width, Height, FlickerAndMotion(70, 100.0, 0.1), 1.0);
  return frames;
}

void
ExpectSameBits(const FrameSums & a, const FrameSums & b)
{
  const auto saved = [](const FrameSums & sums) {
    std::ostringstream out;
    sums.Save(out);
    return out.str();
  };
  EXPECT_EQ(saved(a), saved(b));
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    EXPECT_EQ(a.GetClassGram(c), b.GetClassGram(c)) << c;
  }
  EXPECT_EQ(a.GetInstrumentGram(), b.GetInstrumentGram());
  ASSERT_EQ(a.GetCells().size(), b.GetCells().size());
  for (std::size_t c = 0; c < a.GetCells().size(); ++c)
  {
    EXPECT_EQ(a.GetCells()[c].sum, b.GetCells()[c].sum) << c;
    EXPECT_EQ(a.GetCells()[c].sumI, b.GetCells()[c].sumI) << c;
  }
}

/** Returns the sums over the frames t with t % parts == part. */
FrameSums
PartOf(std::size_t part, std::size_t parts)
{
  FrameSums sums = Frames().EmptySums();
  for (std::size_t t = part; t < Frames().Frames(); t += parts)
  {
    sums.AddFrames(Frames().Frame(t), t, 1, SerialFor);
  }
  return sums;
}
} // namespace

TEST(SensorNoiseFrameSums, ClassSumsEqualBruteForce)
{
  const FrameSums sums = Frames().Sums();
  for (const std::size_t t : { std::size_t{ 0 }, std::size_t{ 66 } })
  {
    std::vector<Eigen::VectorXd> sum(GradientClasses, Eigen::VectorXd::Zero(FrameColumns));
    std::vector<Eigen::VectorXd> size(GradientClasses, Eigen::VectorXd::Zero(FrameColumns));
    for (std::size_t p = 0; p < Frames().Pixels(); ++p)
    {
      if (Frames().take[p] != 0)
      {
        const double          deviation = Frames().Frame(t)[p] - Frames().reference.mean[p];
        const Eigen::VectorXd term = Frames().Weight(p) * deviation * Frames().ColumnsOf(p);
        sum[sums.GetRegressors().ClassOf(p)] += term;
        size[sums.GetRegressors().ClassOf(p)] += term.cwiseAbs();
      }
    }
    for (std::size_t c = 0; c < GradientClasses; ++c)
    {
      EXPECT_TRUE(((sums.GetClassSums(t, c) - sum[c]).array().abs() <= RoundingOfSums * size[c].array()).all())
        << t << ' ' << c;
    }
  }
}

TEST(SensorNoiseFrameSums, ClassGramsEqualBruteForce)
{
  FrameSums sums = Frames().EmptySums();
  sums.EndFrames(SerialFor);
  std::vector<Eigen::MatrixXd> gram(GradientClasses, Eigen::MatrixXd::Zero(FrameColumns, FrameColumns));
  std::vector<std::size_t>     count(GradientClasses, 0);
  for (std::size_t p = 0; p < Frames().Pixels(); ++p)
  {
    ASSERT_EQ(sums.GetRegressors().ClassOf(p) == FrameRegressors::Unused, Frames().take[p] == 0) << p;
    if (Frames().take[p] != 0)
    {
      const auto columns = Frames().ColumnsOf(p);
      gram[sums.GetRegressors().ClassOf(p)] += Frames().Weight(p) * columns * columns.transpose();
      ++count[sums.GetRegressors().ClassOf(p)];
    }
  }
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    const Eigen::VectorXd unit = gram[c].diagonal().cwiseSqrt();
    const Eigen::MatrixXd error = (sums.GetClassGram(c) - gram[c]).cwiseQuotient(unit * unit.transpose());
    EXPECT_LT(error.cwiseAbs().maxCoeff(), RoundingOfProducts) << c;
    EXPECT_GT(count[c], 0u) << c;
  }
}

TEST(SensorNoiseFrameSums, InstrumentsEqualBruteForce)
{
  const FrameSums       sums = Frames().Sums();
  constexpr std::size_t t = 3;
  Eigen::Vector2d       sum = Eigen::Vector2d::Zero();
  Eigen::Vector2d       size = Eigen::Vector2d::Zero();
  Eigen::MatrixXd       gram = Eigen::MatrixXd::Zero(2, FrameColumns);
  for (std::size_t p = 0; p < Frames().Pixels(); ++p)
  {
    if (Frames().take[p] != 0)
    {
      const ShiftInstruments & own = sums.GetRegressors().GetInstruments();
      const Eigen::Vector2d    instruments(double{ own.x[p] } * own.weight[p], double{ own.y[p] } * own.weight[p]);
      const Eigen::Vector2d    term = (Frames().Frame(t)[p] - Frames().reference.mean[p]) * instruments;
      sum += term;
      size += term.cwiseAbs();
      gram += instruments * Frames().ColumnsOf(p).transpose();
    }
  }
  EXPECT_NEAR(sums.GetInstrumentSums(t)[0], sum(0), RoundingOfSums * size(0));
  EXPECT_NEAR(sums.GetInstrumentSums(t)[1], sum(1), RoundingOfSums * size(1));
  EXPECT_LT((sums.GetInstrumentGram() - gram).norm(), RoundingOfProducts * gram.norm());
}

TEST(SensorNoiseFrameSums, CellsPartTheWholeFrame)
{
  // The model has no motion, so that the weights of the tiles are the weights of the classes.
  const FrameSums sums = Frames().Sums();
  ASSERT_GT(sums.GetCells().size(), 1u);
  FrameSums::ClassMatrix gram = FrameSums::ClassMatrix::Zero();
  Eigen::VectorXd        frame = Eigen::VectorXd::Zero(FrameColumns);
  constexpr std::size_t  t = 69;
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    gram += sums.GetClassGram(c);
    frame += sums.GetClassSums(t, c);
  }
  FrameSums::Cell whole;
  double          cellSums[2] = { 0.0, 0.0 };
  for (std::size_t c = 0; c < sums.GetCells().size(); ++c)
  {
    const FrameSums::Cell & cell = sums.GetCells()[c];
    whole.pixels += cell.pixels;
    for (std::size_t k = 0; k < FrameColumns; ++k)
    {
      whole.sum[k] += cell.sum[k];
      whole.sumI[k] += cell.sumI[k];
    }
    cellSums[0] += sums.GetCellSums(t, c)[0];
    cellSums[1] += sums.GetCellSums(t, c)[1];
  }
  EXPECT_EQ(whole.pixels, (Width - 4) * (Height - 4));
  const auto near = [&](double value, double expected, Eigen::Index i, Eigen::Index j) {
    EXPECT_NEAR(value, expected, RoundingOfProducts * std::sqrt(gram(i, i) * gram(j, j))) << i << ' ' << j;
  };
  for (std::size_t k = 0; k < FrameColumns; ++k)
  {
    const auto column = static_cast<Eigen::Index>(k);
    near(whole.sum[k], gram(0, column), 0, column);
    near(whole.sumI[k], gram(1, column), 1, column);
  }
  EXPECT_NEAR(cellSums[0], frame(0), 1e-10 * std::sqrt(gram(0, 0)));
  EXPECT_NEAR(cellSums[1], frame(1), 1e-10 * std::sqrt(gram(1, 1)));
}

TEST(SensorNoiseFrameSums, RougherClassesHaveLargerGradients)
{
  FrameSums sums = Frames().EmptySums();
  sums.EndFrames(SerialFor);
  std::vector<double> energy; // mean of w (x^2 + y^2)
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    const auto gram = sums.GetClassGram(c);
    double     pixels = 0.0;
    for (std::size_t p = 0; p < Frames().Pixels(); ++p)
    {
      pixels += sums.GetRegressors().ClassOf(p) == c ? 1.0 : 0.0;
    }
    energy.push_back((gram(2, 2) + gram(3, 3)) / pixels);
    EXPECT_TRUE(c == 0 || energy[c] > energy[c - 1]) << c;
  }
}

TEST(SensorNoiseFrameSums, ChunksAndThreadsChangeNoBit)
{
  const FrameSums expected = Frames().Sums();
  for (const std::size_t threads : { 2, 7 })
  {
    FrameSums sums = Frames().EmptySums(Threads(threads));
    for (std::size_t t = 0; t < Frames().Frames(); t += threads)
    {
      sums.AddFrames(Frames().Frame(t), t, std::min(threads, Frames().Frames() - t), Threads(threads));
    }
    ExpectSameBits(sums, expected);
  }
}

TEST(SensorNoiseFrameSums, ManyFramesAreAddedInBatchesWithTheSameBits)
{
  constexpr std::size_t count = 700; // 64 rows of tiles: a batch has 170 frames
  const SyntheticFrames frames(16, 512, FlickerAndMotion(count, 100.0, 0.1), 1.0);
  FrameSums             inParts = frames.EmptySums();
  for (std::size_t t = 0; t < count; t += 300)
  {
    inParts.AddFrames(frames.Frame(t), t, std::min<std::size_t>(300, count - t), SerialFor);
  }
  FrameSums atOnce = frames.EmptySums();
  atOnce.AddFrames(frames.Frame(0), 0, count, Threads(2));
  ExpectSameBits(atOnce, inParts);
}

TEST(SensorNoiseFrameSums, MergedPartsHaveTheWholesBits)
{
  const FrameSums   expected = Frames().Sums();
  FrameSums         merged = PartOf(2, 3);
  std::stringstream stream;
  PartOf(0, 3).Save(stream);
  FrameSums restored = Frames().EmptySums();
  restored.Restore(stream);
  restored.EndFrames(Threads(2));
  ExpectSameBits(restored, PartOf(0, 3));
  merged.Merge(restored.GetProducts());
  merged.Merge(PartOf(1, 3).GetProducts());
  ExpectSameBits(merged, expected);
  FrameSums none = Frames().EmptySums(); // a process that adds no frame
  none.Merge(expected.GetProducts());
  none.EndFrames(SerialFor);
  ExpectSameBits(none, expected);
}

TEST(SensorNoiseFrameSums, MergeRefusesOtherFrames)
{
  FrameSums             sums = Frames().EmptySums();
  const SyntheticFrames fewer(Width, Height, FlickerAndMotion(7, 100.0, 0.1));
  const SyntheticFrames wider(Width + 1, Height, FlickerAndMotion(70, 100.0, 0.1));
  EXPECT_THROW(sums.Merge(fewer.EmptySums().GetProducts()), std::invalid_argument);
  EXPECT_THROW(sums.Merge(wider.EmptySums().GetProducts()), std::invalid_argument);
}
