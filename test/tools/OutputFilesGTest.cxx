// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#ifndef _WIN32
#  include <unistd.h>

namespace
{
namespace fs = std::filesystem;

/** Tests of the written files: no input is overwritten, no file is written twice, no device is replaced. */
class OutputFilesTool : public EstimateToolTest
{
protected:
  const std::string m_Tool{ "\"" + ToolFolder() + "/estimate-sensor-noise\" --quiet " };
  const std::string m_Simulator{ "\"" + ToolFolder() + "/simulate-sensor-noise\" " };

  /** Expects an error of one sentence that leaves every file unchanged. */
  void
  LeavesAll(const std::string & command, const std::vector<std::string> & parts)
  {
    SCOPED_TRACE(command);
    const auto files = FilesLeft();
    EXPECT_EQ(RunCommand(command), 2);
    EXPECT_EQ(std::count(m_Message.begin(), m_Message.end(), '\n'), 1) << m_Message;
    for (const std::string & part : parts)
    {
      EXPECT_NE(m_Message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << m_Message;
    }
    EXPECT_EQ(FilesLeft(), files);
    EXPECT_EQ(ReadText(Path("s.mha")), m_Stack);
  }
  void
  MakeStack()
  {
    Write("s.mha", MakeBurst().GetPointer());
    m_Stack = ReadText(Path("s.mha"));
  }
  /** Returns a command without the rights of root; empty if there is no way to drop them here. */
  std::string
  Unprivileged()
  {
    const std::string prefix = geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
    fs::permissions(Path(""), fs::perms::all);
    return RunCommand(prefix + m_Tool + "--version && " + prefix + "touch w && rm -f w") == 0 ? prefix + m_Tool : "";
  }

  std::string m_Stack;
};
} // namespace

TEST_F(OutputFilesTool, ReportsNameThatWasForgottenCostsNoFrame)
{
  const std::vector<std::string> frames = WriteList<unsigned short>(MakeBurst(), ".tif");
  MakeStack();
  const std::string first = ReadText(Path(frames[0]));
  LeavesAll(m_Tool + "--json frame_*.tif", { frames[0], "--json", "ending of an image", "forgotten" });
  EXPECT_EQ(ReadText(Path(frames[0])), first);
  for (const std::string name : { "new.TIF", "new.mhd", "new.zraw", "new.png", "new.NRRD" })
  {
    LeavesAll(m_Tool + "--json " + name + " s.mha", { name, "ending of an image" });
    LeavesAll(m_Simulator + "--output new.mha --size 32x32 --frames 3 --truth " + name, { name, "ending of an image" });
  }
}

TEST_F(OutputFilesTool, WhatIsReadIsNotWritten)
{
  MakeStack();
  fs::create_directory(Path("maps"));
  fs::create_hard_link(Path("s.mha"), Path("maps/mean.mha"));
  fs::create_hard_link(Path("s.mha"), Path("hard.json"));
  fs::create_symlink("s.mha", Path("soft.json"));
  fs::create_symlink("soft.json", Path("softer.json"));
  LeavesAll(m_Tool + "s.mha --maps maps", { "maps/mean.mha (--maps)", "same file", "the frame s.mha" });
  for (const std::string name : { "hard.json", "soft.json", "softer.json" })
  {
    LeavesAll(m_Tool + "s.mha --json " + name, { name + " (--json)", "same file", "the frame s.mha" });
  }
  Write("m.mha", Make<itk::Image<unsigned char, 2>>({ { 64, 64 } }, 1).GetPointer());
  fs::create_symlink("m.mha", Path("mask.json"));
  fs::create_symlink("d.mha", Path("dark.json"));
  fs::copy(Path("s.mha"), Path("d.mha"));
  LeavesAll(m_Tool + "s.mha --mask m.mha --json mask.json", { "mask.json", "the mask m.mha" });
  LeavesAll(m_Tool + "s.mha --json dark.json --dark d.mha", { "dark.json", "the dark frame d.mha" });
  fs::copy(Path("d.mha"), Path("maps/pixel_offset.mha"));
  LeavesAll(m_Tool + "d.mha --maps maps --dark maps/pixel_offset.mha", { "maps/pixel_offset.mha (--maps)", "same" });
  LeavesAll(m_Tool + "maps/pixel_offset.mha --maps maps", { "maps/pixel_offset.mha (--maps)", "same" });
}

TEST_F(OutputFilesTool, PixelsOfAHeaderAreNotWritten)
{
  MakeStack();
  const auto burst = MakeBurst();
  for (const std::string name : { "h.mhd", "h.nhdr" })
  {
    Write(name, burst.GetPointer());
    const std::string data = "h.raw";
    fs::create_symlink(data, Path(name + ".json"));
    LeavesAll(m_Tool + name + " --json " + name + ".json", { name + ".json", data, "the pixels of the frame " + name });
  }
}

TEST_F(OutputFilesTool, NoFileIsWrittenTwice)
{
  MakeStack();
  fs::create_directory(Path("maps"));
  fs::create_symlink("maps/mean.mha", Path("r.json"));
  LeavesAll(m_Tool + "s.mha --maps maps --json r.json", { "maps/mean.mha (--maps)", "same file", "r.json (--json)" });
  fs::create_symlink("new.mha", Path("t.json"));
  LeavesAll(m_Simulator + "--output new.mha --truth t.json", { "t.json (--truth)", "same file", "new.mha (--output)" });
  LeavesAll(m_Simulator + "--output s.mha --reference s.mha",
            { "s.mha (--output)", "same file", "the reference s.mha" });
}

TEST_F(OutputFilesTool, LinksStayAndPermissionsAreKept)
{
  MakeStack();
  fs::create_directory(Path("far"));
  WriteText("far/r.json", "old");
  fs::permissions(Path("far/r.json"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("far/r.json", Path("there.json"));
  fs::create_symlink("far/new.json", Path("dangling.json"));
  for (const std::string name : { "there.json", "dangling.json" })
  {
    EXPECT_EQ(RunCommand(m_Tool + "s.mha --json " + name), 0) << m_Message;
    EXPECT_TRUE(fs::is_symlink(Path(name)));
    EXPECT_TRUE(nlohmann::json::accept(ReadText(Path(name))));
  }
  EXPECT_EQ(fs::status(Path("far/r.json")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(FilesLeft(),
            (std::set<std::string>{ "s.mha", "far/r.json", "far/new.json", "there.json", "dangling.json" }));
  EXPECT_EQ(RunCommand("ln -s loop.json loop.json; " + m_Tool + "s.mha --json loop.json; e=$?; rm loop.json; exit $e"),
            2);
  EXPECT_NE(m_Message.find("symbolic links"), std::string::npos) << m_Message;
}

TEST_F(OutputFilesTool, PipesAndDevicesAreWrittenNotReplaced)
{
  MakeStack();
  fs::create_symlink("/dev/null", Path("null.json")); // a tool that replaces it replaces the link only
  EXPECT_EQ(RunCommand(m_Tool + "s.mha --json null.json"), 0) << m_Message;
  EXPECT_TRUE(fs::is_symlink(Path("null.json")) && fs::is_character_file(Path("null.json")));

  EXPECT_EQ(RunCommand("mkfifo pipe && { timeout 5 cat pipe > got & " + m_Tool + "s.mha --json pipe && wait $!; }"), 0);
  EXPECT_TRUE(fs::is_fifo(Path("pipe")));
  EXPECT_TRUE(nlohmann::json::accept(ReadText(Path("got"))));

  // A link of its own, so that a tool that replaces it does not replace the machine's.
  fs::create_symlink("/proc/self/fd/1", Path("out"));
  EXPECT_EQ(RunCommand("echo first > all; " + m_Tool + "s.mha --json out >> all"), 0) << m_Message;
  EXPECT_TRUE(fs::is_symlink(Path("out")));
  EXPECT_EQ(ReadText(Path("all")).rfind("first\n{", 0), 0u);

  fs::create_symlink("/dev/full", Path("full.json"));
  LeavesAll(m_Tool + "s.mha --json full.json 2>&1 | grep error: >&2; exit 2", { "cannot write full.json", "space" });
}

TEST_F(OutputFilesTool, WhatMayNotBeWrittenIsRefusedBeforeTheFramesAreRead)
{
  MakeStack();
  WriteText("r.json", "mine");
  fs::create_directories(Path("maps"));
  WriteText("maps/mean.mha", "mine");
  const std::string tool = Unprivileged();
  if (tool.empty())
  {
    GTEST_SKIP() << "root may write everything, and cannot drop its rights here";
  }
  const auto readable = fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read;
  fs::permissions(Path("r.json"), readable);
  fs::permissions(Path("maps/mean.mha"), readable);
  // neither is an image: the error comes before the reading
  LeavesAll(tool + "r.json --json r.json", { "cannot write r.json", "may not be written", "denied" });
  LeavesAll(tool + "r.json --maps maps", { "cannot write maps/mean.mha" });
  fs::permissions(Path("maps"), readable | fs::perms::owner_exec | fs::perms::others_exec);
  LeavesAll(tool + "r.json --json maps/new.json", { "cannot write maps/new.json", "folder maps", "denied" });
  LeavesAll(tool + "r.json --maps maps/new",
            { "cannot make the folder maps/new (--maps): Permission denied", "folder maps/new" });
  EXPECT_EQ(ReadText(Path("r.json")), "mine");
  fs::permissions(Path("maps"), fs::perms::all);
}

TEST_F(OutputFilesTool, FoldersThatWereMadeInVainGoAgain)
{
  EXPECT_EQ(RunCommand(m_Tool + "nothing.mha --maps new/deeper"), 2);
  EXPECT_FALSE(fs::exists(Path("new")));
  MakeStack();
  EXPECT_EQ(RunCommand(m_Tool + "s.mha --maps new/deeper"), 0) << m_Message;
  EXPECT_TRUE(fs::exists(Path("new/deeper/mean.mha")));
}
#endif
