// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef InfluenceConstants_h
#define InfluenceConstants_h

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** A number of the refined method that a study changes. */
struct VariedConstant
{
  std::string name; ///< as at the place where it is used: "Significance.manyTests"
  double *    value;
  std::string unit;
  std::string what; ///< one line for people
};

/** The most influential ones: of all numbers in the rooms' Constants.h, those whose half or twice changed most in the
 * stress cases. */
const std::vector<VariedConstant> &
GetVariedConstants();

/** Gives a constant a value as long as it lives. Whatever measures meanwhile, in any thread, measures with it. */
class ConstantChange
{
public:
  ConstantChange(double & constant, double value)
    : m_Constant(constant)
    , m_Before(constant)
  {
    m_Constant = value;
  }
  ~ConstantChange() { m_Constant = m_Before; }
  ConstantChange(const ConstantChange &) = delete;
  ConstantChange &
  operator=(const ConstantChange &) = delete;

private:
  double & m_Constant;
  double   m_Before;
};

} // namespace sensornoise::tools

#endif
