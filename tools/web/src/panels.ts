// Everything that is text, tables and pictures.
import { rampGradient } from "./colours";
import type { FrameData, PageData, RunData, Table } from "./data";
import { colourBar, make, measure, number, ofRun, toggle, type Child } from "./dom";
import type { Flight } from "./flight";

/** A name whose unit no line breaks off. */
const bound = (name: string) => name.replace(/ (\(?m\)?|\(min\))$/, "\u00a0$1");

/** "label: " where there are several runs. */
export const ofLabel = (runs: unknown[], { label }: RunData) =>
  (runs.length > 1 ? `${label}: ` : "");

export function makeTiles({ key_figures }: RunData): HTMLElement {
  const hasPapers = key_figures.some(({ paper }) => paper !== "");
  const tiles = make("dl", { class: "tiles" }, ...key_figures.map(({ name, value, unit, paper }) =>
    make("div", { class: "card tile" }, make("dt", {}, bound(name)),
      make("dd", {}, value, make("span", { class: "unit" }, unit)),
      hasPapers ? make("dd", { class: "paper" }, paper && `paper ${measure(paper, unit)}`) : null)));
  tiles.style.setProperty("--in-two-rows", String(Math.ceil(key_figures.length / 2)));
  tiles.style.setProperty("--in-one-row", String(key_figures.length));
  return tiles;
}

/** A row a run; its box chooses whether it is shown. */
export function makeRunTable(runs: RunData[], shown: Set<number>,
    change: () => void): HTMLElement {
  const heads = [...new Set(runs.flatMap((run) => run.key_figures.map(({ name }) => name)))];
  const row = (run: RunData, index: number) => {
    const box = toggle(run.label, shown.has(index), (on) => {
      if (on) shown.add(index); else shown.delete(index);
      change();
    });
    return [ofRun("chip", index, box), ...heads.map((head) => {
      const figure = run.key_figures.find(({ name }) => name === head);
      return figure ? measure(figure.value, figure.unit) : "";
    })];
  };
  return tableOf("runs", ["Shown below", ...heads.map(bound)], (i) => i > 0, runs.map(row));
}

/** `heads` of columns, some of numbers, over rows, of which some are ours. */
export function tableOf(kind: string, heads: string[], isNumber: (column: number) => boolean,
    rows: Child[][], isOurs = (_row: number) => false): HTMLElement {
  const numberClass = (column: number) => (isNumber(column) ? "number" : "");
  return make("div", { class: "card scroll" }, make("table", { class: kind },
    make("thead", {}, make("tr", {}, ...heads.map((head, i) =>
      make("th", { scope: "col", class: numberClass(i) }, head)))),
    make("tbody", {}, ...rows.map((row, k) => make("tr", { class: isOurs(k) ? "ours" : "" },
      ...row.map((cell, i) => make(i > 0 ? "td" : "th", { class: numberClass(i) }, cell)))))));
}

export function makeTable({ title, columns, rows, notes }: Table): HTMLElement {
  const ours = columns.findIndex(({ head }) => head === "Row");
  return make("div", {}, make("h3", {}, title),
    tableOf("", columns.map(({ head }) => bound(head)), (column) => columns[column].is_number,
      rows.map((row) => row.map((cell) => cell.replace(/(\d)%$/, "$1\u00a0%"))),
      (row) => rows[row][ours] === "ours"),
    make("ul", { class: "notes" }, ...notes.map((note) => make("li", {}, ...withCode(note)))));
}

export function makeMissing(runs: RunData[]): HTMLElement | null {
  const sentences = runs.flatMap((run) => run.missing.map((sentence) =>
    make("li", {}, ofLabel(runs, run), ...withCode(sentence))));
  if (sentences.length === 0) return null;
  return make("details", { class: "card missing" },
    make("summary", {}, sentences.length === 1 ? "One thing is not shown"
      : `${sentences.length} things are not shown`),
    make("ul", {}, ...sentences));
}

/** `commands` between backticks as code. */
const withCode = (sentence: string): Child[] =>
  sentence.split("`").map((part, i) => (i % 2 === 1 ? make("code", {}, part) : part));

export const makeConfiguration = (runs: RunData[]) =>
  make("section", {}, make("h2", {}, "Fly it again"),
    ...runs.map((run, i) => make("div", { class: "card again" },
      runs.length > 1 ? ofRun("chip", i, run.label) : null,
      make("p", {}, make("code", {}, run.command)),
      run.figures ? make("p", { class: "fine" },
        `gnbv ${run.figures.version}, seed ${run.seed}, preset ${run.preset}; result_sha256 `,
        make("code", {}, run.figures.result_sha256)) : null,
      make("details", {}, make("summary", {}, "Configuration: scenario.yaml"),
        make("pre", { tabindex: 0 }, run.yaml)))));

/** A name of ours, "lab_model"; of the user's, a file's for one, as it is. */
const spaced = (name: string) => (/^[a-z0-9_]+$/.test(name) ? name.replaceAll("_", " ") : name);

const kSamplers: Record<string, string> = { agvs: "grid", fvs: "frontier" };

/** "15 of 80 grid candidates valid": of the sampler that chose the view. */
export function validWords(flight: Flight, view: number): string {
  const v = flight.data.views;
  return `${number(v.valid[view])} of ${number(v.candidates[view])} `
    + `${kSamplers[v.sampler[view]] ?? v.sampler[view]} candidates valid`;
}

/** Where the replay is, in words. */
export function readout(flight: Flight): string {
  const { n } = flight;
  if (n === 0) return "Before the first view";
  const v = flight.data.views;
  const coverage = flight.data.figures?.curve[n];
  const decision = v.sampler[n - 1] === "tour"
    ? [`the first of ${number(v.candidates[n - 1])} planned`]
    : v.candidates[n - 1] > 0 ? [flight.burstWords(n - 1), validWords(flight, n - 1)] : [];
  return [`View ${number(n)} of ${number(flight.count)}`,
    `${measure(number(v.metres[n - 1], 1), "m")}, `
      + `${measure(number(v.seconds[n - 1] / 60, 1), "min")} from the first view on`,
    coverage === undefined ? "" : `coverage ${measure(number(100 * coverage, 1), "%")}`,
    ...decision].filter((part) => part).join("  ·  ");
}

/** What of the run directory the page leaves out. */
function thinning(run: RunData, { runs, meshes }: PageData): string {
  const parts: string[] = [];
  if (run.cloud && run.cloud.cell_m > 0) {
    const { points, all_points, cell_m } = run.cloud;
    parts.push(`${number(points.length / 3)} of ${number(all_points)} points, one in each cube `
      + `of ${number(100 * cell_m, 1)} cm`);
  }
  const mesh = meshes[run.mesh];
  const faces = mesh?.parts.reduce((sum, part) => sum + part.corners.length / 3, 0) ?? 0;
  if (mesh && faces < mesh.all_faces) {
    parts.push(`${number(faces)} of ${number(mesh.all_faces)} faces of the structure`);
  }
  return parts.length === 0 ? "" : `${ofLabel(runs, run) || "Shown are "}${parts.join("; ")}. `;
}

export const makeFooter = (page: PageData) => make("footer", {}, `gnbv ${page.version}. `,
  ...page.runs.map((run) => thinning(run, page)), "Frames are shrunk so that the page stays "
  + "small; the run directory holds everything.");

export function makeHeader({ title, runs }: PageData): HTMLElement {
  const [{ structure, seed, preset, figures }] = runs;
  const detail = runs.length > 1 ? [] : [`structure ${spaced(structure)}`, `seed ${seed}`,
    `preset ${spaced(preset)}`,
    figures ? `ended by ${spaced(figures.termination)}` : "not finished"];
  return make("header", {}, make("h1", {}, title), make("p", {}, detail.join("  ·  ")));
}

/** The frames that the cameras took at the present view, or at the nearest one that was kept. */
export class FrameStrip {
  readonly element = make("div", { class: "frames strip" });
  private key = "";

  show(flights: Flight[]) {
    const kept = flights.filter(({ data }) => data.frames.length > 0).map((flight) => ({ flight,
      view: nearestView(flight, flight.n - 1),
      // before the first view there is none to show: the one that comes is
      before: flight.n === 0 ? "next: " : "" }));
    const key = kept.map(({ flight, view, before }) => `${flight.index}:${before}${view}`).join();
    if (key === this.key) return;
    this.key = key;
    this.element.replaceChildren(...kept.flatMap(({ flight, view, before }) =>
      figuresOf(flight, view, ofLabel(flights, flight.data) + before)));
  }
}

const cameraName = (name: string) => name.replaceAll("_", " ").replace(/^rgbd\b/, "RGBD camera")
  .replace(/^zed mini\b/, "ZED Mini");

/** What the cameras saw at a view; nothing where it was not kept. */
export function figuresOf({ data, range_m }: Flight, view: number, before = ""): HTMLElement[] {
  const key = colourBar(rampGradient("amount"), "", ["0", number(range_m / 2, 1),
    measure(number(range_m), "m")], "");
  return data.frames.filter((frame) => frame.view === view).flatMap((frame) => {
    const name = `${before}view ${view + 1}, ${cameraName(frame.camera)}`;
    return [figure(frame, frame.jpeg, name, null),
      figure(frame, frame.depth_jpeg, `${name}, depth`, key.cloneNode(true))];
  });
}

function figure({ width_px: width, height_px: height }: FrameData, jpeg: FrameData["jpeg"],
    name: string, key: Child): HTMLElement {
  const url = URL.createObjectURL(new Blob([jpeg], { type: "image/jpeg" }));
  const image = make("img",
    { src: url, width, height, alt: name, load: () => URL.revokeObjectURL(url) });
  const open = make("button", { class: "picture", title: "As large as it goes; Escape leaves it",
    "aria-label": `Enlarge ${name}`, click: () => void image.requestFullscreen() }, image);
  return make("figure", { class: "card frame" }, open, make("figcaption", {}, name, key));
}

function nearestView({ data: { frames } }: Flight, view: number): number {
  return frames.reduce((best, frame) =>
    (Math.abs(frame.view - view) < Math.abs(best - view) ? frame.view : best), frames[0].view);
}
