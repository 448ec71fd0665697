// The plots: one cursor for all, the replay's place in each; a click moves the replay there.
import uPlot from "uplot";
import type { Clock } from "./clock";
import { hairline, paleInk, runColour } from "./colours";
import { make, select } from "./dom";
import { lastAtMost, type Flight } from "./flight";
import { chosenWords, kEffortNames, kKinds, kUnits, lastValue, valueText, yRange,
  type PlotKind } from "./plot_kinds";
import { drawRings, frontierFlights, makeLanes, marksKey, shadePhases } from "./plot_marks";
import * as specs from "./plot_specs";
import { kOfFile, kOfPage, kShade, plotSvg, type FrontierStrip } from "./plot_svg";
import { fileName, saveText } from "./save";
import { haveSeeds, withBands } from "./seed_bands";

const kFont = "11px system-ui, sans-serif";
const kHeight = 168;
const kTallHeight = 260; // where all terms cross each other
const kLane_px = 9; // of the frontier views of one of several runs, above the curves
const kRoom = 1.02; // right of the last view, so that no mark lies on the edge

export class Plots {
  readonly element = make("section", { class: "plots", "aria-label": "Plots" });
  private plots: uPlot[] = [];
  private readonly beginsBefore = new WeakMap<uPlot, boolean>(); // see PlotContent
  private flights: Flight[] = [];
  private effort = "";
  private readonly choices: specs.PlotChoices = { size: 0, term: "utility", bands: false };

  /** Plots are `paper_px` high where they are 350 px wide, on paper. */
  constructor(private readonly clock: Clock, private readonly paper_px: number) {
    clock.onChange(() => {
      if (clock.effort !== this.effort) this.rebuild();
      else this.followClock();
    });
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  setFlights(flights: Flight[]) {
    this.flights = flights;
    const { choices } = this;
    if (!specs.termOptions(flights).some(([term]) => term === choices.term)) {
      choices.term = "utility";
    }
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
    const content = this.contentOf(kind);
    const hasValues = content.lines.length > 0 && content.data[0].length > 0;
    const place = make("div", { class: "plot-place" });
    const words = chosenWords(kind, this.flights, this.choices, haveSeeds(this.flights));
    const unit = kind.unit(this.flights, this.choices);
    const isFirst = kind === kKinds[0];
    this.element.append(make("figure", { class: "card plot" },
      make("figcaption", {}, make("span", { class: "plot-title", title: kind.note ?? "" }, kind.title),
        make("span", { class: "plot-choice" }, words),
        make("span", { class: "unit" }, unit), marksKey(content, isFirst ? this.flights : []),
        isFirst ? this.seedControl() : null, this.control(kind)),
      hasValues ? place : make("p", { class: "nothing" }, "Not recorded by this run.")));
    if (!hasValues) return;
    const lanes = isFirst && this.flights.length > 1 ? frontierFlights(this.flights) : [];
    const plot = new uPlot(this.options(kind, content, lanes.length), content.data, place);
    this.plots.push(plot);
    this.beginsBefore.set(plot, content.beginsBefore);
    if (lanes.length > 0) plot.over.append(makeLanes(lanes, this.clock.effort, this.lastX()));
    const drawn = { ...content, strips: this.strips(lanes),
      xName: kEffortNames[this.clock.effort] };
    place.before(make("button", { type: "button", class: "small save",
      title: `${kind.title} as SVG`, click: () => saveText(
        plotSvg(plot, drawn, { ...kOfFile, title: `${kind.title}${words} ${unit}`.trim() }),
        "image/svg+xml", `${fileName(kind.title)}.svg`) }, "SVG"));
    // what paper shows in the place of the canvas, sharp at any size; its axes come a moment later
    plot.hooks.ready!.push(() => place.prepend(new DOMParser().parseFromString(
      plotSvg(plot, drawn, { ...kOfPage, height: this.paper_px }), "image/svg+xml").documentElement));
  }

  private contentOf(kind: PlotKind): specs.PlotContent {
    const ofRuns = kind.content(this.flights, this.clock, this.choices);
    const content = this.choices.bands && haveSeeds(this.flights)
      ? withBands(ofRuns, this.flights, this.clock.effort) : specs.withDashes(ofRuns);
    content.rings = content.rings.filter((ring) => ring.x <= this.lastEffort());
    return content;
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
    if (kind.control === "size" && this.flights.length > 1) {
      return select("Voxel size of the coverage", specs.kSizes.map((s, i) => [String(i), s]),
        String(this.choices.size), (value) => {
          this.choices.size = Number(value) as 0 | 1 | 2;
          this.rebuild();
        });
    }
    if (kind.control !== "term" || this.flights.length === 0) return null;
    return select("Term of the utility", specs.termOptions(this.flights), this.choices.term,
      (value) => {
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

  private lastX() { return kRoom * this.lastEffort(); }

  private options(kind: PlotKind, content: specs.PlotContent, lanes: number): uPlot.Options {
    const unit = kUnits[this.clock.effort];
    const axis = { stroke: paleInk(), font: kFont, grid: { stroke: hairline(), width: 1 },
      ticks: { stroke: hairline(), width: 1, size: 4 } };
    return {
      width: 400,
      height: (kind.control === "term" && this.choices.term === "all" ? kTallHeight : kHeight)
        + kLane_px * lanes,
      padding: [8 + kLane_px * lanes, 12, 0, 0],
      cursor: { sync: { key: "mission" }, drag: { x: false, y: false }, points: { size: 6 },
        y: false },
      legend: { live: true, markers: { dash: (plot, series) =>
        (plot.series[series].dash ? "dashed" : "solid") } },
      scales: { x: { time: false, range: [0, this.lastX()] },
        y: { range: (_, low, high) => yRange(low, high, content.rings) } },
      axes: [{ ...axis, size: 26, space: 60, label: kEffortNames[this.clock.effort], labelSize: 14,
        labelFont: kFont, labelGap: -2,
        values: (_, ticks) => ticks.map((t) => t.toLocaleString("en-US")) },
        { ...axis, size: 60, space: 24,
          values: (_, ticks) => ticks.map((t) => t.toLocaleString("en-US")) }],
      series: [{ label: unit, value: (_, v) => text2(v, unit) },
        ...content.lines.map((line) => ({ label: line.name, stroke: line.colour,
          width: line.width, dash: line.dash, spanGaps: true, points: { show: false },
          ...(line.steps && { paths: uPlot.paths.stepped!({ align: 1 }) }),
          value: (plot: uPlot, _: number, series: number, i: number | null) =>
            valueText(kind, lastValue(plot.data[series], i)) }))],
      bands: (content.bands ?? []).map(({ high, low, fill }) => ({ series: [high, low], fill })),
      hooks: {
        drawClear: [(plot) => shadePhases(plot, this.flights, this.clock.effort)],
        draw: [(plot) => drawRings(plot, content.rings)],
        ready: [(plot) => this.followClicks(plot), (plot) => this.addNow(plot)],
        setCursor: [(plot) => { if ((plot.cursor.left ?? -1) < 0) this.showValues(plot); }],
      },
    };
  }

  /** What a saved plot shows of them: each of several runs' lanes, or one run's shade. */
  private strips(lanes: Flight[]): FrontierStrip[] {
    const isAlone = this.flights.length === 1;
    return (isAlone ? this.flights : lanes).map((flight) => ({
      colour: isAlone ? kShade : runColour(flight.index), isBehind: isAlone,
      phases: specs.frontierPhases(flight, this.clock.effort) }));
  }

  /** An element of its own: moving it draws no plot anew. */
  private addNow(plot: uPlot) {
    plot.over.append(make("div", { class: "now" }));
    this.placeNow(plot);
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
    }
  }
}

const text2 = (v: number | null, unit: string) => (v === null || v === undefined ? ""
  : `${v.toLocaleString("en-US", { maximumFractionDigits: 1 })} ${unit}`);
