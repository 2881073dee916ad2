/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "studies/PaperTables.h"

namespace sensornoise::tools
{

std::array<std::string, 7>
PaperFigures(int table, const std::string & experiment)
{
  struct Row
  {
    int                        table;
    const char *               experiment;
    std::array<std::string, 7> figures;
  };
  static const std::array<Row, 16> rows{ {
    { 2, "A1", { "5.00+-0.03", "200.1+-0.6", "15.2+-0.4", "-769.6+-15.7", "0.10+-0.01", "0.35+-0.07", "0.23+-0.04" } },
    { 2,
      "A2",
      { "5.00+-0.01", "199.9+-4.6", "15.0+-0.8", "-775.3+-7.5", "0.010+-0.01", "0.11+-0.02", "0.054+-0.007" } },
    { 2,
      "A3",
      { "5.00+-0.01", "200.0+-1.0", "15.0+-0.3", "-775.7+-10.3", "0.050+-0.007", "0.011+-0.003", "0.022+-0.004" } },
    { 2, "B1", { "1.00+-0.00", "100.0+-0.3", "8.2+-0.1", "-33.6+-1.9", "0.10+-0.02", "0.28+-0.14", "0.22+-0.05" } },
    { 2, "B2", { "1.01+-0.00", "99.6+-3.1", "8.0+-0.2", "-35.9+-2.3", "0.010+-0.002", "0.11+-0.02", "0.054+-0.008" } },
    { 2,
      "B3",
      { "1.00+-0.00", "100.0+-0.6", "8.0+-0.1", "-36.0+-2.2", "0.050+-0.007", "0.011+-0.003", "0.021+-0.003" } },
    { 2,
      "C1",
      { "0.300+-0.000", "40.0+-0.1", "3.34+-0.13", "-0.84+-0.88", "0.098+-0.015", "0.21+-0.05", "0.21+-0.06" } },
    { 2,
      "C2",
      { "0.300+-0.001", "40.0+-1.1", "3.00+-0.12", "-3.03+-0.73", "0.010+-0.001", "0.11+-0.02", "0.054+-0.009" } },
    { 2,
      "C3",
      { "0.300+-0.000", "40.0+-0.2", "3.02+-0.10", "-2.88+-0.62", "0.050+-0.006", "0.011+-0.003", "0.022+-0.004" } },
    { 3, "A1", { "5.06+-0.02", "200.3+-8.1", "16.4+-1.6", "-744+-28", "0.10+-0.01", "0.34+-0.06", "" } },
    { 3, "A2", { "", "218.3+-85.2", "16.5+-14.8", "", "", "0.11+-0.02", "" } },
    { 3, "A3", { "", "198.7+-19.0", "14.6+-3.3", "-780+-31", "0.050+-0.007", "", "" } },
    { 3, "B1", { "1.05+-0.02", "100.2+-3.2", "10.7+-1.3", "11.4+-30", "0.10+-0.01", "", "" } },
    { 3, "C1", { "0.345+-0.015", "", "", "50.4+-28.8", "", "0.33+-0.10", "0.20+-0.05" } },
    { 3, "C2", { "0.326+-0.012", "51.6+-136", "2.63+-5.97", "-9.22+-10.8", "0.010+-0.001", "", "0.052+-0.007" } },
    { 3,
      "C3",
      { "0.301+-0.002", "40.1+-12.8", "3.03+-0.97", "-2.65+-3.90", "0.050+-0.007", "0.011+-0.006", "0.019+-0.005" } },
  } };
  for (const Row & row : rows)
  {
    if (row.table == table && row.experiment == experiment)
    {
      return row.figures;
    }
  }
  return {};
}

} // namespace sensornoise::tools
