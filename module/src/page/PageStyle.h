// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_PageStyle_h
#define sensornoise_page_PageStyle_h

namespace sensornoise
{

/** The page around the figures: one column, as wide as lines are read well, and as narrow as a telephone. */
inline constexpr const char * PageStyle = R"(
:root{--ink:#1b1f24;--soft:#57606a;--paper:#fff;--card:#f6f8fa;--edge:#d0d7de;--good:#00795a;--doubt:#945000;
--bad:#a83c00;color-scheme:light dark}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#a3adb8;--paper:#0d1117;--card:#161b22;--edge:#30363d;
--good:#2fc79a;--doubt:#e6a94a;--bad:#f58a4b}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1rem;max-width:48rem;background:var(--paper);color:var(--ink);
font:16px/1.5 system-ui,sans-serif;overflow-wrap:break-word}
h1{font-size:1.5rem;line-height:1.25;margin:.5rem 0}
h2{font-size:1.2rem;margin:2rem 0 .5rem}
h3{font-size:1rem;margin:1.5rem 0 .5rem}
p{margin:.5rem 0}
small,figcaption,.soft{color:var(--soft);font-size:.875rem}
.verdict,.warning{background:var(--card);border-left:.35rem solid var(--good);border-radius:.25rem;
padding:.6rem .8rem;margin:.6rem 0}
.verdict{font-size:1.1rem}
.warning{list-style:none}
.warnings{padding:0;margin:0}
.warning p{margin:.2rem 0}
.is-note{border-color:var(--good)}.is-warning{border-color:var(--doubt)}.is-error{border-color:var(--bad)}
.word{font-weight:600}
.is-note .word{color:var(--good)}.is-warning .word{color:var(--doubt)}.is-error .word{color:var(--bad)}
table{width:100%;border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{text-align:left;vertical-align:top;padding:.35rem .5rem .35rem 0;border-bottom:1px solid var(--edge)}
thead th{color:var(--soft);font-weight:600;font-size:.875rem}
tbody th{font-weight:400}
td small,th small{display:block}
.settings td,.label{overflow-wrap:anywhere}
.label{width:45%}.label.short{width:28%}
.nowrap{white-space:nowrap}
.quantities th:first-child{width:58%;padding-right:1rem}
figure{margin:1rem 0}
figure>svg{width:100%;max-width:640px;height:auto;display:block}
img{width:100%;max-width:512px;height:auto;image-rendering:pixelated;display:block;background:#000;
border:1px solid var(--edge)}
.maps{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,18rem),1fr));gap:0 1rem}
.legend{list-style:none;padding:0;margin:.3rem 0;columns:2}
.legend li{padding-left:1.2rem;text-indent:-1.2rem;break-inside:avoid}
.legend i{display:inline-block;width:.8rem;height:.8rem;margin-right:.4rem;border:1px solid var(--soft)}
details{margin:.5rem 0}
summary{cursor:pointer}
@media(max-width:30rem){body{font-size:15px;padding:.75rem}table{font-size:.875rem}
.quantities tr{display:grid;grid-template-columns:2fr 3fr;column-gap:.5rem;padding:.35rem 0;
border-bottom:1px solid var(--edge)}
.quantities th,.quantities td{border:0;padding:0}
.quantities th:first-child{width:auto;padding:0}
.quantities tbody th{display:contents}
.quantities th small{grid-area:2/1/3/3}
.quantities td{grid-area:1/2/2/3}}
@media print{body{max-width:none}details{break-inside:avoid}figure,.warning{break-inside:avoid}}
)";

} // namespace sensornoise

#endif
