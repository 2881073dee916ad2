// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#ifndef _WIN32
#  include <sys/resource.h>
#  include <sys/wait.h>
#  include <unistd.h>

namespace
{
namespace fs = std::filesystem;

/** A tool that ends before its work is done leaves nothing behind. */
class OutputSignalsTool : public EstimateToolTest
{
protected:
  /** Starts a tool in the folder, with every signal at its default. */
  pid_t
  Start(const std::string & tool, const std::vector<std::string> & arguments) const
  {
    const std::string   program = ToolFolder() + "/" + tool;
    std::vector<char *> words{ const_cast<char *>(program.c_str()) };
    for (const std::string & word : arguments)
    {
      words.push_back(const_cast<char *>(word.c_str()));
    }
    words.push_back(nullptr);
    const std::string folder = Path("").string();
    const pid_t       child = fork();
    if (child == 0)
    {
      const struct rlimit noCore = {};
      setrlimit(RLIMIT_CORE, &noCore);
      for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ, SIGABRT })
      {
        std::signal(signal, SIG_DFL);
      }
      if (chdir(folder.c_str()) == 0)
      {
        execv(words[0], words.data());
      }
      _exit(127);
    }
    return child;
  }
  /** Returns whether, within ten seconds, a file of an unfinished output is there. */
  bool
  HasBegun() const
  {
    for (int i = 0; i < 10000; ++i)
    {
      for (const std::string & name : FilesLeft())
      {
        if (fs::path(name).filename().string()[0] == '.')
        {
          return true;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  static int
  StatusOf(pid_t child)
  {
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }
};
} // namespace

TEST_F(OutputSignalsTool, SignalLeavesNoFileAndEndsTheToolAsItWould)
{
  Write("s.mha", MakeBurst(60, "256x256").GetPointer());
  for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ, SIGABRT })
  {
    SCOPED_TRACE(strsignal(signal));
    for (const auto & command :
         { std::vector<std::string>{ "estimate-sensor-noise", "s.mha", "--json", "r.json", "--maps", "maps/new" },
           std::vector<std::string>{
             "simulate-sensor-noise", "--output", "o.mha", "--truth", "t.json", "--frames", "9999" } })
    {
      const pid_t child = Start(command[0], { command.begin() + 1, command.end() });
      EXPECT_TRUE(HasBegun());
      kill(child, signal);
      const int status = StatusOf(child);
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << command[0] << " ended with " << status;
      EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha" }));
      EXPECT_FALSE(fs::exists(Path("maps")));
    }
  }
}

TEST_F(OutputSignalsTool, SignalThatIsIgnoredStaysIgnored)
{
  Write("s.mha", MakeBurst().GetPointer());
  EXPECT_EQ(RunCommand("trap '' HUP; \"" + ToolFolder() +
                       "/estimate-sensor-noise\" s.mha --quiet --json r.json & "
                       "sleep 0.02; kill -HUP $!; wait $!"),
            0)
    << m_Message;
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha", "r.json" }));
}

TEST_F(OutputSignalsTool, FileThatMayNotGrowLeavesNothing)
{
  EXPECT_NE(RunCommand("ulimit -c 0; ulimit -f 16; \"" + ToolFolder() +
                       "/simulate-sensor-noise\" --output o.mha --truth t.json --frames 3"),
            0);
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{}));
}

TEST_F(OutputSignalsTool, TableThatNobodyReadsLeavesTheReport)
{
  Write("s.mha", MakeBurst().GetPointer());
  RunCommand("\"" + ToolFolder() + "/estimate-sensor-noise\" s.mha --json r.json | true");
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "s.mha", "r.json" }));
  EXPECT_TRUE(nlohmann::json::accept(ReadText(Path("r.json"))));
}
#endif
