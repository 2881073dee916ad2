// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"
#include "helpers/CheckoutTestHelper.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

void
EstimateToolTest::SetUp()
{
  const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  // two builds may be tested at the same time
  m_Folder =
    std::filesystem::path(::testing::TempDir()) / ("EstimateTool" + test + std::to_string(std::random_device{}()));
  std::filesystem::create_directories(m_Folder / "work");
}

void
EstimateToolTest::TearDown()
{
  std::filesystem::remove_all(m_Folder);
}

int
EstimateToolTest::RunCommand(const std::string & command)
{
  const std::string line = "cd \"" + Path("").string() + "\" && { " + command + " ; } > ../stdout.txt 2> ../stderr.txt";
  const int         status = std::system(line.c_str());
  m_Output = ReadText(m_Folder / "stdout.txt");
  m_Message = ReadText(m_Folder / "stderr.txt");
#ifdef _WIN32
  return status;
#else
  return status >> 8; // wait status: the exit code is its second byte, and a signal leaves 0 there
#endif
}

int
EstimateToolTest::Run(const std::string & arguments)
{
  return RunCommand("\"" + ToolFolder() + "/estimate-sensor-noise\" " + arguments);
}

std::string
EstimateToolTest::JsonTextOf(const std::string & arguments, int exitCode)
{
  SCOPED_TRACE(arguments);
  EXPECT_EQ(Run(arguments + " --quiet --json -"), exitCode) << m_Message;
  return m_Output;
}

std::string
EstimateToolTest::MeasuredTextOf(const std::string & arguments)
{
  std::string       text = JsonTextOf(arguments);
  const std::size_t begin = text.find("\"settings\": {");
  const std::size_t end = text.find('}', begin);
  EXPECT_NE(end, std::string::npos) << text;
  return end == std::string::npos ? text : text.erase(begin, end - begin);
}

nlohmann::json
EstimateToolTest::ReportOf(const std::string & arguments, int exitCode)
{
  const std::string text = JsonTextOf(arguments, exitCode);
  EXPECT_TRUE(nlohmann::json::accept(text)) << text;
  return nlohmann::json::parse(text, nullptr, false);
}

EstimateToolTest::StackType::Pointer
EstimateToolTest::MakeBurst(unsigned int frames, const std::string & size)
{
  EXPECT_EQ(RunCommand("\"" + ToolFolder() +
                       "/simulate-sensor-noise\" --output ../burst.mha --seed 3 --flicker-sd 0.1 --size " + size +
                       " --frames " + std::to_string(frames)),
            0)
    << m_Message;
  return Read<StackType>(m_Folder / "burst.mha");
}

std::string
EstimateToolTest::WriteText(const std::string & name, const std::string & text) const
{
  std::ofstream(Path(name), std::ios::binary) << text;
  return name;
}

std::string
EstimateToolTest::Joined(const std::vector<std::string> & names)
{
  std::string text;
  for (const std::string & name : names)
  {
    text += name + " ";
  }
  return text;
}

std::string
EstimateToolTest::ReadText(const std::filesystem::path & name)
{
  std::ifstream file(name, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

std::set<std::string>
EstimateToolTest::FilesLeft() const
{
  std::set<std::string> names;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(Path("")))
  {
    if (!entry.is_directory())
    {
      names.insert(entry.path().lexically_relative(Path("")).string());
    }
  }
  return names;
}

void
EstimateToolTest::SaysInOneSentence(const std::vector<std::string> & parts) const
{
  std::istringstream lines(m_Message);
  std::string        sentence;
  for (std::string line; std::getline(lines, line);)
  {
    if (line.rfind("warning: ", 0) != 0 && line.rfind("note: ", 0) != 0)
    {
      EXPECT_EQ(line.rfind("error: ", 0), 0u) << m_Message;
      EXPECT_TRUE(sentence.empty() || line.back() == ']') << m_Message;
      sentence = sentence.empty() ? line : sentence;
    }
  }
  for (const std::string & part : parts)
  {
    EXPECT_NE(sentence.find(part), std::string::npos) << "\"" << part << "\" is not in: " << m_Message;
  }
}

void
EstimateToolTest::IsRefused(const std::string & arguments, const std::vector<std::string> & parts)
{
  SCOPED_TRACE(arguments);
  const std::set<std::string> before = FilesLeft();
  EXPECT_EQ(Run(arguments + " --json refused.json --maps refused"), 2) << m_Message;
  SaysInOneSentence(parts);
  EXPECT_EQ(std::count(m_Message.begin(), m_Message.end(), '\n'), 1) << m_Message;
  EXPECT_EQ(m_Output, "");
  EXPECT_EQ(FilesLeft(), before);
}

void
EstimateToolTest::GivesNoEstimate(const std::string & arguments, const std::vector<std::string> & parts)
{
  SCOPED_TRACE(arguments);
  const nlohmann::json report = ReportOf(arguments, 3);
  SaysInOneSentence(parts);
  for (const char * name : { "gain", "offset", "read_noise", "read_noise_electrons", "intercept", "total_intercept" })
  {
    EXPECT_TRUE(report[name]["value"].is_null()) << name;
    EXPECT_NE(report[name]["status"], "identified") << name;
  }
  EXPECT_FALSE(report["warnings"].empty());
}
