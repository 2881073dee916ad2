// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/FilesHash.h"

#include "sensornoise/FrameFile.h"
#include "itkSensorNoiseFrameFiles.h"

#ifdef SENSORNOISE_OPENSSL
#  include <cstddef>
#  include <fstream>
#  include <memory>
#  include <openssl/evp.h>
#  include <stdexcept>
#  include <string>
#  include <vector>
#endif

namespace sensornoise::tools
{
#ifdef SENSORNOISE_OPENSSL
namespace
{
/** Running SHA-256 of the data added so far. */
class Sha256
{
public:
  Sha256() { Require(m_Context != nullptr && EVP_DigestInit_ex(m_Context.get(), EVP_sha256(), nullptr) == 1); }
  void
  Add(const std::string & file)
  {
    std::ifstream stream(file, std::ios::binary);
    while (stream)
    {
      stream.read(m_Buffer.data(), static_cast<std::streamsize>(m_Buffer.size()));
      Require(EVP_DigestUpdate(m_Context.get(), m_Buffer.data(), static_cast<std::size_t>(stream.gcount())) == 1);
    }
    if (!stream.eof() || stream.bad())
    {
      throw FileError(file, "cannot be read to its end for its hash");
    }
  }
  std::string
  HexDigits()
  {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int  size = 0;
    Require(EVP_DigestFinal_ex(m_Context.get(), digest, &size) == 1);
    std::string text;
    for (unsigned int i = 0; i < size; ++i)
    {
      text += "0123456789abcdef"[digest[i] / 16];
      text += "0123456789abcdef"[digest[i] % 16];
    }
    return text;
  }

private:
  static void
  Require(bool isDone)
  {
    if (!isDone)
    {
      throw std::runtime_error("OpenSSL could not compute the SHA-256 of the frames' files; expected a libcrypto that "
                               "knows it");
    }
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> m_Context{ EVP_MD_CTX_new(), &EVP_MD_CTX_free };
  std::vector<char>                                       m_Buffer = std::vector<char>(std::size_t{ 1 } << 20);
};
} // namespace
#endif

bool
HasHash()
{
#ifdef SENSORNOISE_OPENSSL
  return true;
#else
  return false;
#endif
}

InputFiles
HashOf(const FrameList & list)
{
  InputFiles input;
#ifdef SENSORNOISE_OPENSSL
  Sha256 hash;
#endif
  for (const FrameFile & file : list.files)
  {
    for (const FileIdentity & part : file.identities)
    {
      ++input.files;
      input.bytes += part.size;
#ifdef SENSORNOISE_OPENSSL
      hash.Add(part.name);
#endif
    }
    RequireUnchanged(file); // the hash must be of the bytes that were measured
  }
#ifdef SENSORNOISE_OPENSSL
  input.sha256 = hash.HexDigits();
#endif
  return input;
}

} // namespace sensornoise::tools
