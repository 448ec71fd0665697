#include "tools/paper/page_parts.hpp"

namespace gnbv {

std::string_view paper_style() {
  return R"css(
:root { --ink: #1f2530; --pale: #667080; --line: #d9dee5; --wash: #f5f7f9; --link: #0b5fa5; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 36px 32px 80px; max-width: 1200px; color: var(--ink);
  background: #fff; font: 15px/1.5 "Helvetica Neue", Helvetica, Arial, "DejaVu Sans", sans-serif; }
h1 { font-size: 27px; font-weight: 600; margin: 0 0 6px; letter-spacing: -0.01em; }
h2 { font-size: 19px; font-weight: 600; margin: 52px 0 10px; padding-top: 14px;
  border-top: 1px solid var(--line); }
h3 { font-size: 15px; font-weight: 600; margin: 26px 0 8px; }
p { margin: 6px 0 10px; max-width: 78em; }
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
code { font: 12.5px/1.5 "DejaVu Sans Mono", Menlo, Consolas, monospace; background: var(--wash);
  padding: 1px 5px; border-radius: 3px; overflow-wrap: anywhere; }
.pale, figcaption, .notes { color: var(--pale); font-size: 13px; }
nav a { margin-right: 14px; font-size: 13px; }
table { border-collapse: collapse; font-size: 13px; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 4px 8px; border-bottom: 1px solid var(--line);
  vertical-align: baseline; white-space: nowrap; }
th { font-weight: 500; color: var(--pale); border-bottom-color: #aab3bf; white-space: normal;
  vertical-align: bottom; line-height: 1.25; }
th:first-child, td:first-child, td.text, th.text { text-align: left; }
td.text { white-space: normal; }
tr.group td { font-weight: 600; padding-top: 14px; }
.sides { display: grid; grid-template-columns: minmax(0, 8fr) minmax(0, 7fr); gap: 24px; }
.sides table { font-size: 12px; }
.sides th, .sides td { padding: 4px 3px; }
.sides.figure { grid-template-columns: minmax(0, 7fr) minmax(0, 3fr); }
.sides.figure.wide { grid-template-columns: minmax(0, 1fr); }
.side > h3 { margin-top: 6px; }
.paper { border-left: 3px solid var(--line); padding-left: 18px; }
.scroll { overflow-x: auto; }
.pictures { display: grid; gap: 12px; }
.pictures.n1 { grid-template-columns: minmax(0, 1fr); }
.pictures.n2 { grid-template-columns: repeat(2, minmax(0, 1fr)); }
.pictures.n3 { grid-template-columns: repeat(3, minmax(0, 1fr)); }
figure { margin: 0; }
figure img { width: 100%; display: block; border: 1px solid var(--line); border-radius: 3px; }
.counts { display: flex; flex-wrap: wrap; gap: 12px; margin: 16px 0 8px; }
.count { border: 1px solid var(--line); border-radius: 6px; padding: 10px 16px; min-width: 250px; }
.count b { display: block; font-size: 14px; font-weight: 600; margin-bottom: 4px; }
.chip { display: inline-block; border-radius: 9px; padding: 0 8px; font-size: 12px; line-height: 18px;
  white-space: nowrap; }
.good { background: #dcefe3; color: #17603a; }
.near { background: #e6f0d8; color: #4a6212; }
.open { background: #eceff3; color: #4d5766; }
.bad { background: #fbe3dc; color: #98300f; }
.missing { color: #98300f; font-size: 13px; }
.warning { border: 1px solid #e9b9a8; background: #fdf3ef; border-radius: 6px; padding: 8px 16px;
  margin: 14px 0; }
.notes { padding-left: 18px; margin: 8px 0; }
@media screen and (max-width: 800px) {
  .sides, .sides.figure, .pictures.n2, .pictures.n3 { grid-template-columns: minmax(0, 1fr); }
}
@page { size: A4; margin: 14mm 12mm; }
@media print {
  body { padding: 0; max-width: none; font-size: 10pt; }
  figure, tr, li, .count, .side { break-inside: avoid; }
  .sides:not(.figure) { grid-template-columns: minmax(0, 1fr); gap: 8px; }
  .sides.figure { gap: 14px; }
  .pictures { gap: 6px; }
  h2, h3, tr.group { break-after: avoid; }
  h2 { margin-top: 24px; }
  th, td { padding: 3px 5px; font-size: 8.5pt; }
  .scroll { overflow: visible; }
  nav { display: none; }
  .chip { border: 1px solid currentColor; background: none; }
}
)css";
}

}  // namespace gnbv
