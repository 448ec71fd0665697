// What everything in the 3D view means, in words beside its colour.
import { cssOf, rampGradient, wordsOf, type RampName } from "./colours";
import { kBelievedKinds } from "./decisions";
import { colourBar, make, mark, measure, number, ofRun, type Child } from "./dom";
import type { RunScene, Layers } from "./run_scene";
import { ofVoxels, type Colouring } from "./surfaces";

const item = (shape: "line" | "dot", colour: string, text: string, ...more: Child[]) =>
  make("span", {}, mark(shape, colour), text, ...more);

/** A thing as all pictures have it. */
const thing = (shape: "line" | "dot", name: string, ...more: Child[]) =>
  item(shape, cssOf(name), wordsOf(name), ...more);

const rampMark = (ramp: RampName) => make("span", {}, mark("bar", rampGradient(ramp)));

/** The colours of an order. */
const orderItem = (first: string, last: string) => make("span", {}, first, rampMark("path"), last);

/** One text where all runs have the same, else each run's beside the colour of the run. */
function ofEach(scenes: RunScene[], texts: string[]): Child[] {
  if (new Set(texts).size === 1) return [` ${texts[0]}`];
  return scenes.map(({ flight: { index, data } }, i) => {
    const dot = ofRun("dot", index);
    dot.role = "img";
    dot.ariaLabel = data.label;
    return make("span", { class: "each" }, dot, ` ${texts[i]}`);
  });
}

/** With as many decimals where there are any. */
const shortly = (decimals: number) => (value: number) =>
  number(value, value % 1 === 0 ? 0 : decimals);

/** A bar with what it stands for under it, or where runs differ in that each run's ends. */
function amountItem(scenes: RunScene[], what: string, ranges: [low: number, high: number][],
    format: (value: number) => string, unit: string, ramp: RampName = "amount") {
  const ends = ranges.map(([low, high]) => [low, (low + high) / 2, high].map(format));
  if (new Set(ends.map(String)).size === 1) {
    return colourBar(rampGradient(ramp), what, ends[0], unit);
  }
  return make("span", {}, what, rampMark(ramp),
    ...ofEach(scenes, ends.map(([low, , high]) => `${low} to ${high}`)), ` ${unit}`);
}

function ofColouring(scenes: RunScene[], by: Colouring, things: string): HTMLElement {
  if (by === "real") return item("dot", "#9a8f80", `${things}: camera colours`);
  if (by === "iteration") return orderItem(`${things}: found by first`, "last view");
  if (by === "height") {
    return amountItem(scenes, `${things}: height`, scenes.map(({ model }) => model.heights),
      (z) => number(z, 1), "m");
  }
  if (by === "error") {
    const measured = scenes.filter(({ flight }) => flight.data.cloud?.error);
    const clouds = measured.map(({ flight }) => flight.data.cloud!);
    const bar = amountItem(measured, `${things}: off the surface by`,
      clouds.map(({ error_most_mm }) => [0, error_most_mm]), shortly(1),
      "mm or more; grey: not of the structure; median", "error");
    return make("span", {}, ...bar.childNodes, ...ofEach(measured,
      clouds.map(({ error_median_mm }) => measure(number(error_median_mm), "mm"))));
  }
  const dense = scenes.filter(({ flight }) => flight.data.voxels);
  if (dense.length === 0) return make("span", {}, "no voxels");
  const most = dense.map(({ model }) => model.densities.most);
  const { size_m } = dense[0].model.densities.voxels;
  return amountItem(dense, `${things}: density`, most.map((high) => [0, high]),
    shortly(Math.min(...most) < 10 ? 1 : 0),
    `or more points a voxel of ${measure(number(size_m, 2), "m")}`);
}

/** Of the layers that are shown, as things are now. */
export function legendItems(scenes: RunScene[], layers: Layers, by: Colouring): HTMLElement[] {
  if (scenes.length === 0) return [];
  const grids = scenes.map(({ flight }) => measure(number(flight.data.grid_m), "m"));
  // beside a surface nothing that was measured is drawn
  const showsMeasured = scenes.some((scene) => !scene.isSwiped());
  return [...showsMeasured ? measuredItems(scenes, layers, by) : [],
    ...surfaceItems(scenes, layers, by),
    showsMeasured && layers.structure && thing("dot", "structure"),
    ...flightItems(scenes, layers),
    ...layers.candidates ? candidateItems(scenes) : [], ...believedItems(scenes),
    make("span", {}, "grid", ...ofEach(scenes, grids))].filter((each) => each !== false);
}

function measuredItems(scenes: RunScene[], layers: Layers, by: Colouring) {
  const clouds = scenes.filter(({ flight }) => flight.data.cloud);
  const coloured = clouds.length > 0 ? clouds : scenes;
  const pale = scenes.some(({ model }) => model.isFaded) ? "pale " : "";
  const areOne = layers.cloud && layers.voxels && ofVoxels(by) === by && !pale;
  return [areOne && ofColouring(coloured, by, "points, voxels"),
    layers.cloud && !areOne && ofColouring(coloured, by, `${pale}points`),
    layers.voxels && !areOne && ofColouring(coloured, ofVoxels(by), "voxels"),
    layers.cloud && scenes.some(({ model, flight }) => model.newPoints(flight.n) > 0)
      && thing("dot", "new_points")];
}

function surfaceItems(scenes: RunScene[], layers: Layers, by: Colouring) {
  const known = scenes.filter(({ surface }) => surface);
  const [found, missed] = [layers.found, layers.missed].map((on) => on && known.length > 0);
  const sizes = () => [", voxels of",
    ...ofEach(known, known.map(({ surface }) => measure(number(surface!.size_m, 2), "m")))];
  const isOver = known.every(({ flight }) => flight.n >= flight.count);
  const missedLook = by === "iteration" ? "missed_in_order" : "missed";
  return [found && (by === "iteration" ? orderItem("surface found by first", "last view")
    : thing("dot", "found", ...sizes())),
  missed && item("dot", cssOf(missedLook),
    isOver ? wordsOf(missedLook) : "surface not found yet", ...sizes()),
  missed && known.some(({ others }) => others.length > 0) && thing("dot", "only_other"),
  scenes.some((scene) => scene.isSwiped()) && make("span", {}, "left of the line the true "
    + "structure, without its texture, right of it the surface made of the run's pictures"
    + (layers.cloud || layers.voxels ? "; points and voxels are not drawn beside them" : ""))];
}

function flightItems(scenes: RunScene[], layers: Layers) {
  const hasViews = scenes.some(({ flight }) => flight.n > 0);
  const isWhole = scenes.every(({ flight }) => flight.sight_m === flight.range_m);
  const lengths = scenes.map(({ flight }) => measure(number(flight.sight_m, 1), "m"));
  return [layers.path && hasViews && orderItem("path, views: first", "last"),
    layers.frusta && hasViews && item("line", rampGradient("path"), "pyramid of each view"),
    (layers.profile || (layers.path && !hasViews)) && thing("line", "profile"),
    layers.plan && scenes.some((scene) => scene.plan) && thing("line", "plan"),
    layers.vehicle && thing("dot", "hull", ", enlarged where it would be a speck"),
    layers.vehicle && !layers.candidates && hasViews && thing("line", "camera",
      ...isWhole ? [] : [" to", ...ofEach(scenes, lengths)])];
}

/** Each kind once, with the counts of all runs. */
function candidateItems(scenes: RunScene[]): HTMLElement[] {
  const deciding = scenes.filter((scene) => scene.candidates);
  const kinds = deciding.map((scene) => scene.candidates!.kinds());
  const all = new Map(kinds.flat().map((kind) => [kind.text, kind]));
  return [...all].map(([text, { colour, means }]) => {
    const counts = kinds.map((ofRun) =>
      number(ofRun.find((kind) => kind.text === text)?.count ?? 0));
    const named = item("line", colour, `${text}:`, ...ofEach(deciding, counts));
    named.title = means;
    return named;
  });
}

/** Each kind once; counted where there is one run. */
function believedItems(scenes: RunScene[]): HTMLElement[] {
  const shown = scenes.filter((scene) => scene.believed?.object.visible);
  const counts = shown.map((scene) => scene.believed!.counts());
  const kinds = kBelievedKinds.filter((kind) => counts.some((each) => each[kind] !== undefined));
  const coarse_m = Math.max(0, ...shown.map((scene) => scene.believed!.coarse_m()));
  return [...kinds.map((kind) => thing("dot", kind,
    shown.length > 1 ? "" : `: ${number(counts[0][kind] ?? 0)}`)),
  ...coarse_m === 0 ? [] : [make("span", {},
    `these are drawn as cubes of ${number(coarse_m, 2)} m, so that the page can carry them`)]];
}
