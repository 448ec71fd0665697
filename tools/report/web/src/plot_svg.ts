// A plot as SVG: lines and axes as vectors, for papers and for the page on paper.
import type uPlot from "uplot";
import type { Line, Ring } from "./plot_specs";

const kGrid = "fill=\"none\" stroke=\"#dfe4ea\"";
const kRight = 16;
const kNames = 4; // a row
const kRow = 14;
const kLane = 9;
/** The shade of the page on white, opaque: not every program that draws SVG knows rgba(). */
export const kShade = "#fcf0e1";

/** When a run chose frontier views, in the unit of the plot's x: behind its curves, where it is
 * alone, or in a lane above those of all. */
export interface FrontierStrip { colour: string; isBehind: boolean; phases: [number, number][] }

/** Of a file, which says itself what it shows, or of a printed page, which says it around it. */
export interface SvgLook { width: number; height: number; left: number; font: number;
  title: string | null }
export const kOfFile = { width: 640, height: 400, left: 64, font: 11 };
export const kOfPage = { width: 350, left: 44, font: 9, title: null };

export interface SvgContent { lines: Line[]; rings: Ring[]; strips: FrontierStrip[]; xName: string }

const escaped = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const label = (x: number | string, y: number | string, anchor: string, what: string) =>
  `<text x="${x}" y="${y}" text-anchor="${anchor}">${escaped(what)}</text>`;
const rect = (x: number | string, y: number, width: number, height: number, colour: string) =>
  `<rect x="${x}" y="${y}" width="${width.toFixed(1)}" height="${height}" fill="${colour}"/>`;

/** Multiples of 1, 2 or 5 times a power of ten, at most `most` of them, with their names. */
function ticks(low: number, high: number, most: number): [number, string][] {
  const least = (high - low) / most || 1;
  const decade = 10 ** Math.floor(Math.log10(least));
  const step = decade * ([1, 2, 5].find((k) => k * decade >= least * (1 - 1e-9)) ?? 10);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) =>
    [(first + i) * step, ((first + i) * step).toLocaleString("en-US",
      { maximumFractionDigits: digits })]);
}

/** Title and names may hold anything: they are text. */
export function plotSvg(plot: uPlot, { lines, rings, strips, xName }: SvgContent,
    look: SvgLook): string {
  const { width, height, left, font, title } = look;
  const { min: x0 = 0, max: x1 = 1 } = plot.scales.x;
  const { min: y0 = 0, max: y1 = 1 } = plot.scales.y;
  const lanes = strips.filter((strip) => !strip.isBehind).length;
  const keys = title === null ? [] : [...lines.filter((line) => line.width > 0),
    ...strips.filter((strip) => strip.isBehind && strip.phases.length > 0)
      .map(({ colour }) => ({ name: "frontier views (FVS)", colour }))];
  const lanesTop = (title === null ? 8 : 20) + kRow * Math.ceil(keys.length / kNames);
  const top = lanesTop + kLane * lanes;
  const bottom = 3.3 * font; // of the numbers and the name of the axis
  const [w, h] = [width - left - kRight, height - top - bottom];
  const px = (x: number) => (left + w * (x - x0!) / (x1! - x0! || 1)).toFixed(1);
  const py = (y: number) => (top + h * (1 - (y - y0!) / (y1! - y0! || 1))).toFixed(1);
  const bars = (strip: FrontierStrip, y: number, tall: number) => strip.phases.map(([from, to]) =>
    rect(px(from), y, Math.max(1, Number(px(Math.min(to, x1!))) - Number(px(from))), tall,
      strip.colour)).join("");
  const key = (i: number) => [left + i % kNames * 138, 26 + kRow * Math.floor(i / kNames)];
  const parts = [
    ...strips.map((strip, i) => (strip.isBehind ? bars(strip, top, h)
      : rect(left, lanesTop + kLane * i, w, kLane - 2, "#dfe4ea")
        + bars(strip, lanesTop + kLane * i, kLane - 2))),
    lanes > 0 ? label(left - 6, lanesTop + kLane * lanes / 2 + 3, "end", "FVS") : "",
    ...ticks(x0!, x1!, 6).map(([x, name]) => `<path ${kGrid} d="M${px(x)} ${top}v${h}"/>`
      + label(px(x), height - 1.9 * font, "middle", name)),
    ...ticks(y0!, y1!, Math.floor(h / (2 * font)))
      .map(([y, name]) => `<path ${kGrid} d="M${left} ${py(y)}h${w}"/>`
        + label(left - 6, Number(py(y)) + 0.36 * font, "end", name)),
    ...lines.map((line, i) => (line.width === 0 ? "" : `<path fill="none" stroke="${line.colour}" `
      + `stroke-width="1.6"${line.dash ? ` stroke-dasharray="${line.dash.join(" ")}"` : ""} d="${
        pathOf(plot.data[0], plot.data[i + 1], px, py, line.steps)}"/>`)),
    ...rings.map((ring) => `<circle cx="${px(ring.x)}" cy="${py(ring.y)}" r="4.5" fill="none" `
      + `stroke="${ring.colour}" stroke-width="1.6"/>`),
    ...keys.map((named, i) => rect(key(i)[0], key(i)[1] - 9, 10, 10, named.colour)
      + label(key(i)[0] + 14, key(i)[1], "start", named.name)),
    title === null ? "" : label(left, 12, "start", title),
    label(left + w / 2, height - 0.5 * font, "middle", xName)];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" `
    + `width="${width}" height="${height}" font-family="sans-serif" font-size="${font}">`
    + `${parts.join("")}</svg>\n`;
}

function pathOf(xs: ArrayLike<number>, ys: ArrayLike<number | null | undefined>,
    px: (x: number) => string, py: (y: number) => string, isSteps = false): string {
  let path = "";
  for (let i = 0; i < xs.length; ++i) {
    const y = ys[i];
    if (y === null || y === undefined) continue;
    const way = !path ? `M${px(xs[i])} ` : isSteps ? `H${px(xs[i])}V` : `L${px(xs[i])} `;
    path += way + py(y);
  }
  return path;
}
