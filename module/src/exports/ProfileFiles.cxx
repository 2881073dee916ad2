// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "exports/NoiseProfile.h"

#include "base/Text.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
using Pairs = std::vector<std::pair<double, double>>;

/** Returns the profile of one pair for all channels, or of the planes R, G and B. */
NoiseProfile
ProfileOfPairs(const Pairs & pairs)
{
  if (pairs.size() != 1 && pairs.size() != 3)
  {
    throw ExportError("there are " + std::to_string(pairs.size()) +
                      " pairs of scale and offset; expected one, or three for the planes R, G and B");
  }
  NoiseProfile profile;
  profile.format = "dng";
  profile.form = ProfileForm::Normalised;
  const std::vector<std::string> planes{ "R", "G", "B" };
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const auto [scale, offset] = pairs[i];
    if (!(scale > 0.0 && offset >= 0.0 && std::isfinite(scale) && std::isfinite(offset)))
    {
      throw ExportError("NoiseProfile has the scale " + Text(scale) + " and the offset " + Text(offset) +
                        "; expected a scale above 0 and an offset of 0 or more");
    }
    profile.channels.push_back({ pairs.size() == 1 ? "mono" : planes[i], scale, offset, {} });
  }
  return profile;
}

NoiseProfile
ProfileOfDng(const std::string & bytes)
{
  return ProfileOfPairs(NoiseProfileIn(bytes));
}

/** Returns the profile of numbers, scale and offset by turns. */
NoiseProfile
ProfileOfNumbers(const std::vector<double> & numbers)
{
  if (numbers.size() % 2 != 0)
  {
    throw ExportError("there are " + std::to_string(numbers.size()) +
                      " numbers; expected 2 or 6: scale and offset of NoiseProfile");
  }
  Pairs pairs;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
  {
    pairs.emplace_back(numbers[i], numbers[i + 1]);
  }
  return ProfileOfPairs(pairs);
}

/** Returns the only number of an array, or the numbers of the weights. */
const std::vector<double> &
ArrayNamed(const std::map<std::string, std::vector<double>> & arrays, const std::string & name, std::size_t count)
{
  const auto found = arrays.find(name);
  if (found == arrays.end() || found->second.size() != count ||
      !std::all_of(found->second.begin(), found->second.end(), [](double value) { return std::isfinite(value); }))
  {
    throw ExportError(
      "the NumPy archive has " +
      (found == arrays.end() ? "no array " + name : std::to_string(found->second.size()) + " numbers in " + name) +
      "; expected " + std::to_string(count) +
      " finite numbers, as CAREamics' noise model of one Gaussian with two coefficients has them");
  }
  return found->second;
}

NoiseProfile
ProfileOfCareamics(const std::string & bytes)
{
  const auto   arrays = ReadNpz(bytes);
  const auto & weight = ArrayNamed(arrays, "trained_weight", 6);
  const double low = ArrayNamed(arrays, "min_signal", 1).front();
  const double high = ArrayNamed(arrays, "max_signal", 1).front();
  const double slope = std::exp(weight[3]) / (high - low);
  if (!(high > low) || !std::isfinite(slope) || !std::isfinite(std::exp(weight[2]) - slope * low))
  {
    throw ExportError("the noise model has min_signal = " + Text(low) + " and max_signal = " + Text(high) +
                      "; expected a brighter max_signal");
  }
  NoiseProfile profile;
  profile.format = "careamics";
  profile.channels.push_back({ "mono", slope, std::exp(weight[2]) - slope * low, {} });
  profile.floorDn2 = ArrayNamed(arrays, "min_sigma", 1).front();
  return profile;
}

NoiseProfile
SensorProfile(const char *          format,
              double                electronsPerDn,
              std::optional<double> readNoise,
              std::optional<double> offsetDn = std::nullopt)
{
  if (!(electronsPerDn > 0.0 && std::isfinite(electronsPerDn)) || readNoise.value_or(0.0) < 0.0)
  {
    throw ExportError("the gain is " + Text(electronsPerDn) + " e-/ADU and the read noise " +
                      Text(readNoise.value_or(0.0)) + " e-; expected a gain above 0 and a read noise of 0 or more");
  }
  NoiseProfile profile;
  profile.format = format;
  profile.form = ProfileForm::Sensor;
  profile.channels.push_back({ "mono", electronsPerDn, readNoise, offsetDn });
  return profile;
}

/** Returns the number behind the first \a key. Throws ExportError if there is none. */
double
NumberBehind(const std::string & text, const std::string & key, const std::string & ends)
{
  const std::size_t at = text.find(key);
  const std::size_t begin = at == std::string::npos ? at : at + key.size();
  const auto        number = begin == std::string::npos
                               ? std::nullopt
                               : FiniteNumber(WithoutBlanks(text.substr(begin, text.find_first_of(ends, begin) - begin)));
  if (!number)
  {
    throw ExportError("there is no number behind \"" + key + "\"; expected a whole file");
  }
  return *number;
}

/** Returns the value of an attribute of emva1288's results. */
double
EmvaValue(const std::string & text, const std::string & attribute)
{
  const std::size_t begin = text.find("<" + attribute + ">");
  const std::size_t end = text.find("</" + attribute + ">");
  if (begin == std::string::npos || end == std::string::npos || end < begin)
  {
    throw ExportError("the XML file has no element " + attribute +
                      "; expected the results of emva1288, with K and sigma_d");
  }
  return NumberBehind(text.substr(begin, end - begin), "<Value>", "<");
}

NoiseProfile
ProfileOfEmva1288(const std::string & text)
{
  return SensorProfile("emva1288", 1.0 / EmvaValue(text, "K"), EmvaValue(text, "sigma_d"));
}

NoiseProfile
ProfileOfThunderstorm(const std::string & text)
{
  if (text.find("isemgain=true") != std::string::npos)
  {
    throw ExportError("its camera multiplies electrons (isemgain=true), whose excess noise the file does not hold; "
                      "expected a camera without multiplication");
  }
  return SensorProfile(
    "thunderstorm", NumberBehind(text, "photons2adu=", " \")"), std::nullopt, NumberBehind(text, "offset=", " \")"));
}

/** Returns the cards of a header of FITS without the END card: 80 characters each, or lines of a text. */
std::vector<std::string>
FitsCards(const std::string & text)
{
  constexpr std::size_t    cardSize = 80;
  const bool               areLines = text.substr(0, cardSize + 2).find('\n') != std::string::npos;
  std::vector<std::string> cards;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = areLines ? std::min(text.find('\n', begin), text.size()) : begin + cardSize;
    cards.push_back(text.substr(begin, end - begin));
    cards.back().erase(cards.back().find_last_not_of('\r') + 1);
    if (WithoutBlanks(cards.back()) == "END")
    {
      cards.pop_back();
      break;
    }
    begin = areLines ? end + 1 : end;
  }
  return cards;
}

/** Returns the number of a card: the text behind "=", up to a comment. Throws ExportError if there is none. */
double
FitsNumber(const std::vector<std::string> & cards, const std::string & keyword)
{
  std::string start = keyword;
  start.resize(8, ' ');
  start += '=';
  const auto card =
    std::find_if(cards.begin(), cards.end(), [&](const std::string & each) { return each.rfind(start, 0) == 0; });
  if (card == cards.end())
  {
    throw ExportError("the FITS header has no card " + keyword + "; expected EGAIN [e-/ADU] and RDNOISE [e-]");
  }
  const std::string value = WithoutBlanks(card->substr(start.size(), card->find('/', start.size()) - start.size()));
  const auto        number = FortranNumber(value);
  if (!number)
  {
    throw ExportError("the FITS header has " + keyword + " = " + value + "; expected a number");
  }
  return *number;
}

NoiseProfile
ProfileOfFits(const std::string & text)
{
  const std::vector<std::string> cards = FitsCards(text);
  return SensorProfile("fits", FitsNumber(cards, "EGAIN"), FitsNumber(cards, "RDNOISE"));
}

/** Returns a text with blanks in place of the ends of its lines. */
std::string
InOneLine(std::string text)
{
  std::replace_if(text.begin(), text.end(), [](char character) { return character == '\n' || character == '\r'; }, ' ');
  return text;
}

/** Throws ExportError if the bytes are no text: they have a control byte other than tabulators and ends of lines. */
void
RequireText(const std::string & bytes)
{
  const auto found = std::find_if(bytes.begin(), bytes.end(), [](char character) {
    const auto byte = static_cast<unsigned char>(character);
    return byte < ' ' && (byte < '\t' || byte > '\r');
  });
  if (found != bytes.end())
  {
    throw ExportError("byte " + std::to_string(found - bytes.begin()) + " is " +
                      std::to_string(static_cast<unsigned char>(*found)) +
                      ", which no text has; expected text, JSON, npz or DNG. Give the file of a noise profile.");
  }
}

NoiseProfile
ReadBytes(const std::string & file, const std::string & bytes)
{
  const auto        has = [&](const char * text) { return bytes.find(text) != std::string::npos; };
  const std::string first = bytes.substr(0, 2);
  if (first == "II" || first == "MM")
  {
    return ProfileOfDng(bytes);
  }
  if (first == "PK")
  {
    return ProfileOfCareamics(bytes);
  }
  const std::string start = WithoutBlanks(bytes.substr(0, 64)); // beginning of the first line
  if (!start.empty() && start.front() == '<')
  {
    return ProfileOfEmva1288(bytes);
  }
  if (has("Camera setup") || has("EGAIN   ="))
  {
    return has("Camera setup") ? ProfileOfThunderstorm(bytes) : ProfileOfFits(bytes);
  }
  RequireText(bytes);
  const auto numbers = NumbersOf(InOneLine(bytes));
  return numbers.empty() ? ReadNoiseProfile(ReadYamlValues(file, bytes)) : ProfileOfNumbers(numbers);
}
} // namespace

NoiseProfile
ReadNoiseProfile(const std::string & file, const std::string & bytes)
{
  NoiseProfile profile;
  try
  {
    profile = ReadBytes(file, bytes);
  }
  catch (const ExportError & error)
  {
    const std::string reason = error.what();
    throw ExportError(reason.find(file) == std::string::npos ? "the profile " + file + " cannot be read: " + reason
                                                             : reason);
  }
  profile.file = file;
  return profile;
}

} // namespace sensornoise
