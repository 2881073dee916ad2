// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/InfluenceConstants.h"

#include "base/Constants.h"
#include "correlation/Constants.h"
#include "moments/Constants.h"
#include "pixels/Constants.h"
#include "refined/Constants.h"
#include "scene/Constants.h"
#include "series/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <type_traits>

namespace sensornoise::tools
{

namespace
{
struct VariedConstant
{
  std::string                 name;
  std::function<double()>     get;
  std::function<void(double)> set;
};

/** Returns a constant that is set to the nearest number of its type. A count stays above 0. */
template <typename TNumber>
VariedConstant
MakeVaried(const char * name, TNumber & constant)
{
  return { name,
           [&constant] { return static_cast<double>(constant); },
           [&constant](double value) {
             const double nearest = std::is_integral_v<TNumber> ? std::round(value) : value;
             constant = static_cast<TNumber>(constant > TNumber{ 0 } && nearest <= 0.0 ? 1.0 : nearest);
           } };
}

const std::vector<VariedConstant> &
GetVariedConstants()
{
#define Constant(group, member) MakeVaried(#group "." #member, group.member),
  static const std::vector<VariedConstant> constants{
#include "InfluenceConstants.inc"
  };
#undef Constant
  return constants;
}
} // namespace

void
PrintVariedConstants()
{
  for (const VariedConstant & constant : GetVariedConstants())
  {
    std::printf("%-42s %.4g\n", constant.name.c_str(), constant.get());
  }
}

void
MultiplyConstants(const std::vector<std::string> & changes)
{
  for (const std::string & change : changes)
  {
    const std::size_t equals = change.find('=');
    const auto &      all = GetVariedConstants();
    const auto        found = std::find_if(all.begin(), all.end(), [&](const VariedConstant & constant) {
      return constant.name == change.substr(0, equals);
    });
    char              rest = 0;
    double            factor = 0.0;
    const bool        isFactor = equals != std::string::npos &&
                          std::sscanf(change.c_str() + equals + 1, "%lf%c", &factor, &rest) == 1 && factor > 0.0;
    if (found == all.end() || !isFactor)
    {
      throw std::invalid_argument("--constant is \"" + change +
                                  "\"; expected NAME=FACTOR with a name of --list-constants and a positive factor");
    }
    found->set(factor * found->get());
  }
}

} // namespace sensornoise::tools
