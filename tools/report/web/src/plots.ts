// The plots: one cursor for all, the replay's place in each; a click moves the replay there.
import uPlot from "uplot";
import type { Clock } from "./clock";
import { hairline, paleInk, phaseShade, runColour } from "./colours";
import { make, select } from "./dom";
import { lastAtMost, type Flight } from "./flight";
import * as specs from "./plot_specs";
import { kShade, plotSvg, type FrontierStrip } from "./plot_svg";
import { fileName, saveText } from "./save";
import { haveSeeds, withBands } from "./seed_bands";

const kUnits = { views: "views", metres: "m", seconds: "s" };
const kEffortNames = { views: "Views", metres: "Metres from the first view on, straight",
  seconds: "Seconds from the first view on" };
const kFont = "11px system-ui, sans-serif";
const kHeight = 168;
const kLane_px = 9; // of the frontier views of one of several runs, above the curves

interface PlotKind {
  title: string;
  unit: (flights: Flight[]) => string;
  content: (flights: Flight[], clock: Clock, choices: specs.PlotChoices) => specs.PlotContent;
  decimals: number;
  control?: "size" | "term";
}

const kKinds: PlotKind[] = [
  { title: "Coverage", unit: () => "%", decimals: 1, control: "size",
    content: (f, clock, choices) => specs.coverage(f, clock.effort, choices) },
  { title: "Entropy of the map", unit: () => "nat", decimals: 0,
    content: (f, clock) => specs.entropy(f, clock.effort) },
  { title: "Density", unit: () => "points a voxel", decimals: 1,
    content: (f, clock) => specs.density(f, clock.effort) },
  { title: "Utility of the chosen views", decimals: 3, control: "term",
    unit: specs.termUnit,
    content: (f, clock, choices) => specs.terms(f, clock.effort, choices) },
];

export class Plots {
  readonly element = make("section", { class: "plots", "aria-label": "Plots" });
  private plots: uPlot[] = [];
  private readonly beginsBefore = new WeakMap<uPlot, boolean>(); // see PlotContent
  private flights: Flight[] = [];
  private effort = "";
  private readonly choices: specs.PlotChoices = { size: 0, term: "utility", bands: false };

  constructor(private readonly clock: Clock) {
    clock.onChange(() => {
      if (clock.effort !== this.effort) this.rebuild();
      else this.followClock();
    });
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  setFlights(flights: Flight[]) {
    this.flights = flights;
    this.rebuild();
  }

  rebuild() {
    this.effort = this.clock.effort;
    for (const plot of this.plots) plot.destroy();
    this.plots = [];
    this.element.replaceChildren();
    for (const kind of kKinds) this.add(kind);
    this.fit();
    this.followClock();
  }

  private add(kind: PlotKind) {
    const ofRuns = kind.content(this.flights, this.clock, this.choices);
    const content = this.choices.bands && haveSeeds(this.flights)
      ? withBands(ofRuns, this.flights, this.clock.effort) : ofRuns;
    content.rings = content.rings.filter((ring) => ring.x <= this.lastEffort());
    const hasValues = content.lines.length > 0 && content.data[0].length > 0;
    const place = make("div", { class: "plot-place" });
    this.element.append(make("figure", { class: "card plot" },
      make("figcaption", {}, make("span", { class: "plot-title" }, kind.title),
        make("span", { class: "unit" }, kind.unit(this.flights)), this.marksKey(kind, content),
        kind === kKinds[0] ? this.seedControl() : null, this.control(kind)),
      hasValues ? place : make("p", { class: "nothing" }, "Not recorded by this run.")));
    if (!hasValues) return;
    const lanes = kind === kKinds[0] && this.flights.length > 1 ? this.frontierFlights() : [];
    const plot = new uPlot(this.options(kind, content, lanes.length), content.data, place);
    this.plots.push(plot);
    this.beginsBefore.set(plot, content.beginsBefore);
    this.addLanes(plot, lanes);
    const title = `${kind.title} ${kind.unit(this.flights)}`.trim();
    place.before(make("button", { type: "button", class: "small save",
      title: `${kind.title} as SVG`, click: () => saveText(
        plotSvg(plot, content.lines, this.strips(lanes), title, kEffortNames[this.clock.effort]),
        "image/svg+xml", `${fileName(kind.title)}.svg`) }, "SVG"));
  }

  /** What the marks of a plot mean, where it has any. */
  private marksKey(kind: PlotKind, content: specs.PlotContent): HTMLElement | null {
    const marks: Node[] = [];
    if (content.rings.length > 0) marks.push(make("span", {}, "○ paper's end"));
    if (kind === kKinds[0] && this.frontierFlights().length > 0) {
      const isAlone = this.flights.length === 1;
      marks.push(make("span", {}, make("i", { class: isAlone ? "swatch" : "swatch strip" }),
        isAlone ? "frontier views (FVS)" : "FVS: when each run chose frontier views"));
    }
    return marks.length > 0 ? make("span", { class: "marks-key" }, ...marks) : null;
  }

  /** The line at the replay's place, and the values there while no cursor asks for others. */
  private followClock() {
    for (const plot of this.plots) {
      this.placeNow(plot);
      if ((plot.cursor.left ?? -1) < 0) this.showValues(plot);
    }
  }

  private showValues(plot: uPlot) {
    const idx = lastAtMost(plot.data[0], this.clock.at + 1e-9); // of none there are no values
    plot.setLegend({ idx: idx < 0 && this.beginsBefore.get(plot) ? 0 : idx }, false);
  }

  private seedControl(): HTMLElement | null {
    if (!haveSeeds(this.flights)) return null;
    return select("Runs of several seeds", [["runs", "Each run"], ["bands", "Mean and range"]],
      this.choices.bands ? "bands" : "runs", (value) => {
        this.choices.bands = value === "bands";
        this.rebuild();
      });
  }

  private control(kind: PlotKind): HTMLElement | null {
    if (this.flights.length < 2 || !kind.control) return null;
    if (kind.control === "size") {
      return select("Voxel size of the coverage", specs.kSizes.map((s, i) => [String(i), s]),
        String(this.choices.size), (value) => {
          this.choices.size = Number(value) as 0 | 1 | 2;
          this.rebuild();
        });
    }
    return select("Term of the utility", specs.kTerms, this.choices.term, (value) => {
      this.choices.term = value;
      this.rebuild();
    });
  }

  /** Of all plots alike: where the longest run ends, or the paper's if that is not much farther. */
  private lastEffort(): number {
    const { effort } = this.clock;
    const ours = Math.max(...this.flights.map((flight) => flight.last(effort)), 1e-6);
    const papers = this.flights.map((flight) => flight.data.paper?.[effort] ?? 0);
    return Math.max(ours, ...papers.filter((end) => end <= 1.2 * ours));
  }

  private options(kind: PlotKind, content: specs.PlotContent, lanes: number): uPlot.Options {
    const unit = kUnits[this.clock.effort];
    const axis = { stroke: paleInk(), font: kFont, grid: { stroke: hairline(), width: 1 },
      ticks: { stroke: hairline(), width: 1, size: 4 } };
    const text = (v: number | null) => (v === null || v === undefined ? "" :
      v.toLocaleString("en-US", Math.abs(v) >= 1000 ? { maximumFractionDigits: 0 }
        : { maximumFractionDigits: kind.decimals, minimumFractionDigits: kind.decimals }));
    const most = this.lastEffort();
    return {
      width: 400,
      height: kHeight + kLane_px * lanes,
      padding: [8 + kLane_px * lanes, 12, 0, 0],
      cursor: { sync: { key: "mission" }, drag: { x: false, y: false }, points: { size: 6 },
        y: false },
      legend: { live: true },
      scales: { x: { time: false, range: [0, most] },
        y: { range: (_, low, high) => yRange(low, high, content.rings) } },
      axes: [{ ...axis, size: 26, space: 60, label: kEffortNames[this.clock.effort], labelSize: 14,
        labelFont: kFont, labelGap: -2,
        values: (_, ticks) => ticks.map((t) => t.toLocaleString("en-US")) },
        { ...axis, size: 60, space: 24,
          values: (_, ticks) => ticks.map((t) => t.toLocaleString("en-US")) }],
      series: [{ label: unit, value: (_, v) => text2(v, unit) },
        ...content.lines.map((line) => ({ label: line.name, stroke: line.colour,
          width: line.width, dash: line.dash, spanGaps: true, points: { show: false },
          value: (plot: uPlot, _: number, series: number, i: number | null) =>
            text(lastValue(plot.data[series], i)) }))],
      bands: (content.bands ?? []).map(({ high, low, fill }) => ({ series: [high, low], fill })),
      hooks: {
        drawClear: [(plot) => this.shadePhases(plot)],
        draw: [(plot) => drawRings(plot, content.rings)],
        ready: [(plot) => this.followClicks(plot), (plot) => this.addNow(plot)],
        setCursor: [(plot) => { if ((plot.cursor.left ?? -1) < 0) this.showValues(plot); }],
      },
    };
  }

  private frontierFlights(): Flight[] {
    return this.flights.filter((flight) => flight.data.views.sampler.includes("fvs"));
  }

  /** What a saved plot shows of them: each of several runs' lanes, or one run's shade. */
  private strips(lanes: Flight[]): FrontierStrip[] {
    const isAlone = this.flights.length === 1;
    return (isAlone ? this.flights : lanes).map((flight) => ({
      colour: isAlone ? kShade : runColour(flight.index), isBehind: isAlone,
      phases: specs.frontierPhases(flight, this.clock.effort) }));
  }

  /** Behind the curves of one run. */
  private shadePhases(plot: uPlot) {
    if (this.flights.length !== 1) return;
    const { ctx, bbox } = plot;
    ctx.fillStyle = phaseShade();
    for (const [from, to] of specs.frontierPhases(this.flights[0], this.clock.effort)) {
      const x = plot.valToPos(from, "x", true);
      ctx.fillRect(x, bbox.top, Math.max(1, plot.valToPos(to, "x", true) - x), bbox.height);
    }
  }

  /** A lane a run above the curves, which no curve enters: bars where it chose frontier views. */
  private addLanes(plot: uPlot, flights: Flight[]) {
    const share = (at: number) => 100 * Math.min(1, at / this.lastEffort());
    const lanes = make("div", { class: "phase-lanes" });
    flights.forEach((flight) => {
      const lane = make("div", { class: "phase-lane", title: `${flight.data.label}: when it chose `
        + "frontier views (FVS)" });
      for (const [from, to] of specs.frontierPhases(flight, this.clock.effort)) {
        const bar = make("i");
        bar.style.left = `${share(from)}%`;
        bar.style.width = `max(2px, ${share(to) - share(from)}%)`;
        bar.style.background = runColour(flight.index);
        lane.append(bar);
      }
      lanes.append(lane);
    });
    if (flights.length > 0) plot.over.append(lanes);
  }

  /** An element of its own: moving it draws no plot anew. */
  private addNow(plot: uPlot) {
    plot.over.append(make("div", { class: "now" }));
    this.placeNow(plot);
  }

  /** For paper, on which the picture of a plot is scaled: where the curves lie in it. */
  private tellPlace(plot: uPlot) {
    const { width, height } = plot.ctx.canvas;
    const { left, top, width: across, height: down } = plot.bbox;
    const shares = { left: left / width, top: top / height, width: across / width,
      height: down / height };
    for (const [name, share] of Object.entries(shares)) {
      plot.over.style.setProperty(`--${name}`, `${100 * share}%`);
    }
  }

  private placeNow(plot: uPlot) {
    const x = plot.valToPos(Math.max(0, this.clock.at), "x");
    const line = plot.over.querySelector<HTMLElement>(".now");
    if (line && Number.isFinite(x)) line.style.transform = `translateX(${x.toFixed(1)}px)`;
  }

  private followClicks(plot: uPlot) {
    const move = (event: MouseEvent) => {
      const left = event.clientX - plot.over.getBoundingClientRect().left;
      const at = plot.posToVal(left, "x");
      this.clock.set({ at: this.clock.effort === "views" ? Math.round(at) : at, isPlaying: false });
    };
    plot.over.addEventListener("mousedown", move);
    plot.over.addEventListener("mousemove", (event) => { if (event.buttons === 1) move(event); });
  }

  private fit() {
    for (const plot of this.plots) {
      const width = plot.root.parentElement!.clientWidth;
      if (width > 0 && width !== plot.width) plot.setSize({ width, height: plot.height });
      this.placeNow(plot);
      this.tellPlace(plot);
    }
  }
}

const text2 = (v: number | null, unit: string) => (v === null || v === undefined ? ""
  : `${v.toLocaleString("en-US", { maximumFractionDigits: 1 })} ${unit}`);

/** Of a run at an effort at which another one has a view: its latest value. */
function lastValue(values: ArrayLike<number | null | undefined>, at: number | null): number | null {
  for (let i = at ?? -1; i >= 0; --i) {
    const value = values[i];
    if (value !== null && value !== undefined) return value;
  }
  return null;
}

/** Room above and below, and for the paper's rings; never below zero when nothing is. */
function yRange(low: number, high: number, rings: specs.Ring[]): [number, number] {
  const values = [low, high, ...rings.map((ring) => ring.y)].filter(Number.isFinite);
  if (values.length === 0) return [0, 1];
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const room = 0.06 * (most - least || Math.abs(most) || 1);
  return [least >= 0 && least - room < 0 ? 0 : least - room, most + room];
}

function drawRings(plot: uPlot, rings: specs.Ring[]) {
  const { ctx } = plot;
  for (const ring of rings) {
    ctx.beginPath();
    ctx.lineWidth = 1.6 * devicePixelRatio;
    ctx.strokeStyle = ring.colour;
    ctx.arc(plot.valToPos(ring.x, "x", true), plot.valToPos(ring.y, "y", true),
      4 * devicePixelRatio, 0, 2 * Math.PI);
    ctx.stroke();
  }
}
