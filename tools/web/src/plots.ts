// The plots: one cursor for all, the replay's place in each; a click moves the replay there. What
// they show comes with the page (tools/figures/figures.schema.json); each is an SVG, on the page, on
// paper and as a file.
import { kEfforts, type Clock } from "./clock";
import { hairline, isDark, onPage, paleInk } from "./colours";
import type { Plot, PlotChoice } from "./data";
import { make, number, select, significant } from "./dom";
import { lastAtMost, type Flight } from "./flight";
import { fileName, saveFile } from "./save";

/** Of figures.schema.json, with numbers as arrays in which NaN is what is not known. */
interface Axis { label: string; low: number; high: number; ticks: { at: number; text: string }[] }
interface Series { name: string; label: string; mark: "line" | "steps" | "level" | "interval";
  colour: string; dashes: number[]; width_pt: number; x: Float64Array; y: Float64Array;
  low: Float64Array; high: Float64Array; end: (number | null)[] | null }
interface Panel { x: Axis; y: Axis; shades: { label: string; spans: number[][] }; series: Series[] }
export interface Figure { notes: string[]; panels: Panel[] }

const kLeft = 60;
const kRight = 16;
const kLane = 9; // of a panel of intervals
const kKeys = 4; // a row
const kKeyRow = 14;

/** Of the page, of paper or of a file, which says itself what it shows. */
interface SvgLook { where: "screen" | "paper" | "file"; width: number; height: number; left: number;
  font: number; title?: string }

const escaped = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const label = (x: number, y: number, anchor: string, what: string) => `<text x="${
  x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}" fill="currentColor">${
  escaped(what)}</text>`;
const rect = (x: number, y: number, width: number, height: number, colour: string) =>
  `<rect x="${x.toFixed(1)}" y="${y.toFixed(1)}" width="${Math.max(1, width).toFixed(1)}" height="${
    height.toFixed(1)}" fill="${colour}"/>`;
const isLanes = (panel: Panel) => panel.series[0]?.mark === "interval";
const heightOf = (panels: Panel[]) =>
  kLane * panels.filter(isLanes).reduce((sum, { y }) => sum + y.high - y.low, 0);

/** A panel between `top` and `bottom` of a picture; its axis below where that is the last one. */
function drawPanel({ x, y, shades, series }: Panel, look: SvgLook, top: number, bottom: number,
    isLast: boolean): string {
  const { where, width, left, font } = look;
  const isPaper = where !== "screen";
  const line = isPaper ? "#dfe4ea" : hairline();
  const [w, h] = [width - left - kRight, bottom - top];
  const px = (at: number) => left + w * (at - x.low) / (x.high - x.low);
  const py = (at: number) => bottom - h * (at - y.low) / (y.high - y.low || 1);
  const colour = (one: Series) => (isPaper ? one.colour : `#${onPage(one.colour).getHexString()}`);
  const shade = isPaper || !isDark() ? "#fcf0e1" : "#33291d"; // opaque: not all know rgba()
  const point = (at: number, value: number) => `${px(at).toFixed(1)},${py(value).toFixed(1)}`;
  const draw = (one: Series) => {
    const known = [...one.y.keys()].filter((i) => !Number.isNaN(one.y[i]));
    if (one.mark === "interval") {
      return `<g class="lane"><title>${escaped(one.name)}</title>`
        + rect(left, py(one.y[0]) - kLane / 2, w, kLane - 2, line) + known.map((i) =>
          rect(px(one.low[i]), py(one.y[i]) - kLane / 2, px(one.high[i]) - px(one.low[i]),
            kLane - 2, colour(one))).join("") + "</g>";
    }
    // where each is, and what it is worth there: a step has the value before it, too
    const corners = known.flatMap((i, k) => [
      ...k > 0 && one.mark === "steps" ? [[i, known[k - 1]]] : [], [i, i]]);
    const along = (values: Float64Array) => corners.map(([i, of]) => point(one.x[i], values[of]));
    const band = one.low.length === 0 ? "" : `<polygon fill="${colour(one)}" fill-opacity="0.22" `
      + `points="${[...along(one.high), ...along(one.low).reverse()].join(" ")}"/>`;
    const way = one.mark === "level" ? `${point(x.low, one.y[0])}H${px(x.high).toFixed(1)}`
      : along(one.y).join("L");
    const [endX, endY] = one.end ?? [null, null];
    return `${band}<path fill="none" stroke="${colour(one)}" stroke-width="${
      Math.max(0.8, 1.6 * one.width_pt).toFixed(1)}" stroke-dasharray="${
      one.dashes.join(" ") || "none"}" d="M${way}"/>${endX === null || endY === null ? ""
      : `<circle cx="${px(endX).toFixed(1)}" cy="${py(endY).toFixed(1)}" r="3.5" fill="${
        colour(one)}"/>`}`;
  };
  const grid = `<path fill="none" stroke="${line}" d="`;
  return [...shades.spans.map(([from, to]) => rect(px(from), top, px(to) - px(from), h, shade)),
    ...!isLast ? [] : x.ticks.map(({ at, text }) => `${grid}M${px(at).toFixed(1)} ${top}v${h}"/>`
      + label(px(at), bottom + 1.4 * font, "middle", text)),
    ...y.ticks.map(({ at, text }) => (isLast ? `${grid}M${left} ${py(at).toFixed(1)}h${w}"/>` : "")
      + label(left - 6, py(at) + 0.36 * font, "end", text)),
    ...series.map(draw),
    isLast ? label(left + w / 2, bottom + 2.8 * font, "middle", x.label) : ""].join("");
}

/** One plot with what is chosen of it, of the runs that are shown. */
class PlotView {
  readonly element: HTMLElement;
  private svg: SVGElement | null = null;
  private readonly place = make("div", { class: "plot-place" });
  private readonly values: HTMLElement[] = [];
  private readonly now = make("i", { class: "now" }); // moving it draws no plot anew
  private readonly panels: Panel[];
  private readonly named: Series[];

  constructor(plot: Plot, { notes, panels }: Figure, words: string, private readonly all: Plots,
      controls: HTMLElement[]) {
    this.panels = panels.map((panel) => ({ ...panel,
      series: panel.series.filter(({ name }) => all.isShown(name)) }))
      .filter(({ series }) => series.length > 0);
    const main = this.panels.at(-1);
    this.named = main?.series.filter((one) => one.label !== "") ?? [];
    const title = `${plot.title}${words} ${main?.y.label ?? ""}`.trim();
    const legend = make("div", { class: "values" }, ...this.named.map((one) => {
      const mark = make("i", { class: "mark line" });
      mark.style.background = `#${onPage(one.colour).getHexString()}`;
      const value = make("b", {});
      this.values.push(value);
      return make("span", {}, mark, one.label, " ", value);
    }));
    this.element = make("figure", { class: "card plot" }, make("figcaption", {},
      make("span", { class: "plot-title", title: plot.note }, plot.title),
      make("span", { class: "plot-choice" }, words),
      make("span", { class: "unit" }, main?.y.label ?? ""),
      make("span", { class: "marks-key" }, ...notes.map((note) => make("span", {}, note)),
        ...this.panels.filter(isLanes).map(({ y }) => make("span", {},
          make("i", { class: "swatch strip" }), y.label)),
        main && main.shades.spans.length > 0 && plot === all.plots[0] ? make("span", {},
          make("i", { class: "swatch" }), main.shades.label) : null),
      ...controls),
    ...!main ? [make("p", { class: "nothing" }, "Not recorded by this run.")]
      : [this.place, legend, make("button", { type: "button", class: "small save",
        title: `${plot.title} as SVG`, click: () => {
          const svg = this.drawn({ where: "file", width: 640, height: 400, left: 64, font: 11,
            title });
          saveFile(new Blob([svg], { type: "image/svg+xml" }), `${fileName(plot.title)}.svg`);
        } }, "SVG")]);
    for (const kind of ["pointerdown", "pointermove", "pointerleave"] as const) {
      this.place.addEventListener(kind, (event) => this.point(event));
    }
  }

  /** Anew where the page has become narrower or wider. */
  fit() {
    const width = this.place.clientWidth;
    if (width === 0 || (this.svg && width === Number(this.svg.getAttribute("width")))) return;
    const parse = (look: SvgLook) => new DOMParser()
      .parseFromString(this.drawn(look), "image/svg+xml").documentElement as unknown as SVGElement;
    this.svg = parse({ where: "screen", width, height: 168 + heightOf(this.panels), left: kLeft,
      font: 11 });
    this.place.replaceChildren(this.svg, this.now, parse({ where: "paper", width: 350,
      height: this.all.paper_px, left: 44, font: 9 }));
  }

  /** The replay's place, and the values at `at`. */
  follow(now: number, at: number) {
    if (!this.svg) return;
    const { x: { high } } = this.panels.at(-1)!;
    const w = Number(this.svg.getAttribute("width")) - kLeft - kRight;
    this.now.style.transform = `translateX(${(kLeft + w * Math.max(0, now) / high).toFixed(1)}px)`;
    this.named.forEach(({ mark, x, y, low, high: most }, i) => {
      let k = mark === "level" ? 0 : lastAtMost(x, at + 1e-9);
      if (k < 0 && x[0] === 0) k = 0; // after the profile alone
      while (k >= 0 && Number.isNaN(y[k])) --k;
      const range = k >= 0 && low.length > 0 ? ` (${valueText(low[k])} to ${valueText(most[k])})` : "";
      this.values[i].textContent = k < 0 ? "–" : valueText(y[k]) + range;
    });
  }

  private point(event: PointerEvent) {
    if (!this.svg) return;
    const { left, width } = this.svg.getBoundingClientRect();
    const at = this.panels.at(-1)!.x.high * (event.clientX - left - kLeft) / (width - kLeft - kRight);
    if (event.type === "pointerleave") this.all.hover(null);
    else if (event.buttons === 1) this.all.seek(at);
    else this.all.hover(at);
  }

  private drawn(look: SvgLook): string {
    const { where, width, height, left, font, title } = look;
    const keys = title ? this.named : [];
    const key = ({ colour, label: words }: Series, i: number) => {
      const [x, y] = [left + i % kKeys * 138, 26 + kKeyRow * Math.floor(i / kKeys)];
      return rect(x, y - 9, 10, 10, colour) + label(x + 14, y, "start", words);
    };
    let top = (title ? 20 : 8) + kKeyRow * Math.ceil(keys.length / kKeys);
    const parts = this.panels.map((panel, i) => {
      const isLast = i + 1 === this.panels.length;
      const bottom = isLast ? height - 3.3 * font : top + heightOf([panel]);
      const part = drawPanel(panel, look, top, bottom, isLast);
      top = bottom;
      return part;
    });
    return `<svg xmlns="http://www.w3.org/2000/svg" class="${where}" `
      + `viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" `
      + `font-family="sans-serif" font-size="${font}" color="${
        where === "screen" ? paleInk() : "#30363f"}">${parts.join("")}${keys.map(key).join("")}${
        title ? label(left, 12, "start", title) : ""}</svg>\n`;
  }
}

const valueText = (value: number) =>
  (Math.abs(value) >= 1000 ? number(value) : significant(value));

export class Plots {
  readonly element = make("section", { class: "plots", "aria-label": "Plots" });
  private hidden = new Set<string>(); // labels of runs
  private views: PlotView[] = [];
  private shownBy = "";
  private hovered: number | null = null;
  private showsMeans = false;
  private readonly chosen: number[]; // of each plot

  /** Plots are `paper_px` high where they are 350 px wide, on paper. */
  constructor(readonly plots: Plot[], private readonly flights: Flight[],
      private readonly clock: Clock, readonly paper_px: number) {
    this.chosen = plots.map(() => 0);
    clock.onChange(() => {
      if (clock.effort !== this.shownBy) this.rebuild(); else this.follow();
    });
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  isShown(series: string) { return !this.hidden.has(series); }

  setFlights(shown: Flight[]) {
    this.hidden = new Set(this.flights.filter((flight) => !shown.includes(flight))
      .map(({ data }) => data.label));
    this.rebuild();
  }

  rebuild() {
    this.shownBy = this.clock.effort;
    this.views = this.plots.map((plot, i) => this.viewOf(plot, i));
    this.element.replaceChildren(...this.views.map(({ element }) => element));
    this.fit();
  }

  seek(at: number) {
    this.clock.set({ at: this.clock.effort === "views" ? Math.round(at) : at, isPlaying: false });
  }

  hover(at: number | null) {
    this.hovered = at;
    this.follow();
  }

  private viewOf(plot: Plot, i: number): PlotView {
    const choice: PlotChoice | undefined = plot.choices[this.chosen[i]];
    const hasMeans = (choice?.means.length ?? 0) > 0;
    const isMean = this.showsMeans && hasMeans;
    const effort = kEfforts.findIndex(([name]) => name === this.clock.effort);
    const figure = (isMean ? choice?.means : choice?.runs)?.[effort];
    const controls = [
      i === 0 && hasMeans ? select("Runs of several seeds",
        [["runs", "Each run"], ["means", "Means"]], isMean ? "means" : "runs", (value) => {
          this.showsMeans = value === "means";
          this.rebuild();
        }) : null,
      plot.choices.length > 1 ? select(plot.chooses, plot.choices.map(({ label: words }, k) =>
        [String(k), words]), String(this.chosen[i]), (value) => {
        this.chosen[i] = Number(value);
        this.rebuild();
      }) : null].filter((control) => control !== null);
    const words = (plot.choices.length > 1 ? `, ${choice.label.replace(/^[A-Z]/, (c) =>
      c.toLowerCase())}` : "") + (isMean ? ", means of seeds" : "");
    return new PlotView(plot, figure ?? { notes: [], panels: [] }, words, this, controls);
  }

  /** The replay's place, and the values there while no cursor asks for others. */
  private follow() {
    for (const view of this.views) view.follow(this.clock.at, this.hovered ?? this.clock.at);
  }

  private fit() {
    for (const view of this.views) view.fit();
    this.follow();
  }
}
