// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSensorNoiseStackSink.h"
#include "itkImage.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace
{
using Stack = itk::Image<unsigned short, 3>;
constexpr std::size_t Tasks = 100;

/** Two passes of two rounds of work, which takes as long as threads that sleep. */
class SlowSink : public itk::SensorNoiseStackSink<Stack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SlowSink);
  using Self = SlowSink;
  using Pointer = itk::SmartPointer<Self>;
  itkFactorylessNewMacro(Self);

  std::atomic<std::size_t> done{ 0 };

protected:
  SlowSink() { this->SetNthOutput(0, FrameImageType::New()); }
  ~SlowSink() override = default;

  void
  GenerateOutputInformation() override
  {
    this->CopyFrameInformation(static_cast<FrameImageType *>(this->GetOutput(0)));
  }
  unsigned int
  NumberOfPasses() const override
  {
    return 2;
  }
  void
  StartPasses() override
  {}
  void
  ProcessFrames(unsigned int, const unsigned short *, itk::SizeValueType, itk::SizeValueType) override
  {
    for (int round = 0; round < 2; ++round)
    {
      this->GetParallelFor()(Tasks, [this](std::size_t) {
        std::this_thread::sleep_for(std::chrono::milliseconds(4));
        ++done;
      });
    }
  }
  void
  EndPass(unsigned int) override
  {}
};

SlowSink::Pointer
MakeSink()
{
  const auto stack = Stack::New();
  stack->SetRegions(Stack::SizeType{ { 4, 4, 3 } });
  stack->Allocate();
  stack->FillBuffer(7);
  const auto sink = SlowSink::New();
  sink->SetInput(stack);
  sink->SetNumberOfWorkUnits(2);
  return sink;
}
} // namespace

TEST(SensorNoiseStackSink, ProgressGrowsWhileTheThreadsWork)
{
  const auto         sink = MakeSink();
  std::vector<float> progress;
  sink->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) { progress.push_back(sink->GetProgress()); });
  sink->Update();
  EXPECT_EQ(sink->done, 4 * Tasks);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_EQ(progress.back(), 1.0F);
  for (const float from : { 0.01F, 0.26F, 0.51F, 0.76F }) // each round of work
  {
    EXPECT_GE(std::count_if(progress.begin(), progress.end(), [from](float p) { return p > from && p < from + 0.11F; }),
              1)
      << from;
  }
}

TEST(SensorNoiseStackSink, AnAbortEndsTheWorkThatTheThreadsAreAt)
{
  const auto sink = MakeSink();
  sink->AddObserver(itk::ProgressEvent(),
                    [&](const itk::EventObject &) { sink->SetAbortGenerateData(sink->GetProgress() > 0.05F); });
  EXPECT_THROW(sink->Update(), itk::ProcessAborted);
  EXPECT_GT(sink->done, 0U);
  EXPECT_LT(sink->done, Tasks);
}
