// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_RegressionSums_h
#define sensornoise_base_RegressionSums_h

namespace sensornoise
{

/** Sums of the weights w, and of their products with x, y, x^2 and x y: they determine the weighted line y = a + b x.
 */
struct RegressionSums
{
  double w{ 0.0 };
  double x{ 0.0 };
  double y{ 0.0 };
  double xx{ 0.0 };
  double xy{ 0.0 };

  /** Returns the sums of one point. */
  static RegressionSums
  Of(double w, double x, double y)
  {
    return { w, w * x, w * y, w * x * x, w * x * y };
  }
  RegressionSums &
  operator+=(const RegressionSums & other)
  {
    w += other.w;
    x += other.x;
    y += other.y;
    xx += other.xx;
    xy += other.xy;
    return *this;
  }
  /** Returns the weighted sum of the squared deviations of x from its mean. */
  double
  Spread() const
  {
    return xx - x * x / w;
  }
  /** Returns the weighted sum of the products of the deviations of x and y from their means. */
  double
  Product() const
  {
    return xy - x * y / w;
  }
  /** Returns b; 0 where x does not vary. */
  double
  Slope() const
  {
    const double spread = this->Spread();
    return spread > 0.0 ? this->Product() / spread : 0.0;
  }
};

} // namespace sensornoise

#endif
