// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Text_h
#define sensornoise_base_Text_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

/** \file
 * Numbers as text and in text, letters, and signs. */

namespace sensornoise
{

/** Returns a number that was given, to six digits. */
SensorNoise_EXPORT std::string
Text(double number);

/** Returns a number that was found, to three digits, or to integers where there are more. */
SensorNoise_EXPORT std::string
Rounded(double number);

/** Returns a number that was compared with \a bound. \a bound is written by Rounded(); the number gets as many more
 * digits as are needed for both to differ. */
SensorNoise_EXPORT std::string
RoundedApart(double number, double bound);

/** Returns a fraction as "4.43 %". */
SensorNoise_EXPORT std::string
Percent(double fraction);

/** Returns a fraction that was compared with \a bound, which is written by Percent(): "12.003 %" beside "12 %". */
SensorNoise_EXPORT std::string
PercentApart(double fraction, double bound);

/** Returns "0.1660 +- 0.0038": both to two digits of the error. */
SensorNoise_EXPORT std::string
Measured(double value, double standardError);

/** Returns a clause that says why the flicker does not determine the offset. \a flickerZ is the excess of the variance
 * of the flicker over its noise, in standard deviations [1]. */
inline std::string
DescribeInsignificantFlicker(double flickerZ)
{
  return flickerZ > 0.0
           ? "the flicker is only " + RoundedApart(flickerZ, Significance.everyPixel) +
               " standard errors above its noise (more than " + Rounded(Significance.everyPixel) + " needed)"
           : "the flicker is below its noise";
}

/** Returns the shortest text that is read as this finite number again, with a point in every locale. */
SensorNoise_EXPORT std::string
ShortestText(double number);

/** Returns a finite number with \a decimals digits after the point, 0 to 20. */
SensorNoise_EXPORT std::string
FixedText(double number, int decimals);

/** Returns a finite number to \a digits digits, 1 to 17, with an exponent where it is large or small. */
SensorNoise_EXPORT std::string
GeneralText(double number, int digits);

/** Returns the number of a text, with a point in every locale; null for other texts, infinity and NaN. Blanks may stand
 * before the number, and nothing behind it. */
SensorNoise_EXPORT std::optional<double>
FiniteNumber(const std::string & text);

/** Returns a number of things, as "1 frame" or "20 frames". */
inline std::string
CountText(std::size_t count, const std::string & noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/** Returns FiniteNumber() of a text in which D may stand for E, as Fortran and FITS write exponents. */
SensorNoise_EXPORT std::optional<double>
FortranNumber(std::string text);

/** Returns \a text with its ASCII letters in lower case, in every locale. */
inline std::string
LowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return text;
}

/** Returns the text with signs in UTF-8 ("±", "e⁻", "²") instead of their ASCII form in records ("+-", "e-", "^2"). */
SensorNoise_EXPORT std::string
WithSigns(std::string text);

/** Returns the text in ASCII, for terminals that show nothing else. It replaces the signs that this library writes. A
 * sign may become several letters; as many of the next repeated blanks are removed, so that columns stay aligned. */
SensorNoise_EXPORT std::string
WithoutSigns(const std::string & text);

/** Returns the number of characters of a text in UTF-8. A character may have several bytes. */
SensorNoise_EXPORT std::size_t
CharactersIn(const std::string & text);

/** Returns the text, followed by blanks up to \a width characters. */
SensorNoise_EXPORT std::string
PaddedRight(const std::string & text, std::size_t width);

/** Returns the text, preceded by blanks up to \a width characters. */
SensorNoise_EXPORT std::string
PaddedLeft(const std::string & text, std::size_t width);

/** Returns the text in one line for a message: "?" replaces each invalid byte of UTF-8 and each control character. */
std::string
OneLine(const std::string & text);

} // namespace sensornoise

#endif
