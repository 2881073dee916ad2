// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/PendingFile.h"

#include "base/FreeMemory.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <random>
#include <sstream>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

/** File descriptor that is closed by the destructor. */
class Descriptor
{
public:
  explicit Descriptor(int number)
    : m_Number(number)
  {}
  Descriptor(const Descriptor &) = delete;
  Descriptor &
  operator=(const Descriptor &) = delete;
  ~Descriptor() { this->Close(); }
  int
  Number() const
  {
    return m_Number;
  }
  /** Closes the file. Returns whether all data were written, which some file systems report only here. */
  bool
  Close()
  {
    const bool isTaken = m_Number < 0 || close(m_Number) == 0;
    m_Number = -1;
    return isTaken;
  }

private:
  int m_Number;
};

/** Returns whether all bytes were written. If not, errno holds the reason. */
bool
WriteAll(int descriptor, const char * bytes, std::size_t count)
{
  while (count > 0)
  {
    const ssize_t taken = write(descriptor, bytes, count);
    if (taken < 0 && errno != EINTR)
    {
      return false;
    }
    bytes += taken > 0 ? taken : 0;
    count -= taken > 0 ? static_cast<std::size_t>(taken) : 0;
  }
  return true;
}

std::string
SystemWords()
{
  return std::generic_category().message(errno);
}

/** Returns a name of random digits. The name of the target with added digits may be too long. */
fs::path
TemporaryName(const fs::path & folder, const fs::path & extension)
{
  std::random_device random;
  std::ostringstream name;
  name << ".sensornoise-" << std::hex << random() << random() << extension.string();
  return folder / name.str();
}
} // namespace

PendingFile::PendingFile(const std::string & target)
  : m_Target(FindTarget(target))
{
  const bool      isReplaced = m_Target.kind == OutputTarget::Kind::File;
  std::error_code noFolder;
  const fs::path  folder = isReplaced ? m_Target.path.parent_path() : fs::temp_directory_path(noFolder);
  m_Temporary = TemporaryName(noFolder ? fs::path("/tmp") : folder, fs::path(target).extension());
  m_AtSignal.emplace(m_Temporary.string());
  const Descriptor file(this->OpenTemporary(O_CREAT | O_EXCL));
  if (file.Number() < 0)
  {
    this->Fail("no file can be made in folder " + m_Temporary.parent_path().string() + ", " + SystemWords());
  }
  struct stat old = {};
  if (isReplaced && stat(m_Target.path.c_str(), &old) == 0)
  {
    [[maybe_unused]] const int ignored = fchmod(file.Number(), old.st_mode & 0777);
  }
}

PendingFile::~PendingFile()
{
  std::error_code ignored;
  fs::remove(m_Temporary, ignored);
}

int
PendingFile::OpenTemporary(int flags) const
{
  return open(m_Temporary.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
}

void
PendingFile::Fail(const std::string & why) const
{
  throw std::runtime_error("cannot write " + m_Target.name + ": " + why);
}

void
PendingFile::Write(const std::string & text) const
{
  Descriptor file(this->OpenTemporary(O_TRUNC));
  if (file.Number() < 0 || !WriteAll(file.Number(), text.data(), text.size()) || !file.Close())
  {
    this->Fail(std::to_string(text.size()) + " bytes were not taken, " + SystemWords());
  }
}

void
PendingFile::RequireRoom(double bytes) const
{
  std::error_code      error;
  const fs::space_info space = fs::space(m_Temporary.parent_path(), error);
  if (!error && bytes > static_cast<double>(space.available))
  {
    this->Fail("it needs " + TextOfBytes(bytes) + ", but " + TextOfBytes(static_cast<double>(space.available)) +
               " are free on the disk");
  }
}

void
PendingFile::RequireBytes(std::uintmax_t bytes) const
{
  std::error_code      error;
  const std::uintmax_t written = fs::file_size(m_Temporary, error);
  if (error || written < bytes)
  {
    this->Fail("the disk may be full");
  }
}

void
PendingFile::CopyToTarget() const
{
  const Descriptor from(open(m_Temporary.c_str(), O_RDONLY | O_CLOEXEC));
  Descriptor       to(m_Target.kind == OutputTarget::Kind::Descriptor
                  ? dup(m_Target.descriptor) // open() would start at the beginning of the file
                  : open(m_Target.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
  if (from.Number() < 0 || to.Number() < 0)
  {
    this->Fail(SystemWords());
  }
  std::array<char, 65536> bytes{};
  for (ssize_t count = 1; count > 0;)
  {
    count = read(from.Number(), bytes.data(), bytes.size());
    if (count < 0 || !WriteAll(to.Number(), bytes.data(), static_cast<std::size_t>(count)))
    {
      this->Fail(SystemWords());
    }
  }
  if (!to.Close())
  {
    this->Fail(SystemWords());
  }
}

void
PendingFile::Commit()
{
  if (m_Target.kind != OutputTarget::Kind::File)
  {
    this->CopyToTarget();
    return;
  }
  std::error_code error;
  fs::rename(m_Temporary, m_Target.path, error);
  if (error)
  {
    this->Fail(error.message());
  }
}

} // namespace sensornoise::tools
