// The plots: one cursor for all, the replay's place in each; a click moves the replay there. What
// they show comes with the page (tools/page/plots.hpp); each is an SVG, on the page, on paper and
// as a file.
import { kEfforts, type Clock } from "./clock";
import { hairline, isDark, onPage, paleInk, runColour } from "./colours";
import type { Plot, PlotChoice, PlotSeries } from "./data";
import { make, number, select, significant } from "./dom";
import { lastAtMost, type Flight } from "./flight";
import { fileName, saveText } from "./save";

const kEffortNames = { views: "Views", metres: "Metres from the first view on, straight",
  seconds: "Seconds from the first view on" };
const kRoom = 1.02; // right of the last view, so that no mark lies on the edge
const kRight = 16;
const kLane = 9;
const kKeys = 4; // a row
const kKeyRow = 14;

/** Of the page, of paper or of a file, which says itself what it shows. */
interface SvgLook { width: number; height: number; left: number; font: number;
  title: string | null }
interface Range { x1: number; y0: number; y1: number }

const escaped = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const label = (x: number, y: number, anchor: string, what: string) => `<text x="${
  x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}" fill="currentColor">${
  escaped(what)}</text>`;
const rect = (x: number, y: number, width: number, height: number, colour: string, more = "") =>
  `<rect x="${x.toFixed(1)}" y="${y.toFixed(1)}" width="${width.toFixed(1)}" height="${
    height.toFixed(1)}" fill="${colour}" ${more}/>`;

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

/** One plot with what is chosen of it, of the runs that are shown. */
class PlotView {
  readonly element: HTMLElement;
  private svg: SVGElement | null = null;
  private readonly place = make("div", { class: "plot-place" });
  private readonly values: HTMLElement[] = [];
  private readonly now = make("i", { class: "now" }); // moving it draws no plot anew
  private readonly range: Range;

  constructor(private readonly plot: Plot, private readonly choice: PlotChoice,
      private readonly series: PlotSeries[], words: string,
      private readonly all: Plots, controls: HTMLElement[]) {
    const papers = new Set(this.rings().map((ring) => ring.label));
    const shaded = this.phased();
    const isAlone = all.flights.length === 1;
    this.range = this.rangeOf();
    const legend = make("div", { class: "values" }, ...series.map((line) => {
      const value = make("b", {});
      this.values.push(value);
      const mark = make("i", { class: "mark line" });
      mark.style.background = all.colourOf(line);
      return make("span", {}, mark, line.label, " ", value);
    }));
    this.element = make("figure", { class: "card plot" }, make("figcaption", {},
      make("span", { class: "plot-title", title: plot.note }, plot.title),
      make("span", { class: "plot-choice" }, words), make("span", { class: "unit" }, choice.unit),
      make("span", { class: "marks-key" },
        ...[...papers].map((paper) => make("span", {}, `○ paper's end: ${paper}`)),
        shaded.length === 0 || plot !== all.plots[0] ? null : make("span", {},
          make("i", { class: isAlone ? "swatch" : "swatch strip" }),
          isAlone ? "frontier views (FVS)" : "FVS: when each run chose frontier views")),
      ...controls),
    ...series.length === 0 ? [make("p", { class: "nothing" }, "Not recorded by this run.")]
      : [this.place, legend, make("button", { type: "button", class: "small save",
        title: `${plot.title} as SVG`, click: () => saveText(this.drawn({ width: 640, height: 400,
          left: 64, font: 11, title: `${plot.title}${words} ${choice.unit}`.trim() }, "file"),
        "image/svg+xml", `${fileName(plot.title)}.svg`) }, "SVG")]);
    for (const kind of ["pointerdown", "pointermove", "pointerleave"] as const) {
      this.place.addEventListener(kind, (event) => this.point(event));
    }
  }

  /** Anew where the page has become narrower or wider. */
  fit() {
    const width = this.place.clientWidth;
    if (width === 0 || (this.svg && width === Number(this.svg.getAttribute("width")))) return;
    const parse = (text: string) => new DOMParser()
      .parseFromString(text, "image/svg+xml").documentElement as unknown as SVGElement;
    const height = 168 + kLane * this.lanes().length + (this.choice.label === "All terms" ? 92 : 0);
    this.svg = parse(this.drawn({ width, height, left: 60, font: 11, title: null }, "screen"));
    this.place.replaceChildren(this.svg, this.now, parse(this.drawn(
      { width: 350, height: this.all.paper_px, left: 44, font: 9, title: null }, "paper")));
  }

  /** The replay's place, and the values at `at`. */
  follow(now: number, at: number) {
    if (!this.svg) return;
    const x = this.frame(Number(this.svg.getAttribute("width"))).px(Math.max(0, now));
    this.now.style.transform = `translateX(${x.toFixed(1)}px)`;
    this.series.forEach((line, i) => {
      const { x, y } = line.by[this.all.effort()];
      let k = lastAtMost(x, at + 1e-9);
      if (k < 0 && line.by[0].x[0] === 0) k = 0; // after the profile alone
      while (k >= 0 && Number.isNaN(y[k])) --k;
      this.values[i].textContent = k < 0 ? "–" : this.text(y[k]) + this.spread(line, k);
    });
  }

  private spread(line: PlotSeries, k: number) {
    const { low, high } = line.by[this.all.effort()];
    return low && high ? ` (${this.text(low[k])} to ${this.text(high[k])})` : "";
  }

  private text(value: number) {
    const { decimals } = this.plot;
    return decimals < 0 ? significant(value)
      : number(value, Math.abs(value) >= 1000 ? 0 : decimals);
  }

  private point(event: PointerEvent) {
    if (!this.svg) return;
    const { left, width } = this.svg.getBoundingClientRect();
    const { w } = this.frame(width);
    const at = this.range.x1 * (event.clientX - left - 60) / w;
    if (event.type === "pointerleave") this.all.hover(null);
    else if (event.buttons === 1) this.all.seek(at);
    else this.all.hover(at);
  }

  private frame(width: number, left = 60) {
    const w = width - left - kRight;
    return { w, px: (x: number) => left + w * x / this.range.x1 };
  }

  private rings() {
    const { effort, last } = this.all;
    return this.choice.rings.filter(({ run, x }) => this.all.isShown(run)
      && x[effort()] !== null && x[effort()]! <= last());
  }

  /** Room above and below, and for the paper's rings; never below zero when nothing is. */
  private rangeOf(): Range {
    let [least, most] = [Infinity, -Infinity];
    const take = (y: number) => { [least, most] = [Math.min(least, y), Math.max(most, y)]; };
    for (const line of this.series) {
      const { y, low, high } = line.by[this.all.effort()];
      for (const value of [...y, ...low ?? [], ...high ?? []]) {
        if (Number.isFinite(value)) take(value);
      }
    }
    for (const { y } of this.rings()) take(y);
    const x1 = kRoom * this.all.last();
    if (least > most) return { x1, y0: 0, y1: 1 };
    const room = 0.06 * (most - least || Math.abs(most) || 1);
    return { x1, y0: least >= 0 && least - room < 0 ? 0 : least - room, y1: most + room };
  }

  /** Whose frontier views are marked: of one run behind all curves, else in the first plot. */
  private phased() {
    const { flights, plots } = this.all;
    return flights.length > 1 && this.plot !== plots[0] ? []
      : flights.filter(({ data }) => data.views.frontier_phases.length > 0);
  }

  /** Or in a lane each above the curves, which no curve enters. */
  private lanes() { return this.all.flights.length > 1 ? this.phased() : []; }

  private drawn(look: SvgLook, where: "screen" | "paper" | "file"): string {
    const { width, height, left, font, title } = look;
    const { x1, y0, y1 } = this.range;
    const isPaper = where !== "screen";
    const effort = this.all.effort();
    const colourOf = (line: PlotSeries) => (isPaper ? line.colour : this.all.colourOf(line));
    const lanes = this.lanes();
    const keys = title === null ? [] : this.series;
    const lanesTop = (title === null ? 8 : 20) + kKeyRow * Math.ceil(keys.length / kKeys);
    const top = lanesTop + kLane * lanes.length;
    const { w, px } = this.frame(width, left);
    const h = height - top - 3.3 * font; // above the numbers and the name of the axis
    const py = (y: number) => top + h * (1 - (y - y0) / (y1 - y0 || 1));
    const grid = `fill="none" stroke="${isPaper ? "#dfe4ea" : hairline()}"`;
    const bars = (flight: Flight, y: number, tall: number, colour: string) =>
      flight.data.views.frontier_phases.map(([from, to]) => {
        const [x0, end] = [from, to].map((n) =>
          px(Math.min(flight.effort(n, this.all.clock.effort), x1)));
        return rect(x0, y, Math.max(1, end - x0), tall, colour);
      }).join("");
    const shade = isPaper || !isDark() ? "#fcf0e1" : "#33291d"; // opaque: not all know rgba()
    const path = (line: PlotSeries) => {
      const { x, y } = line.by[effort];
      let d = "";
      for (let i = 0; i < x.length; ++i) {
        if (Number.isNaN(y[i])) continue;
        if (d && line.is_step) d += `H${px(x[i]).toFixed(1)}V${py(y[i]).toFixed(1)}`;
        else d += `${d ? "L" : "M"}${px(x[i]).toFixed(1)} ${py(y[i]).toFixed(1)}`;
      }
      return `<path fill="none" stroke="${colourOf(line)}" stroke-width="1.6" stroke-dasharray="${
        line.dashes.join(" ") || "none"}" d="${d}"/>`;
    };
    const band = (line: PlotSeries) => {
      const { x, low, high } = line.by[effort];
      if (!low || !high) return "";
      const known = [...x.keys()].filter((i) => Number.isFinite(low[i]));
      const at = (i: number, y: number) => `${px(x[i]).toFixed(1)},${py(y).toFixed(1)}`;
      const points = [...known.map((i) => at(i, high[i])),
        ...known.reverse().map((i) => at(i, low[i]))];
      return `<polygon fill="${colourOf(line)}" fill-opacity="0.22" points="${points.join(" ")}"/>`;
    };
    const key = (i: number) => [left + i % kKeys * 138, 26 + kKeyRow * Math.floor(i / kKeys)];
    const parts = [
      ...lanes.length === 0 ? this.phased().map((flight) => bars(flight, top, h, shade)) : [],
      ...lanes.map((flight, i) =>
        `<g class="phase-lane"><title>${escaped(flight.data.label)}</title>`
        + rect(left, lanesTop + kLane * i, w, kLane - 2, isPaper ? "#dfe4ea" : hairline())
        + bars(flight, lanesTop + kLane * i, kLane - 2, runColour(flight.index)) + "</g>"),
      lanes.length === 0 ? ""
        : label(left - 6, lanesTop + kLane * lanes.length / 2 + 3, "end", "FVS"),
      ...ticks(0, x1, 6).map(([x, name]) => `<path ${grid} d="M${px(x).toFixed(1)} ${top}v${h}"/>`
        + label(px(x), height - 1.9 * font, "middle", name)),
      ...ticks(y0, y1, Math.floor(h / (2 * font))).map(([y, name]) =>
        `<path ${grid} d="M${left} ${py(y).toFixed(1)}h${w}"/>`
        + label(left - 6, py(y) + 0.36 * font, "end", name)),
      ...this.series.map(band), ...this.series.map(path),
      ...this.rings().map((ring) => `<circle cx="${px(ring.x[effort]!).toFixed(1)}" cy="${
        py(ring.y).toFixed(1)}" r="4.5" fill="none" stroke="${ring.colour}" stroke-width="1.6"/>`),
      ...keys.map((line, i) => rect(key(i)[0], key(i)[1] - 9, 10, 10, colourOf(line))
        + label(key(i)[0] + 14, key(i)[1], "start", line.label)),
      title === null ? "" : label(left, 12, "start", title),
      label(left + w / 2, height - 0.5 * font, "middle", kEffortNames[this.all.clock.effort])];
    return `<svg xmlns="http://www.w3.org/2000/svg" class="${where}" `
      + `viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="sans-serif" font-size="${font}" color="${
        isPaper ? "#30363f" : paleInk()}">${parts.join("")}</svg>\n`;
  }
}

export class Plots {
  readonly element = make("section", { class: "plots", "aria-label": "Plots" });
  flights: Flight[] = [];
  private views: PlotView[] = [];
  private shownBy = "";
  private hovered: number | null = null;
  private showsMeans = false;
  private readonly chosen: number[]; // of each plot

  /** Plots are `paper_px` high where they are 350 px wide, on paper. */
  constructor(readonly plots: Plot[], readonly clock: Clock,
      readonly paper_px: number) {
    this.chosen = plots.map(() => 0);
    clock.onChange(() => {
      if (clock.effort !== this.shownBy) this.rebuild(); else this.follow();
    });
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  readonly effort = () => kEfforts.findIndex(([name]) => name === this.clock.effort) as 0 | 1 | 2;
  readonly isShown = (run: number) => run < 0 || this.flights.some(({ index }) => index === run);
  colourOf(line: PlotSeries) { return `#${onPage(line.colour).getHexString()}`; }

  /** Of all plots alike: where the longest run ends, or the paper's if that is not much farther. */
  readonly last = () => {
    const { effort } = this.clock;
    const ours = Math.max(...this.flights.map((flight) => flight.last(effort)), 1e-6);
    const papers = this.flights.map(({ data: { paper } }) => paper?.[effort] ?? 0);
    return Math.max(ours, ...papers.filter((end) => end <= 1.2 * ours));
  };

  setFlights(flights: Flight[]) {
    this.flights = flights;
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
    const choice = plot.choices[this.chosen[i]];
    const hasMeans = plot.choices.some(({ means }) => means.some(({ run }) => run >= 0));
    const isMean = this.showsMeans && hasMeans;
    const means = choice.means.filter(({ run }) => this.isShown(run));
    const controls = [
      i === 0 && hasMeans ? select("Runs of several seeds",
        [["runs", "Each run"], ["bands", "Mean and range"]], isMean ? "bands" : "runs", (value) => {
          this.showsMeans = value === "bands";
          this.rebuild();
        }) : null,
      plot.choices.length > 1 ? select(plot.chooses, plot.choices.map(({ label: words }, k) =>
        [String(k), words]), String(this.chosen[i]), (value) => {
        this.chosen[i] = Number(value);
        this.rebuild();
      }) : null].filter((control) => control !== null);
    const words = (plot.choices.length > 1 ? `, ${choice.label.replace(/^[A-Z]/, (c) =>
      c.toLowerCase())}` : "") + (isMean ? ", mean and range of seeds" : "");
    return new PlotView(plot, choice, isMean ? means
      : choice.series.filter(({ run }) => this.isShown(run)), words, this, controls);
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
