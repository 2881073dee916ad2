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
#include "itkInverseGeneralizedAnscombeImageFilter.h"

namespace itk
{
template class InverseGeneralizedAnscombeImageFilter<Image<float, 2>, Image<unsigned char, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 2>, Image<unsigned char, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 2>, Image<unsigned short, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 2>, Image<unsigned short, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 2>, Image<short, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 2>, Image<short, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 2>, Image<float, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 2>, Image<float, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 2>, Image<double, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 2>, Image<double, 2>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 3>, Image<unsigned char, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 3>, Image<unsigned char, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 3>, Image<unsigned short, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 3>, Image<unsigned short, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 3>, Image<short, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 3>, Image<short, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 3>, Image<float, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 3>, Image<float, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<float, 3>, Image<double, 3>>;
template class InverseGeneralizedAnscombeImageFilter<Image<double, 3>, Image<double, 3>>;
} // namespace itk
