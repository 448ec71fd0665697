// The plots: one cursor for all, the replay's place in each; a click moves the replay there. What
// they show comes with the page (tools/figures/figures.schema.json); each is an SVG, on the page, on
// paper and as a file.
import { kEfforts, type Clock } from "./clock";
import { cssOnPage } from "./colours";
import type { Plot, PlotChoice } from "./data";
import { fileName, make, mark, number, saveFile, select, significant } from "./dom";
import { lastAtMost } from "./flight";

/** Of figures.schema.json, with numbers as arrays in which NaN is what is not known. */
interface Axis { label: string; low: number; high: number; ticks: { at: number; text: string }[] }
interface Series { name: string; label: string; mark: "line" | "steps" | "level" | "interval";
  colour: string; dashes: number[]; width_pt: number; x: Float64Array; y: Float64Array;
  low: Float64Array; high: Float64Array; end: (number | null)[] | null }
interface Panel { x: Axis; y: Axis; shades: { label: string; spans: number[][] }; series: Series[] }
export interface Figure { notes: string[]; panels: Panel[] }

const kLeft = 60;
const kRight = 16;
const kPaper_px = 450;
const kFont_px = 11;
const kLane = 9; // of a panel of intervals
const kKeys = 4; // a row
const kKeyRow = 14;

/** Of the page, or of a file, which has a title and cannot know the page's colours. */
interface SvgLook { width: number; height: number; left: number; title?: string }

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
  const { width, left, title } = look;
  const [line, shade] = title ? ["#dfe4ea", "#fcf0e1"] : ["var(--line)", "var(--phase)"];
  const colour = (one: Series) => (title ? one.colour : cssOnPage(one.colour));
  const [w, h] = [width - left - kRight, bottom - top];
  const px = (at: number) => left + w * (at - x.low) / (x.high - x.low);
  const py = (at: number) => bottom - h * (at - y.low) / (y.high - y.low || 1);
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
    const line_px = Math.max(0.8, 1.6 * one.width_pt);
    const dashes = one.dashes.map((dash) => (dash * line_px).toFixed(1)).join(" ");
    return `${band}<path fill="none" stroke="${colour(one)}" stroke-width="${
      line_px.toFixed(1)}" stroke-dasharray="${dashes || "none"}" d="M${way}"/>${endX === null || endY === null ? ""
      : `<circle cx="${px(endX).toFixed(1)}" cy="${py(endY).toFixed(1)}" r="3.5" fill="${
        colour(one)}"/>`}`;
  };
  const grid = `<path fill="none" stroke="${line}" d="`;
  return [...shades.spans.map(([from, to]) => rect(px(from), top, px(to) - px(from), h, shade)),
    ...!isLast ? [] : x.ticks.map(({ at, text }) => `${grid}M${px(at).toFixed(1)} ${top}v${h}"/>`
      + label(px(at), bottom + 1.4 * kFont_px, "middle", text)),
    ...y.ticks.map(({ at, text }) => (isLast ? `${grid}M${left} ${py(at).toFixed(1)}h${w}"/>` : "")
      + label(left - 6, py(at) + 0.36 * kFont_px, "end", text)),
    ...series.map(draw),
    isLast ? label(left + w / 2, bottom + 2.8 * kFont_px, "middle", x.label) : ""].join("");
}

/** One plot with what is chosen of it, of the runs that are shown. */
class PlotView {
  readonly element = make("figure", { class: "card plot" });
  private chosen = 0;
  private panels: Panel[] = [];
  private named: { series: Series; value: HTMLElement }[] = [];
  private width = 0; // as it is drawn
  private readonly place = make("div", { class: "plot-place" });
  private readonly now = make("i", { class: "now" }); // moving it draws no plot anew

  constructor(private readonly plot: Plot, private readonly all: Plots) {
    for (const kind of ["pointerdown", "pointermove", "pointerleave"] as const) {
      this.place.addEventListener(kind, (event) => this.point(event));
    }
  }

  build() {
    const { plot, all } = this;
    const choice: PlotChoice | undefined = plot.choices[this.chosen];
    const hasMeans = (choice?.means.length ?? 0) > 0;
    const isMean = hasMeans && all.showsMeans;
    const figure: Figure | undefined = (isMean ? choice?.means : choice?.runs)?.[all.effort()];
    this.panels = figure?.panels.map((panel) => ({ ...panel,
      series: panel.series.filter(({ name }) => !all.hidden.includes(name)) }))
      .filter(({ series }) => series.length > 0) ?? [];
    const main = this.panels.at(-1);
    this.named = main?.series.filter(({ label }) => label !== "")
      .map((series) => ({ series, value: make("b") })) ?? [];
    const words = (plot.choices.length > 1 ? `, ${choice.label.replace(/^[A-Z]/, (c) =>
      c.toLowerCase())}` : "") + (isMean ? ", means of seeds" : "");
    const isFirst = plot === all.plots[0];
    this.width = 0;
    this.element.replaceChildren(make("figcaption", {},
      make("span", { class: "plot-title", title: plot.note }, plot.title),
      make("span", { class: "plot-choice" }, words),
      make("span", { class: "unit" }, main?.y.label ?? ""),
      make("span", { class: "marks-key" },
        ...figure?.notes.map((note) => make("span", {}, note)) ?? [],
        ...this.panels.filter(isLanes).map(({ y }) =>
          make("span", {}, mark("line", "var(--pale)"), y.label)),
        isFirst && main && main.shades.spans.length > 0
          ? make("span", {}, mark("dot", "var(--phase)"), main.shades.label) : null),
      isFirst && hasMeans ? select("Runs of several seeds",
        [["runs", "Each run"], ["means", "Means"]], isMean ? "means" : "runs",
        (value) => all.build({ showsMeans: value === "means" })) : null,
      plot.choices.length > 1 ? select(plot.chooses, plot.choices.map(({ label: name }, k) =>
        [String(k), name]), String(this.chosen), (value) => {
        this.chosen = Number(value);
        all.build();
      }) : null),
    ...!main ? [make("p", { class: "nothing" }, "Not recorded by this run.")]
      : [this.place, make("div", { class: "values" }, ...this.named.map(({ series, value }) =>
        make("span", {}, mark("line", cssOnPage(series.colour)), series.label, " ", value))),
      make("button", { class: "small save", title: `${plot.title} as SVG`, click: () => {
        const svg = this.drawn({ width: 640, height: 400, left: 64,
          title: `${plot.title}${words} ${main.y.label}`.trim() });
        saveFile(new Blob([svg], { type: "image/svg+xml" }), `${fileName(plot.title)}.svg`);
      } }, "SVG")]);
  }

  /** Anew where the page has become narrower or wider. */
  fit(width = this.place.clientWidth) {
    if (width === 0 || width === this.width || this.panels.length === 0) return;
    this.width = width;
    this.place.innerHTML = this.drawn({ width, height: 168 + heightOf(this.panels), left: kLeft });
    this.place.append(this.now);
  }

  /** The replay's place, and the values at `at`. */
  follow(now: number, at: number, room: number) {
    if (this.width === 0) return;
    const { x: { high } } = this.panels.at(-1)!;
    const px = kLeft + (this.width - kLeft - kRight) * Math.max(0, now) / high;
    this.now.style.left = `${100 * px / this.width}%`; // also where it is printed narrower
    for (const { value, series: { mark: kind, x, y, low, high: most } } of this.named) {
      let k = kind === "level" ? 0 : lastAtMost(x, at + 1e-9);
      if (k < 0 && x[0] <= at + room + 1e-9) k = 0; // after the profile alone
      while (k >= 0 && Number.isNaN(y[k])) --k;
      const range = k >= 0 && low.length > 0 ? ` (${valueText(low[k])} to ${valueText(most[k])})` : "";
      value.textContent = k < 0 ? "–" : valueText(y[k]) + range;
    }
  }

  private point(event: PointerEvent) {
    const { left, width } = this.place.getBoundingClientRect();
    const at = this.panels.at(-1)!.x.high * (event.clientX - left - kLeft) / (width - kLeft - kRight);
    if (event.type === "pointerleave") this.all.hover(null);
    else if (event.buttons === 1) this.all.seek(at);
    else this.all.hover(at);
  }

  private drawn(look: SvgLook): string {
    const { width, height, left, title } = look;
    const keys = title ? this.named : [];
    const parts = keys.map(({ series: { colour, label: words } }, i) => {
      const [x, y] = [left + i % kKeys * 138, 26 + kKeyRow * Math.floor(i / kKeys)];
      return rect(x, y - 9, 10, 10, colour) + label(x + 14, y, "start", words);
    });
    if (title) parts.push(label(left, 12, "start", title));
    let top = (title ? 20 : 8) + kKeyRow * Math.ceil(keys.length / kKeys);
    for (const panel of this.panels) {
      const isLast = panel === this.panels.at(-1);
      const bottom = isLast ? height - 3.3 * kFont_px : top + heightOf([panel]);
      parts.push(drawPanel(panel, look, top, bottom, isLast));
      top = bottom;
    }
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" `
      + `width="${width}" height="${height}" font-family="sans-serif" font-size="${kFont_px}" `
      + `color="${title ? "#30363f" : "var(--pale)"}">${parts.join("")}</svg>\n`;
  }
}

const valueText = (value: number) =>
  (Math.abs(value) >= 1000 ? number(value) : significant(value));

export class Plots {
  readonly element = make("section", { class: "plots", "aria-label": "Plots" });
  hidden: string[] = []; // labels of runs
  showsMeans = false;
  private readonly views: PlotView[];
  private shownBy = "";
  private hovered: number | null = null;

  constructor(readonly plots: Plot[], private readonly clock: Clock) {
    this.views = plots.map((plot) => new PlotView(plot, this));
    this.element.append(...this.views.map(({ element }) => element));
    clock.onChange(() => {
      if (clock.effort !== this.shownBy) this.build(); else this.follow();
    });
    new ResizeObserver(() => this.fit()).observe(this.element);
    addEventListener("beforeprint", () => this.fit(kPaper_px));
    addEventListener("afterprint", () => this.fit());
  }

  /** Index of the clock's, as figures come. */
  effort() { return kEfforts.findIndex(([name]) => name === this.clock.effort); }

  /** Anew, with what has changed. */
  build(change: Partial<Pick<Plots, "hidden" | "showsMeans">> = {}) {
    Object.assign(this, change);
    this.shownBy = this.clock.effort;
    for (const view of this.views) view.build();
    this.fit();
  }

  seek(at: number) { this.clock.moveTo(this.clock.effort === "views" ? Math.round(at) : at); }

  hover(at: number | null) {
    this.hovered = at;
    this.follow();
  }

  /** The replay's place, and the values there while no cursor asks for others. */
  private follow() {
    const { at } = this.clock;
    for (const view of this.views) view.follow(at, this.hovered ?? at, this.clock.room());
  }

  private fit(width?: number) {
    for (const view of this.views) view.fit(width);
    this.follow();
  }
}
