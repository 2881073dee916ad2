// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_FigureStyle_h
#define sensornoise_page_FigureStyle_h

namespace sensornoise
{

/** Colours of the figures, light and dark: after those of Okabe and Ito, which people without colour vision tell apart,
 * too, and every kind has a shape or a dash of its own besides. Plain colours, no variables: not every viewer of SVG
 * files knows those. */
inline constexpr const char * FigureStyle = R"(
svg text{fill:#1b1f24;font:14px system-ui,sans-serif}
svg .paper{fill:#fff}
svg .frame{fill:none;stroke:#57606a}
svg .grid{fill:none;stroke:#d8dee4}
svg .line{fill:none;stroke-width:1.8}
svg .point{fill:none;stroke-width:1.2}
svg .before{stroke:#b85c00}
svg .after{stroke:#0072b2}
svg .third{stroke:#00795a}
svg .zero{stroke:#57606a;stroke-width:1}
svg .after.full,svg .after.band,svg .bar{fill:#0072b2}
svg .third.band{fill:#00795a}
svg .band{stroke:none;opacity:.22}
svg .error{fill:none;stroke:#1b1f24;stroke-width:1.4}
svg .dashed{stroke-dasharray:7 5}
@media(prefers-color-scheme:dark){
svg text{fill:#e6edf3}
svg .paper{fill:#0d1117}
svg .frame,svg .zero{stroke:#a3adb8}
svg .grid{stroke:#2a313a}
svg .before{stroke:#e69f00}
svg .after{stroke:#56b4e9}
svg .third{stroke:#2fc79a}
svg .band{stroke:none}
svg .after.full,svg .after.band,svg .bar{fill:#56b4e9}
svg .third.band{fill:#2fc79a}
svg .error{stroke:#e6edf3}
}
)";

} // namespace sensornoise

#endif
