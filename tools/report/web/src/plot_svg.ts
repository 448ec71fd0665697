// A plot as SVG: lines and axes as vectors, for papers.
import type uPlot from "uplot";
import type { Line } from "./plot_specs";

const kWidth = 640;
const kHeight = 400;
const kGrid = "fill=\"none\" stroke=\"#dfe4ea\"";
const kRight = 16;
const kLeft = 64;
const kBottom = 48;
const kNames = 4; // a row
const kRow = 14;
const kLane = 9;
/** The shade of the page on white, opaque: not every program that draws SVG knows rgba(). */
export const kShade = "#fcf0e1";

/** When a run chose frontier views, in the unit of the plot's x: behind its curves, where it is
 * alone, or in a lane above those of all. */
export interface FrontierStrip { colour: string; isBehind: boolean; phases: [number, number][] }

const escaped = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** Title and names may hold anything: they are text. */
export function plotSvg(plot: uPlot, lines: Line[], strips: FrontierStrip[], title: string,
    xName: string): string {
  const { min: x0 = 0, max: x1 = 1 } = plot.scales.x;
  const { min: y0 = 0, max: y1 = 1 } = plot.scales.y;
  const lanes = strips.filter((strip) => !strip.isBehind).length;
  const keys = [...lines, ...strips.filter((strip) => strip.isBehind && strip.phases.length > 0)
    .map(({ colour }) => ({ name: "frontier views (FVS)", colour }))];
  const lanesTop = 20 + kRow * Math.ceil(keys.length / kNames);
  const top = lanesTop + kLane * lanes;
  const [w, h] = [kWidth - kLeft - kRight, kHeight - top - kBottom];
  const px = (x: number) => (kLeft + w * (x - x0!) / (x1! - x0! || 1)).toFixed(1);
  const py = (y: number) => (top + h * (1 - (y - y0!) / (y1! - y0! || 1))).toFixed(1);
  const text = (x: number | string, y: number | string, anchor: string, what: string) =>
    `<text x="${x}" y="${y}" text-anchor="${anchor}">${escaped(what)}</text>`;
  const rect = (x: number | string, y: number, width: number, height: number, colour: string) =>
    `<rect x="${x}" y="${y}" width="${width.toFixed(1)}" height="${height}" fill="${colour}"/>`;
  const ticks = (low: number, high: number) =>
    Array.from({ length: 6 }, (_, i) => low + (high - low) * i / 5);
  const name = (v: number) => v.toLocaleString("en-US", { maximumFractionDigits: v < 10 ? 2 : 0 });
  const bars = (strip: FrontierStrip, y: number, height: number) => strip.phases.map(([from, to]) =>
    rect(px(from), y, Math.max(1, Number(px(Math.min(to, x1!))) - Number(px(from))), height,
      strip.colour)).join("");
  const key = (i: number) => [kLeft + i % kNames * 138, 26 + kRow * Math.floor(i / kNames)];
  const parts = [
    ...strips.map((strip, i) => (strip.isBehind ? bars(strip, top, h)
      : rect(kLeft, lanesTop + kLane * i, w, kLane - 2, "#dfe4ea")
        + bars(strip, lanesTop + kLane * i, kLane - 2))),
    lanes > 0 ? text(kLeft - 6, lanesTop + kLane * lanes / 2 + 3, "end", "FVS") : "",
    ...ticks(x0!, x1!).map((x) => `<path ${kGrid} d="M${px(x)} ${top}v${h}"/>`
      + text(px(x), kHeight - 28, "middle", name(x))),
    ...ticks(y0!, y1!).map((y) => `<path ${kGrid} d="M${kLeft} ${py(y)}h${w}"/>`
      + text(kLeft - 6, Number(py(y)) + 4, "end", name(y))),
    ...lines.map((line, i) => `<path fill="none" stroke="${line.colour}" stroke-width="1.6"${
      line.dash ? ` stroke-dasharray="${line.dash.join(" ")}"` : ""} d="${
      pathOf(plot.data[0], plot.data[i + 1], px, py)}"/>`),
    ...keys.map((named, i) => rect(key(i)[0], key(i)[1] - 9, 10, 10, named.colour)
      + text(key(i)[0] + 14, key(i)[1], "start", named.name)),
    text(kLeft, 12, "start", title), text(kLeft + w / 2, kHeight - 8, "middle", xName)];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${kWidth} ${kHeight}" `
    + `width="${kWidth}" height="${kHeight}" font-family="sans-serif" font-size="11">`
    + `${parts.join("")}</svg>\n`;
}

function pathOf(xs: ArrayLike<number>, ys: ArrayLike<number | null | undefined>,
    px: (x: number) => string, py: (y: number) => string): string {
  let path = "";
  for (let i = 0; i < xs.length; ++i) {
    const y = ys[i];
    if (y === null || y === undefined) continue;
    path += `${path ? "L" : "M"}${px(xs[i])} ${py(y)}`;
  }
  return path;
}
