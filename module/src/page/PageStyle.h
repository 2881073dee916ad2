// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_PageStyle_h
#define sensornoise_page_PageStyle_h

namespace sensornoise
{

/** Style of the page around the figures. On a wide screen a report has the curve beside the warnings. The curve is
 * 27rem wide, so that it ends above the bottom of a screen of 1280 x 800 pixels. On a telephone everything is one
 * column, and a row of the quantities becomes a line with its number and below it its meaning. */
inline constexpr const char * PageStyle = R"(
:root{--ink:#1b1f24;--soft:#57606a;--paper:#fff;--card:#f6f8fa;--edge:#d0d7de;--good:#00795a;--doubt:#945000;
--bad:#a83c00;color-scheme:light dark}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#a3adb8;--paper:#0d1117;--card:#161b22;--edge:#30363d;
--good:#2fc79a;--doubt:#e6a94a;--bad:#f58a4b}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif;overflow-wrap:break-word}
main{margin:0 auto;padding:1rem;max-width:48rem}
main.report{max-width:66rem}
h1{font-size:1.4rem;line-height:1.25;margin:0 0 .2rem;overflow-wrap:anywhere}
h2{font-size:1.15rem;line-height:1.3;margin:1.8rem 0 .4rem}
h3{font-size:1rem;margin:1.2rem 0 .3rem}
p{margin:.4rem 0}
h1+p{margin-top:0}
a{color:inherit}
a:focus-visible,summary:focus-visible{outline:.15rem solid var(--good);outline-offset:.15rem}
small,figcaption,.soft{color:var(--soft);font-size:.875rem}
.is-note{--mark:var(--good)}.is-warning{--mark:var(--doubt)}.is-error{--mark:var(--bad)}
.verdict,.warning,.key{background:var(--card);border-radius:.3rem;padding:.5rem .8rem}
.verdict,.warning,.key.is-warning{border-left:.35rem solid var(--mark)}
.verdict{margin:.6rem 0}
.warnings{list-style:none;padding:0;margin:0}
.warning{margin:0 0 .6rem}
.warning:target{outline:.15rem solid var(--mark)}
.warning h3{margin:0}
.warning p{margin:.2rem 0}
.word{font-weight:600;color:var(--mark)}
.keys{display:grid;grid-template-columns:repeat(3,minmax(0,1fr));gap:.75rem;margin:.6rem 0}
.key dt{color:var(--soft);font-size:.875rem}
.key dd{margin:0;font-variant-numeric:tabular-nums}
.key b{font-size:1.5rem;line-height:1.25;white-space:nowrap}
.two{display:grid;grid-template-columns:minmax(0,27rem) minmax(0,1fr);gap:0 1.75rem;align-items:start}
.two.first-words{grid-template-columns:minmax(0,1fr) minmax(0,27rem)}
.two h2{margin-top:.5rem}
.checks{padding-left:1.2rem;margin:.3rem 0}
table{width:100%;border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{text-align:left;vertical-align:top;padding:.35rem .5rem .35rem 0;border-bottom:1px solid var(--edge)}
thead th{color:var(--soft);font-weight:600;font-size:.875rem}
tbody th{font-weight:400}
tbody .group{font-weight:600;padding-top:1.1rem}
td small,th small{display:block}
.settings td,.label{overflow-wrap:anywhere}
.label{width:45%}.label.short{width:28%}
time,.nowrap,.number,.unit{white-space:nowrap}
.quantities .number{text-align:right}
.quantities .range{padding:.35rem 0 .35rem 1rem;width:14rem;color:var(--soft)}
.quantities .label{width:auto}
.quantities th small{max-width:32rem}
figure{margin:.4rem 0 1rem}
figure>svg{width:100%;max-width:640px;height:auto;display:block}
img{width:100%;max-width:512px;height:auto;image-rendering:pixelated;display:block;background:#000;
border:1px solid var(--edge)}
.maps h3{margin-top:.4rem}
.maps{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,18rem),1fr));gap:0 1rem}
.legend{list-style:none;padding:0;margin:.3rem 0;columns:2}
.legend li{padding-left:1.2rem;text-indent:-1.2rem;break-inside:avoid}
.legend i{display:inline-block;width:.8rem;height:.8rem;margin-right:.4rem;border:1px solid var(--soft)}
details{border-top:1px solid var(--edge);padding:.6rem 0}
table+details{margin-top:1.5rem}
details details{margin-left:1rem}
summary{cursor:pointer}
summary h2{display:inline;font-size:1rem;margin:0}
@media(max-width:52rem){.two,.two.first-words{grid-template-columns:minmax(0,1fr)}}
@media(max-width:36rem){body{font-size:15px}main{padding:.75rem}table{font-size:.875rem}
.keys{grid-template-columns:minmax(0,1fr);gap:.4rem}
.key{display:grid;grid-template-columns:6rem minmax(0,1fr)}
.key dt{grid-row:1/3;align-self:center}
.key dd{grid-column:2}
.key b{font-size:1.25rem}
.quantities tr{display:flex;flex-wrap:wrap;column-gap:.5rem;padding:.35rem 0;border-bottom:1px solid var(--edge)}
.quantities th,.quantities td,.quantities .range{border:0;padding:0}
.quantities tbody th:not(.group){display:contents}
.quantities .group{padding-top:1rem}
.quantities .label,.quantities th span{flex:1}
.quantities .range{order:1}
.quantities th small{order:2}
.quantities .range,.quantities th small{flex-basis:100%;width:auto}
.quantities .range{text-align:right}
details details{margin-left:0}}
@media print{main,main.report{max-width:none}details,figure,.warning,tr{break-inside:avoid}}
)";

} // namespace sensornoise

#endif
