// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/NrrdGeometry.h"

#include "files/TextHeader.h"
#include "files/UsableGeometry.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace sensornoise
{
namespace
{
/** A number, or NaN where the header says that it is not known. */
std::optional<double>
NumberOrNaN(const std::string & word)
{
  return WithoutBlanks(InSmallLetters(word)) == "nan" ? std::numeric_limits<double>::quiet_NaN()
                                                      : FiniteNumber(WithoutBlanks(word));
}

/** The numbers of "(1,0,0)". Throws where they are not \a count. */
std::vector<double>
VectorIn(const std::string & file, const std::string & text, std::size_t count)
{
  std::vector<double> numbers;
  const bool          isVector = text.size() > 2 && text.front() == '(' && text.back() == ')';
  for (std::size_t begin = 1; isVector && begin < text.size();)
  {
    const std::size_t           end = text.find_first_of(",)", begin);
    const std::optional<double> number = NumberOrNaN(text.substr(begin, end - begin));
    numbers.push_back(number.value_or(0.0));
    if (!number)
    {
      numbers.clear();
      break;
    }
    begin = end + 1;
  }
  if (numbers.size() != count)
  {
    throw FileError(file,
                    "its header gives \"" + text +
                      "\" for a position or direction; expected numbers in brackets: " + std::to_string(count));
  }
  return numbers;
}

/** Returns the vectors of a field, one for each axis. The vector of an axis outside of space is empty. */
std::vector<std::vector<double>>
VectorsIn(const std::string & file, const std::string & text, std::size_t count)
{
  std::vector<std::vector<double>> vectors;
  for (std::size_t at = text.find_first_not_of(" \t"); at != std::string::npos;)
  {
    const bool        isNone = InSmallLetters(text.substr(at, 4)) == "none";
    const std::size_t close = isNone ? at + 3 : std::min(text.find(')', at), text.size() - 1);
    vectors.push_back(isNone ? std::vector<double>() : VectorIn(file, text.substr(at, close + 1 - at), count));
    at = text.find_first_not_of(" \t", close + 1);
  }
  if (vectors.size() != count)
  {
    throw FileError(file,
                    "space directions: " + std::to_string(vectors.size()) + ", but its dimension is " +
                      std::to_string(count) + "; expected as many");
  }
  return vectors;
}

/** The signs by which coordinates of a space become those of ITK; as many as the space has axes, 0 without a space. */
std::vector<double>
SignsOfSpace(const std::string & file, const NrrdHeader & header)
{
  const std::string dimension = WithoutBlanks(header.Field("space dimension"));
  if (!dimension.empty())
  {
    const std::optional<std::uint64_t> axes = WholeNumber(dimension);
    if (!axes || *axes == 0 || *axes > 8) // NRRD_SPACE_DIM_MAX
    {
      throw FileError(file, "space dimension is " + dimension + "; expected 1 to 8");
    }
    return std::vector<double>(static_cast<std::size_t>(*axes), 1.0);
  }
  const std::string space = WithoutBlanks(InSmallLetters(header.Field("space")));
  if (space.empty())
  {
    return {};
  }
  static const std::map<std::string, std::vector<double>> known{ { "right-anterior-superior", { -1.0, -1.0, 1.0 } },
                                                                 { "ras", { -1.0, -1.0, 1.0 } },
                                                                 { "left-anterior-superior", { -1.0, 1.0, 1.0 } },
                                                                 { "las", { -1.0, 1.0, 1.0 } } };
  const auto                                              found = known.find(space);
  const std::size_t time = space.size() > 5 && space.rfind("-time") == space.size() - 5 ? 1 : 0;
  return found != known.end() ? found->second : std::vector<double>(3 + time, 1.0);
}

void
SetSpacings(const std::string & file, const std::string & text, std::size_t axes, StackGeometry & geometry)
{
  const std::vector<std::string> words = WordsOf(text);
  for (std::size_t axis = 0; axis < words.size(); ++axis)
  {
    const std::optional<double> spacing = NumberOrNaN(words[axis]);
    if (!spacing || words.size() != axes)
    {
      throw FileError(file, "spacings are " + text + "; expected numbers: " + std::to_string(axes));
    }
    geometry.spacing[axis] = *spacing;
  }
}
} // namespace

StackGeometry
GeometryOfNrrd(const std::string & file, const NrrdHeader & header, std::size_t axes)
{
  StackGeometry             geometry;
  const std::vector<double> signs = SignsOfSpace(file, header);
  if (!header.Field("spacings").empty())
  {
    SetSpacings(file, header.Field("spacings"), axes, geometry);
  }
  const std::string directions = header.Field("space directions");
  const std::string origin = WithoutBlanks(header.Field("space origin"));
  if (signs.size() != axes)
  {
    return UsableGeometry(geometry);
  }
  const auto vectors = directions.empty() ? std::vector<std::vector<double>>(axes) : VectorsIn(file, directions, axes);
  const auto place = origin.empty() ? std::vector<double>(axes, 0.0) : VectorIn(file, origin, axes);
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    double length = 0.0;
    for (const double part : vectors[axis])
    {
      length += part * part;
    }
    length = std::sqrt(length);
    geometry.origin[axis] = signs[axis] * place[axis];
    if (length > 0.0)
    {
      geometry.spacing[axis] = length;
      for (std::size_t row = 0; row < axes; ++row)
      {
        geometry.direction[row][axis] = signs[row] * (1.0 / length) * vectors[axis][row]; // the same last bit as in ITK
      }
    }
  }
  return UsableGeometry(geometry);
}

} // namespace sensornoise
