// A plot as SVG: lines and axes as vectors, for papers.
import type uPlot from "uplot";
import type { Line } from "./plot_specs";

const kWidth = 640;
const kHeight = 400;
const kGrid = "fill=\"none\" stroke=\"#dfe4ea\"";
const kBox = { left: 64, top: 36, right: 16, bottom: 48 };

const escaped = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** Title and names may hold anything: they are text. */
export function plotSvg(plot: uPlot, lines: Line[], title: string, xName: string): string {
  const { min: x0 = 0, max: x1 = 1 } = plot.scales.x;
  const { min: y0 = 0, max: y1 = 1 } = plot.scales.y;
  const [w, h] = [kWidth - kBox.left - kBox.right, kHeight - kBox.top - kBox.bottom];
  const px = (x: number) => (kBox.left + w * (x - x0!) / (x1! - x0! || 1)).toFixed(1);
  const py = (y: number) => (kBox.top + h * (1 - (y - y0!) / (y1! - y0! || 1))).toFixed(1);
  const text = (x: number | string, y: number | string, anchor: string, what: string) =>
    `<text x="${x}" y="${y}" text-anchor="${anchor}">${escaped(what)}</text>`;
  const ticks = (low: number, high: number) =>
    Array.from({ length: 6 }, (_, i) => low + (high - low) * i / 5);
  const name = (v: number) => v.toLocaleString("en-US", { maximumFractionDigits: v < 10 ? 2 : 0 });
  const parts = [
    ...ticks(x0!, x1!).map((x) => `<path ${kGrid} d="M${px(x)} ${kBox.top}v${h}"/>`
      + text(px(x), kHeight - 28, "middle", name(x))),
    ...ticks(y0!, y1!).map((y) => `<path ${kGrid} d="M${kBox.left} ${py(y)}h${w}"/>`
      + text(kBox.left - 6, Number(py(y)) + 4, "end", name(y))),
    ...lines.map((line, i) => `<path fill="none" stroke="${line.colour}" stroke-width="1.6"${
      line.dash ? ` stroke-dasharray="${line.dash.join(" ")}"` : ""} d="${
      pathOf(plot.data[0], plot.data[i + 1], px, py)}"/>`),
    ...lines.map((line, i) => `<rect x="${kBox.left + i * 130}" y="20" width="10" height="10" `
      + `fill="${line.colour}"/>` + text(kBox.left + 14 + i * 130, 29, "start", line.name)),
    text(kBox.left, 13, "start", title), text(kBox.left + w / 2, kHeight - 8, "middle", xName)];
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
